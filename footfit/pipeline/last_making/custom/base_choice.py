"""Which last a custom one is made from: the best match, or the base that was named."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path

from footfit.catalogue.group_commit import NewLast
from footfit.catalogue.rows.last_names import caseless
from footfit.catalogue.rows.requirements import require_name
from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import FootfitError, NameTaken, NoCandidate, OutOfReach
from footfit.locations import Location
from footfit.pipeline.fit.match import Question, matched
from footfit.pipeline.last_making.base_last import BaseLast, stored_base
from footfit.pipeline.last_making.custom.custom_making import Making, begun, customised
from footfit.pipeline.last_making.custom.out_of_reach import reason
from footfit.pipeline.library.named_lasts import stored_names
from footfit.pipeline.shelf.candidates import choice
from footfit.results import Profiled, SideName
from footfit.results.last_making.custom_last import CustomLast

TRIED = 3
"""So many of the best lasts are tried before a foot is refused."""
HEEL_MM = 6.0
"""Lasts whose heels differ by less have the same heel: a better base of that heel comes first."""
LOOKED_AT = 20
"""Among so many of the best lasts those that were not made for a customer come first."""


def best_bases(
    feet: Sequence[Profiled], path: Location, making: Making, without: str | None = None
) -> Iterator[BaseLast]:
    """The lasts of a catalogue that match a customer best, or the nearest if none fits.

    A last that was made for a customer comes after all others: its shape is that of a foot.

    Raises
    ------
    NotInCatalogue, HalfScan
        There is no catalogue or no last in it; a foot's length is not known.
    """
    asked = making.question
    question = Question(top=LOOKED_AT, profile=asked.profile, heel=asked.heel, worn=asked.worn)
    match = matched(feet, choice(path, None, None), question)
    names = [each.last for each in (match.candidates or match.nearest) if each.last != without]
    with open_catalogue(path) as catalogue:
        names.sort(key=lambda name: _made_for_a_customer(catalogue, name))
    for name in names[:TRIED]:
        with suppress(FootfitError):  # a last without a sound mesh is no base
            yield stored_base(path, name, base_folders(path))


def _made_for_a_customer(catalogue: Catalogue, name: str) -> bool:
    parentage = catalogue.parentage(name)
    return parentage is not None and parentage.made_by == "customise"


def base_folders(path: Location) -> tuple[Path, ...]:
    """Where the original file of a stored last is looked for: here, and beside the catalogue."""
    return (Path(), path.parent) if isinstance(path, Path) else (Path(),)


def customised_from_best(
    feet: Sequence[Profiled], path: Location, making: Making
) -> tuple[BaseLast, CustomLast]:
    """The best base for a customer, and the custom last that it gives for the first foot.

    Raises
    ------
    OutOfReach
        No base can be changed so far; the message is that of the best match.
    NoCandidate
        The catalogue has no last with a mesh.
    """
    first: tuple[BaseLast, OutOfReach] | None = None
    for base in best_bases(feet, path, making):
        try:
            return base, customised(feet[0], base, making)
        except OutOfReach as error:
            first = first or (base, error)
    if first is None:
        raise NoCandidate("no last of the catalogue has a mesh: ingest lasts first", str(path))
    best, refusal = first
    words = f"{_why(feet[0], best, making, refusal)}; {_next_step(making, others_tried=True)}"
    raise OutOfReach(words, best.path) from refusal


def customised_from(
    foot: Profiled,
    base: BaseLast,
    making: Making,
    path: Location | None,
    side: SideName | None = None,
) -> CustomLast:
    """The custom last that a named base gives; a refusal names a better base if there is one, and
    else what to do.

    Raises
    ------
    OutOfReach
        A target is out of reach of the base.
    """
    try:
        return customised(foot, base, making, side)
    except OutOfReach as error:
        better = None if path is None else _better_base(foot, path, making, base)
        words = _why(foot, base, making, error, side)
        step = _next_step(making, others_tried=path is not None)
        if better is not None:
            step = f"use --base {better.name}{_heel_words(better, base)}"
        raise OutOfReach(f"{words}; {step}", base.path) from error


def _why(
    foot: Profiled,
    base: BaseLast,
    making: Making,
    error: OutOfReach,
    side: SideName | None = None,
) -> str:
    """Why a base is refused: which target is out of reach, or which two are so together."""
    with suppress(FootfitError):
        return reason(*begun(foot, base, making, side)) or error.message
    return error.message


def _next_step(making: Making, *, others_tried: bool) -> str:
    """What to do about a refusal, if no better base is known."""
    if making.question.flare_follow:
        return "try a lower --flare-follow"
    steps = "give another --profile, or ingest a last that is nearer to these figures"
    if others_tried:
        return f"the lasts of the catalogue that match best cannot be changed so far: {steps}"
    return "give another --base, of another size or width, or another --profile"


def _better_base(foot: Profiled, path: Location, making: Making, base: BaseLast) -> BaseLast | None:
    """Another last that can be changed to fit, best one of the same heel; None if there is none."""
    with suppress(FootfitError):
        others = list(best_bases([foot], path, making, base.name))
        for other in sorted(
            others, key=lambda other: abs(_heel_mm(other) - _heel_mm(base)) > HEEL_MM
        ):
            with suppress(OutOfReach):
                customised(foot, other, making)
                return other
    return None


def _heel_words(better: BaseLast, base: BaseLast) -> str:
    """That a better base has another heel, if it has."""
    if abs(_heel_mm(better) - _heel_mm(base)) <= HEEL_MM:
        return ""
    return f", whose heel is {_heel_mm(better):.0f} mm high, not {_heel_mm(base):.0f} mm"


def _heel_mm(base: BaseLast) -> float:
    """How high the heel of a last is; 0 if that is not known."""
    return base.record.heel_height_mm or 0.0


def require_free_names(path: Location, names: Sequence[str], *, replaces: bool = False) -> None:
    """Refuse names that lasts of the catalogue have, before any work.

    Raises
    ------
    NameTaken, BadOption
        There is a last of that name; no last can have it.
    """
    for name in names:
        require_name(name)
    known = {} if replaces else stored_names(path)
    for name in names:
        if caseless(name) in known:
            words = "is in the catalogue: add --force, or give --store another name"
            raise NameTaken(f"{known[caseless(name)]!r} {words}")


def store_custom_lasts(
    path: Location, customs: Sequence[CustomLast], *, replaces: bool = False
) -> None:
    """Store custom lasts with their full meshes, and with how they were made: all, or none.

    Raises
    ------
    CatalogueUnusable, NameTaken
        The catalogue cannot be written; it has another last of such a name.
    """
    from footfit.meshes.copies.compact_copy import compact_copy

    names_of = [custom.record.labels.name for custom in customs]
    require_free_names(path, names_of, replaces=replaces)
    with open_catalogue(path, write=True) as catalogue:
        names, lasts = catalogue.names(), []
        for custom in customs:
            copy = compact_copy(custom.vertices_mm, custom.faces, len(custom.faces))
            parent = custom.base if custom.base in names else None
            if parent and catalogue.record(parent).info.sha256 != custom.base_sha256:
                parent = None  # another last of that name
            # it has no size, so it is no last of the base's run
            labels = replace(custom.record.labels, parent=parent, family=None)
            record = replace(custom.record, labels=labels)
            lasts.append(NewLast(record, copy, custom.sections, custom.parentage))
        catalogue.add_all(lasts, replace=replaces)
