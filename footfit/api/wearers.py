"""What wearers say of worn shoes: it is recorded with consent, forgotten for good, and teaches."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

from footfit import results
from footfit.api.inputs import (
    FilePath,
    RecordKeywords,
    Shape,
    heel_options,
    known_keywords,
    worn_options,
)
from footfit.api.scans import profiled_shape
from footfit.catalogue import store
from footfit.errors import BadOption
from footfit.locations import Location

if TYPE_CHECKING:
    from footfit.pipeline.evidence.recording import Said


@dataclass(frozen=True, slots=True)
class FitLog:
    """The fit log of the catalogue in a file."""

    path: Location

    @known_keywords(RecordKeywords)
    def record(
        self,
        last: str,
        foot: Shape,
        said: Said,
        *,
        consent: bool = False,
        profile: str = "walking",
        **reading: Unpack[RecordKeywords],
    ) -> results.RecordOutcome:
        """Store what a wearer said of a shoe, with the clearances of the foot in its last.

        No mesh, no file name and no name is stored. ``consent``: the wearer agrees that ratings and
        clearances are kept.

        Raises
        ------
        BadOption
            There is no consent, or no such profile; nothing is stored.
        UnknownLast, InputError, GeometryRefused
            As `compare`; HalfScan if the length of the foot is not known.
        """
        from footfit.pipeline.evidence.recording import NO_CONSENT, fit_entry
        from footfit.pipeline.fit.fit_profile import fit_profile
        from footfit.pipeline.fit.worn_shifts import worn_with

        if not consent:
            raise BadOption(NO_CONSENT)
        asked = fit_profile(profile)
        with store.open_catalogue(self.path) as catalogue:
            record = catalogue.record(catalogue.name(last))
        shape = profiled_shape(foot, reading)
        worn = worn_with(asked, worn_options(reading))
        entry = fit_entry(shape, record, asked, heel_options(reading), said, worn, self.path)
        with store.open_catalogue(self.path, write=True, create=False) as catalogue:
            catalogue.fit_log.add(entry)
        return results.RecordOutcome(entry)

    def entries(self) -> results.FitList:
        """Every entry of the fit log, oldest first."""
        with store.open_catalogue(self.path) as catalogue:
            return results.FitList(catalogue.fit_log.entries())

    def forget(self, asked: str) -> results.ForgetOutcome:
        """Remove the entries of a wearer's code, or one entry by its id, for good.

        Raises
        ------
        UnknownFit
            There is no such code or id.
        """
        with store.open_catalogue(self.path, write=True, create=False) as catalogue:
            return catalogue.fit_log.forget(asked)

    def calibrate_profile(
        self, profile: str = "walking", fits: FilePath | None = None
    ) -> results.Calibration:
        """What ratings make of a fit profile; its ``after`` is the profile if no zone may change.

        Parameters
        ----------
        profile : str
            The name or the file of a fit profile. Entries of that name count.
        fits : path, optional
            A CSV file as ``list-fits`` writes it, instead of this catalogue's fit log.

        Raises
        ------
        BadOption, BadProfile, BadManifest
            There is no such profile; the CSV file is not understood.
        """
        from footfit.pipeline.evidence.learned_profile import calibration, entries_of_csv
        from footfit.pipeline.fit.fit_profile import fit_profile

        asked = fit_profile(profile)
        entries = self.entries().entries if fits is None else entries_of_csv(Path(fits))
        return calibration(asked, entries)
