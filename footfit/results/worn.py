"""What is worn with a shoe, and how the foot was scanned: socks, insoles, load, time of day."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from footfit.number_words import plain
from footfit.results.values import Part

Load = Literal["air", "sitting", "half", "full"]
TimeOfDay = Literal["morning", "evening"]


@dataclass(frozen=True, slots=True)
class Worn(Part):
    """What is worn with the shoe, in mm, and how the foot was scanned; None is not known.

    ``scanned_in_sock_mm`` is the sock that the scan holds already.
    """

    sock_mm: float | None = None
    insole_mm: float | None = None
    heel_lift_mm: float | None = None
    load: Load | None = None
    time: TimeOfDay | None = None
    scanned_in_sock_mm: float | None = None

    @property
    def more_sock_mm(self) -> float:
        """The sock that is worn beyond the one that was scanned; - if it is thinner.

        A scan in a sock is taken to be for shoes worn with it, if nothing else is said.
        """
        scanned = self.scanned_in_sock_mm or 0.0
        return (scanned if self.sock_mm is None else self.sock_mm) - scanned

    @property
    def words(self) -> str | None:
        """What was taken into account, in one line; None if nothing was said."""
        said = []
        if self.sock_mm is not None:
            scanned = self.scanned_in_sock_mm
            more = f" (the scan holds {plain(scanned)} mm)" if scanned else ""
            said.append(f"a sock of {plain(self.sock_mm)} mm{more}")
        elif self.scanned_in_sock_mm:
            said.append(f"the sock of {plain(self.scanned_in_sock_mm)} mm that was scanned")
        if self.insole_mm:
            said.append(f"an insole of {plain(self.insole_mm)} mm")
        if self.heel_lift_mm:
            said.append(f"a heel lift of {plain(self.heel_lift_mm)} mm")
        how = [LOAD_WORDS[self.load]] if self.load else []
        how += [f"in the {self.time}"] if self.time else []
        if how:
            said.append(f"a foot scanned {' '.join(how)}")
        return ", ".join(said) or None


LOAD_WORDS: dict[Load, str] = {
    "air": "without load",
    "sitting": "sitting",
    "half": "standing on both feet",
    "full": "standing on one foot",
}
BAREFOOT = Worn()
