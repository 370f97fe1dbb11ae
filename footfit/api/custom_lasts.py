"""Custom lasts: a last for one customer, made from the best last or a named one."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Unpack

from footfit import results
from footfit.api.inputs import (
    CompareKeywords,
    Feet,
    Mesh,
    WornKeywords,
    heel_options,
    known_keywords,
    reading_options,
    refuse_stance,
    source_of,
    stance_keywords,
    worn_options,
)
from footfit.api.scans import profiled_shape
from footfit.errors import BadOption, OutOfReach, UnreadableFile
from footfit.locations import Location, LocationName, location_of
from footfit.pipeline.batch.sources import ReadingOptions, is_no_path
from footfit.results import Profiled, SideName

if TYPE_CHECKING:
    from footfit.pipeline.last_making.base_last import BaseLast
    from footfit.pipeline.last_making.custom.custom_making import Making

AUTO = "auto"
"""The base that a foot matches best."""


class CustomKeywords(CompareKeywords, WornKeywords, total=False):
    """How a foot is to be understood, and what is asked of its custom last.

    ``heel_height_mm``, ``toe_spring_mm`` and ``platform_mm`` are those of a base that is a mesh.
    ``profile`` is the name or the file of a fit profile. ``flare_follow`` (0 to 1) says how far the
    flare goes towards the foot's, ``keep_bottom`` keeps the outline of the bottom, and ``room_mm``
    gives single places more room, such as {"ball-medial": 4.0}. ``name`` is that of the new last.
    """

    profile: str
    flare_follow: float
    keep_bottom: bool
    room_mm: Mapping[str, float]
    name: str


@known_keywords(CustomKeywords)
def customise(
    feet: Feet,
    base: Mesh = AUTO,
    *,
    catalogue: LocationName | None = None,
    both: bool = False,
    store: bool = False,
    **asked: Unpack[CustomKeywords],
) -> tuple[results.CustomLast, ...]:
    """A last for each foot, made from a base so that it has the fit profile's allowances.

    Parameters
    ----------
    feet : one foot, or the list of the two of one customer
    base : str or mesh
        The name of a last of the ``catalogue``, a mesh, or "auto" for the best match.
    catalogue : path, optional
    both : bool
        One foot gets two lasts: its own, and the mirror image for the other side.
    store : bool
        Whether the lasts will be stored with `store_custom`. A base that is a file is then the last
        of the catalogue that has its content, with its labels.
    **asked
        See `CustomKeywords`.

    Raises
    ------
    OutOfReach
        A measure is out of reach of the base.
    BadOption
        An option is out of range, or the base is "auto" and there is no catalogue.
    InputError, GeometryRefused, NotInCatalogue, CatalogueUnusable
        A foot or the base cannot be read.
    """
    from footfit.pipeline.customers.pair_sides import pair_of_feet
    from footfit.pipeline.fit.refused_feet import refuse_lasts
    from footfit.pipeline.last_making.custom import base_choice
    from footfit.pipeline.last_making.custom.custom_making import customised
    from footfit.pipeline.last_making.custom.in_stock import with_stock_looked_at

    making, path = _making(asked), None if catalogue is None else location_of(catalogue)
    stands = stance_keywords(asked)
    given: list[Any] = feet if isinstance(feet, list) else [feet]
    if len(given) not in (1, 2) or (both and len(given) == 2):
        raise BadOption("give one foot, with both=True or without, or the two of one customer")
    shapes = pair_of_feet([profiled_shape(foot, _reading(asked)) for foot in given])
    refuse_lasts(shapes)
    lasts: list[results.CustomLast] = []
    if isinstance(base, str) and base == AUTO:
        if path is None:
            raise BadOption("the base is found in a catalogue: name a catalogue, or a base")
        refuse_stance(stands, "the best match")
        with _naming(shapes[0]):
            chosen, first = base_choice.customised_from_best(shapes, path, making)
        lasts, rest = [with_stock_looked_at(first, shapes[0], path, making.question)], shapes[1:]
    else:
        chosen, rest = _base(base, path, stands, store=store), shapes
    for foot in rest:
        with _naming(foot):
            made = base_choice.customised_from(foot, chosen, making, path)
        if path is not None:
            made = with_stock_looked_at(made, foot, path, making.question)
        lasts.append(made)
    if both:
        other: SideName = "left" if lasts[0].side == "right" else "right"
        lasts.append(customised(shapes[0], chosen, making, other))
    return tuple(lasts)


@contextmanager
def _naming(foot: Profiled) -> Iterator[None]:
    """Let a refusal say of which foot it is."""
    try:
        yield
    except OutOfReach as error:
        alignment = foot.aligned.alignment
        which = f"for the {alignment.side.side} foot ({alignment.info.path or '-'})"
        raise OutOfReach(f"{which} {error.message}", error.path) from error


def store_custom(
    custom: results.CustomLast | Sequence[results.CustomLast],
    catalogue: LocationName,
    *,
    replace: bool = False,
) -> None:
    """Store a custom last in a catalogue, or several, with their full meshes and how they were
    made. Of several all are stored, or none.

    Raises
    ------
    CatalogueUnusable, NameTaken
        The catalogue cannot be written; it has another last of that name.
    """
    from footfit.pipeline.last_making.custom.base_choice import store_custom_lasts

    customs = [custom] if isinstance(custom, results.CustomLast) else custom
    store_custom_lasts(location_of(catalogue), customs, replaces=replace)


def _reading(asked: Mapping[str, Any]) -> dict[str, Any]:
    """How the feet are read: the keywords of `ReadingKeywords`, without those of the base."""
    names = ReadingOptions.__dataclass_fields__.keys() - stance_keywords(asked).keys()
    return {name: asked[name] for name in names if name in asked}


def _making(asked: CustomKeywords) -> Making:
    """How the lasts are made.

    Raises
    ------
    BadOption
        The flare follows by less than 0 or more than 1; there is no such profile; room is no dict.
    """
    from footfit.pipeline.fit.fit_profile import fit_profile
    from footfit.pipeline.fit.worn_shifts import worn_with
    from footfit.pipeline.last_making.custom.custom_aims import CustomQuestion
    from footfit.pipeline.last_making.custom.custom_making import Making

    follow = asked.get("flare_follow", 0.0)
    if not 0.0 <= follow <= 1.0:
        raise BadOption(f"--flare-follow takes 0 to 1, not {follow:g}")
    profile = fit_profile(asked.get("profile", "walking"))
    worn = worn_with(profile, worn_options(asked))
    kept = asked.get("keep_bottom", False)
    question = CustomQuestion(profile, heel_options(asked), worn, follow, kept)
    rooms = asked.get("room_mm", {})
    if not isinstance(rooms, Mapping):
        raise BadOption(f"the room is a dict such as {{'ball-medial': 4.0}}, not {rooms!r}")
    return Making(question, dict(rooms), asked.get("name", "custom"))


def _base(
    base: Mesh, path: Location | None, stands: Mapping[str, float], *, store: bool
) -> BaseLast:
    """The base that is named: a last of the catalogue, or a mesh that ``stands`` as was given. If
    the lasts will be stored, a file is the last of the catalogue that has its content.

    Raises
    ------
    UnreadableFile
        There is no such file and no such last.
    BadOption
        It is given how a last of the catalogue stands.
    """
    from footfit.pipeline.last_making.base_last import base_of_content, scanned_base, stored_base
    from footfit.pipeline.last_making.custom.base_choice import base_folders
    from footfit.pipeline.library.named_lasts import names_a_last, stored_name

    if isinstance(base, str) and is_no_path(base):
        if path is None and names_a_last(base):
            words = "there is no such file, and no catalogue with a last of this name"
            hint = "give a catalogue (catalogue= or --catalogue), or the path of a file"
            raise UnreadableFile(f"{words}: {hint}", base)
        if path is None:
            raise UnreadableFile("there is no such file: check the path", base)
        if not names_a_last(base) and stored_name(path, base) is None:
            raise UnreadableFile("there is no such file: check the path", base)
        refuse_stance(stands, base)
        return stored_base(path, base, base_folders(path))
    source = source_of(base, {})
    kept = store and path is not None and source.path is not None and not stands
    known = base_of_content(path, source) if kept and path is not None else None
    return known or scanned_base(source, reading_options(stands))
