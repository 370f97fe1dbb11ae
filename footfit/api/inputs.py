"""What the library takes: meshes in any form, and how they are to be understood."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from functools import wraps
from typing import (
    TYPE_CHECKING,
    Any,
    Literal,
    Protocol,
    TypedDict,
    TypeVar,
    Union,
    cast,
    runtime_checkable,
)

from footfit.errors import BadOption
from footfit.pipeline.batch.runs import Jobs
from footfit.pipeline.batch.sources import ReadingOptions, Source
from footfit.results import AlignedScan, HeelQuestion, Profiled, Scan, SearchBy, Worn

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from footfit.meshes.exchange import Trimesh
    from footfit.results import GrowthQuestion

F = TypeVar("F", bound=Callable[..., Any])
NEAR_KEYWORD = 0.45
"""A known keyword that is so like a mistyped one is named; 1 is the same."""
FilePath = str | os.PathLike[str]
Mesh = Union[FilePath, bytes, tuple["ArrayLike", "ArrayLike"], "Trimesh", Scan, Source]
"""A file, its bytes, vertices (n, 3) with faces (m, 3), a trimesh mesh, a `read`, a source."""
Shape = Mesh | AlignedScan | Profiled
"""A mesh of one foot or last, or what `align` or `flare` gave for it."""
Feet = Shape | list[Shape] | list[str] | list[Source]
"""One foot, or a list of them."""
Meshes = Mesh | list[Mesh] | list[str] | list[Source]
"""Meshes, files, folders and globs; several in a list."""


class ScaleKeywords(TypedDict, total=False):
    """How long a mesh is: its ``units``, or the ``known_length_mm`` of the foot or last in it.

    ``format`` is what bytes must be; without it the content decides.
    """

    units: Literal["auto", "mm", "cm", "m", "in"]
    known_length_mm: float | None
    format: str | None


class ReadingKeywords(ScaleKeywords, total=False):
    """How a foot or a last is to be understood; the shape decides "auto".

    ``force_side`` takes a ``side`` that the shape surely contradicts. ``kind`` says whether it is a
    foot or a last. ``heel_height_mm`` and ``toe_spring_mm`` are what is known of how a last stands:
    they decide its stance. ``platform_mm`` is the height of its forepart over the ground that the
    heel is given over. ``scanner`` is the kind of scanner; the total standard deviations then hold
    its own.
    """

    side: Literal["auto", "left", "right"]
    force_side: bool
    kind: Literal["auto", "foot", "last"]
    heel_height_mm: float | None
    toe_spring_mm: float | None
    platform_mm: float | None
    scanner: Literal["laser", "handheld", "phone", "photos"] | None


class HeelKeywords(TypedDict, total=False):
    """How feet are compared with lasts that have a heel; without these as they would be in it.

    ``as_scanned`` compares them as they were scanned. ``scanned_at_drop_mm`` is the drop of what
    the feet stood on in the scanner.
    """

    as_scanned: bool
    scanned_at_drop_mm: float | None


class CompareKeywords(ReadingKeywords, HeelKeywords, total=False):
    """How a foot is to be understood, and how it is compared with a last that has a heel.

    ``heel_height_mm``, ``toe_spring_mm`` and ``platform_mm`` are those of the last.
    """


class WornKeywords(TypedDict, total=False):
    """What is worn with the shoes, in mm, and how the foot was scanned; without these as the fit
    profile has it.
    """

    sock_mm: float | None
    insole_mm: float | None
    heel_lift_mm: float | None
    load: Literal["air", "sitting", "half", "full"] | None
    time: Literal["morning", "evening"] | None
    scanned_in_sock_mm: float | None


class RecordKeywords(CompareKeywords, WornKeywords, total=False):
    """How a foot is to be understood, and what was worn with the shoe."""


class MatchKeywords(CompareKeywords, WornKeywords, total=False):
    """What is asked of a catalogue, and how the feet are to be understood.

    ``profile`` is the name or the file of a fit profile, ``top`` how many lasts to show (0: all).
    ``style`` and ``size_system`` filter the lasts, and so does ``stock``, a CSV file of what a shop
    has; ``clearance`` puts the feet into those shown. ``growth`` asks how long a child's shoe will
    do, with ``age_years`` and ``sex`` if they are known. ``force_foot`` takes a shape for a foot
    that is surely a last.
    """

    by: SearchBy
    profile: str
    top: int
    style: str | None
    size_system: str | None
    clearance: bool
    stock: FilePath | None
    growth: bool
    age_years: float | None
    sex: Literal["female", "male"] | None
    force_foot: bool


class LabelKeywords(TypedDict, total=False):
    """Labels of a last that change; None or an empty text removes a label.

    ``heel_height_mm``, ``toe_spring_mm`` and ``platform_mm`` decide how the last stands.
    """

    style: str | None
    size: str | None
    size_system: str | None
    width_label: str | None
    family: str | None
    parent: str | None
    heel_height_mm: float | None
    toe_spring_mm: float | None
    platform_mm: float | None


class GradeKeywords(TypedDict, total=False):
    """How a last is graded: see the options of ``footfit grade-last``.

    ``base_size`` and ``base_width`` are of the last itself, if its labels do not say them. The
    heights say how a last in a file stands.
    """

    widths: str | None
    size_system: str | None
    base_size: str | None
    base_width: str | None
    hold: str | None
    rule: str | None
    family: str | None
    heel_height_mm: float | None
    toe_spring_mm: float | None
    platform_mm: float | None


class IngestKeywords(ReadingKeywords, total=False):
    """How lasts are stored: over one of the same name, only as a trial, by how many processes.

    ``keep_mesh`` "full" keeps every face of a mesh, "compact" a light copy. Without it the copy is
    light, except for a last that replaces one with its whole mesh.
    """

    replace: bool
    dry_run: bool
    jobs: Jobs
    keep_mesh: Literal["compact", "full"]


@runtime_checkable
class SurfaceMesh(Protocol):
    """What trimesh and others call a mesh: arrays ``vertices`` (n, 3) and ``faces`` (m, 3)."""

    vertices: ArrayLike
    faces: ArrayLike


def known_keywords(keywords: type) -> Callable[[F], F]:
    """Let a function refuse keywords that neither it has nor the ``keywords`` that it unpacks.

    Else Python would take a mistyped keyword, and nothing would come of it.
    """

    def guarded(function: F) -> F:
        code = function.__code__
        own = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        optional: frozenset[str] = getattr(keywords, "__optional_keys__")  # noqa: B009
        known = (*own, *sorted(optional))

        @wraps(function)
        def checked(*args: Any, **given: Any) -> Any:
            for name in given.keys() - set(known):
                from difflib import get_close_matches

                near = get_close_matches(name, known, 1, NEAR_KEYWORD)
                words = f"; did you mean {near[0]!r}?" if near else f": take {', '.join(known)}"
                raise TypeError(f"{function.__name__}() has no keyword {name!r}{words}")
            return function(*args, **given)

        return cast("F", checked)

    return guarded


def source_of(mesh: Mesh, scale: Mapping[str, Any]) -> Source:
    """A mesh as a pipeline takes it; files and bytes are read later.

    Raises
    ------
    InputError
        The arrays are not a mesh, or their unit is not known.
    """
    match mesh:
        case Source():
            return mesh
        case Scan():
            return Source(mesh.info.path, scan=mesh)
        case tuple() | SurfaceMesh():
            from footfit.meshes.read import array_mesh
            from footfit.pipeline.scan.cleaning import scan_of

            options = reading_options(scale)
            arrays = mesh if isinstance(mesh, tuple) else (mesh.vertices, mesh.faces)
            file = array_mesh(*arrays)
            return Source(None, scan=scan_of(file, None, options.units, options.known_length_mm))
        case bytes():
            return Source(None, mesh, scale.get("format"))
    return Source(os.fspath(mesh), None, scale.get("format"))


def heel_options(options: Mapping[str, Any]) -> HeelQuestion:
    """The keywords of `HeelKeywords`, without any others.

    Raises
    ------
    BadOption
        Both are given, or a lift under a heel that does not count; the drop is out of range.
    """
    from footfit.pipeline.fit.heel_model import heel_question

    if options.get("as_scanned") and options.get("heel_lift_mm"):
        raise BadOption("--heel-lift does not go with --as-scanned; leave out one")
    names = ("as_scanned", "scanned_at_drop_mm")
    return heel_question(**{name: options[name] for name in names if name in options})


def stance_keywords(options: Mapping[str, Any]) -> dict[str, Any]:
    """What is said of how a last stands: the keywords that have a value, without any others."""
    from footfit.pipeline.batch.sources import LABELLED_MM

    return {name: options[name] for name in LABELLED_MM if options.get(name) is not None}


def refuse_stance(stands: Mapping[str, Any], name: str) -> None:
    """Refuse what is said of how a last of the catalogue stands.

    Raises
    ------
    BadOption
        ``stands`` has a keyword; ``name`` is the last's.
    """
    if stands:
        words = "is a last of the catalogue, which stands as it was stored: leave out the options"
        raise BadOption(f"{words} that say how", name)


def worn_options(options: Mapping[str, Any]) -> Worn:
    """The keywords of `WornKeywords`, without any others.

    Raises
    ------
    BadOption
        A thickness is negative or too large.
    """
    from footfit.pipeline.fit.worn_shifts import check_worn

    names = Worn.__dataclass_fields__
    worn = Worn(**{name: options[name] for name in names if name in options})
    check_worn(worn)
    return worn


def growth_options(options: Mapping[str, Any]) -> GrowthQuestion | None:
    """What is asked of growth, or None.

    Raises
    ------
    BadOption
        Age or sex is given without growth, or the age is not a child's.
    """
    names = ("growth", "age_years", "sex")
    given = {name: options[name] for name in names if options.get(name) is not None}
    if given in ({}, {"growth": False}):
        return None
    from footfit.pipeline.customers.growth_forecast import growth_question

    return growth_question(**{"growth": False} | given)


def reading_options(options: Mapping[str, Any]) -> ReadingOptions:
    """The keywords of `ReadingKeywords`, without any others."""
    names = ReadingOptions.__dataclass_fields__
    return ReadingOptions(**{name: options[name] for name in names if name in options})
