"""Lasts made from lasts: graded runs, whether a run keeps its increments, how two lasts differ."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from footfit import results
from footfit.api.inputs import (
    FilePath,
    GradeKeywords,
    ReadingKeywords,
    Shape,
    known_keywords,
    reading_options,
    refuse_stance,
    stance_keywords,
)
from footfit.api.scans import profiled_shape
from footfit.errors import BadOption, FootfitError, SideUndecided, UnreadableFile
from footfit.locations import LocationName, location_of
from footfit.pipeline.batch.runs import HERE
from footfit.pipeline.batch.sources import Source, is_no_path, mesh_sources

if TYPE_CHECKING:
    from footfit.pipeline.graded_runs.grade_run import Grader


@known_keywords(GradeKeywords)
def grade(
    last: FilePath,
    sizes: str,
    *,
    catalogue: LocationName | None = None,
    store: bool = False,
    replace: bool = False,
    **options: Unpack[GradeKeywords],
) -> results.GradedRun:
    """A last in other sizes and widths, each measured again from the content of its file.

    Parameters
    ----------
    last : path
        The base: its file, or its name in the catalogue.
    sizes : str
        Such as "38:46", "38:42:0.5" or "39,40.5,42 2/3".
    catalogue : path, optional
        Where the base is looked for, and where the run is stored.
    store, replace : bool
        Whether the catalogue keeps the run, and whether in place of lasts of the same names.
    **options
        See `GradeKeywords`.

    Raises
    ------
    BadOption
        A size or a width is not understood, or the base's is not known.
    OutOfReach
        A last cannot be reached from the base; the message names it.
    NotInCatalogue, InputError, GeometryRefused
        There is no such last; its file cannot be read.
    """
    from footfit.pipeline.graded_runs.grade_store import (
        require_storable_run,
        storable_lasts,
        store_run,
    )

    grading = grader_of(last, sizes, catalogue=catalogue, store=store, **options)
    if not store:
        return grading.run(grading.lasts())
    if catalogue is None:
        raise BadOption("name the catalogue that the run is stored in")
    place = location_of(catalogue)
    require_storable_run(place, grading, replace_stored=replace)
    lasts = storable_lasts(place, grading.lasts())
    return store_run(place, grading, grading.run(lasts), replace_stored=replace)


@known_keywords(GradeKeywords)
def grader_of(
    last: FilePath,
    sizes: str,
    *,
    catalogue: LocationName | None = None,
    store: bool = False,
    **options: Unpack[GradeKeywords],
) -> Grader:
    """What makes the lasts of a run one after the other; raises as `grade`.

    If the run is to be stored, a base that is a file is the last of the catalogue that has its
    content.
    """
    from footfit.catalogue.rows.requirements import require_name
    from footfit.pipeline.graded_runs.base_labels import known_labels
    from footfit.pipeline.graded_runs.grade_plan import grade_plan
    from footfit.pipeline.graded_runs.grade_run import family_of, grader
    from footfit.pipeline.graded_runs.grading_rules import grading_rule
    from footfit.pipeline.last_making.base_last import base_of_content, scanned_base, stored_base
    from footfit.pipeline.library.named_lasts import names_a_last

    if not isinstance(sizes, str):
        raise BadOption(f"the sizes are a text such as '38:46' or '39,40.5', not {sizes!r}")
    for option in ("base_size", "base_width", "widths", "size_system", "hold", "rule", "family"):
        value = options.get(option)
        if not isinstance(value, str | None):
            raise BadOption(f"{option} is a text, not {value!r}")
    if options.get("family"):
        require_name(str(options["family"]), "family")
    name = os.fspath(last)
    stands = stance_keywords(options)
    if not is_no_path(name):
        held = None
        if store and catalogue is not None and not stands:
            held = base_of_content(location_of(catalogue), Source(name))
        base = held or scanned_base(Source(name), reading_options(stands))
    elif catalogue is None or not names_a_last(name):
        raise UnreadableFile("there is no such file", name)
    else:
        refuse_stance(stands, name)
        base = stored_base(location_of(catalogue), name)
    labels = base.record.labels
    known = known_labels(labels, options, name)
    system, size, width = known.system, known.size, known.width
    rule = grading_rule(options.get("rule"), system)
    asked = sizes, options.get("widths")
    plan = grade_plan(rule, system, (size, width), asked, options.get("hold"))
    return grader(base, plan, options.get("family") or family_of(labels, plan.start.size))


def check_run(
    run: FilePath | list[FilePath],
    *,
    catalogue: LocationName | None = None,
    manifest: FilePath | None = None,
    rule: str | None = None,
    tolerance: str | None = None,
    jobs: int = HERE,
) -> results.RunCheck:
    """The increments of a graded run, size by size and width by width, and where they break.

    Parameters
    ----------
    run : path or list of paths
        Files, folders and globs, or names of lasts; or the name of a family of the catalogue.
    catalogue : path, optional
        Where families and names are looked for.
    manifest : path, optional
        A CSV file with the sizes of the files, and how they stand. Without it, ``run.csv`` in their
        folder is read; else their names say the sizes.
    rule : str, optional
        A grading rule by its name or its file: the run is compared with it, else with itself.
    tolerance : str, optional
        In mm by kind of measure, such as "girth=2,length=1.5,width=1,height=1.5".

    Raises
    ------
    BadOption
        A size is not known, or the lasts are no run.
    NotInCatalogue, InputError, GeometryRefused
        There is no such last; so many files cannot be read or measured that no run is left. Else
        ``failed`` has their errors.
    """
    from footfit.pipeline.batch.manifest import read_manifest
    from footfit.pipeline.graded_runs import run_lasts
    from footfit.pipeline.graded_runs.grading_rules import grading_rule
    from footfit.pipeline.graded_runs.run_increments import run_check
    from footfit.pipeline.last_making.tolerances import tolerances
    from footfit.pipeline.library.named_lasts import names_a_last

    given: list[Any] = run if isinstance(run, list) else [run]
    names = [os.fspath(each) for each in given]
    tolerance_mm = tolerances(tolerance)
    stated = None if rule is None else grading_rule(rule)
    rows = None if manifest is None else read_manifest(Path(manifest))
    stored = [name for name in names if is_no_path(name) and names_a_last(name)]
    if stored and catalogue is None:
        raise BadOption("is no file: name the catalogue that has it", stored[0])
    lasts: tuple[results.RunLast, ...] = ()
    family = None
    errors: tuple[FootfitError, ...] = ()
    notices: tuple[results.Notice, ...] = ()
    if catalogue is not None and len(names) == len(stored) == 1:
        lasts = run_lasts.family_lasts(location_of(catalogue), names[0])
        family = names[0] if lasts else None
    if rows is not None and len(stored) == len(names) and (lasts or len(names) > 1):
        raise BadOption("lasts of the catalogue have their sizes there: leave out --manifest")
    if not lasts:
        files = mesh_sources([name for name in names if name not in stored])
        by_name = () if catalogue is None else run_lasts.named_lasts(location_of(catalogue), stored)
        in_files, errors, notices = run_lasts.file_lasts(files, rows, jobs)
        lasts = (*by_name, *in_files)
    try:
        checked = run_check(lasts, tolerance_mm, stated, family)
    except BadOption as error:
        if not errors:
            raise
        errors[0].others = (*errors[1:], error)
        raise errors[0] from error
    return replace(checked, failed=errors, warnings=(*notices, *checked.warnings))


@known_keywords(ReadingKeywords)
def compare_lasts(
    first: Shape,
    second: Shape,
    *,
    tolerance: str | None = None,
    **reading: Unpack[ReadingKeywords],
) -> results.LastDifference:
    """How a second last differs from a first one, laid on its bottom; see docs/compare-lasts.md.

    Parameters
    ----------
    first, second : path, bytes, (vertices, faces), or what `align` or `flare` gave
        `Catalogue.shape` gives a stored last. A last of the other side is mirrored. A side that is
        not sure is the one with which the bottoms lie closer.
    tolerance : str, optional
        In mm by kind of measure; without it "girth=2,length=1.5,width=1,height=1.5".
    **reading
        See `ReadingKeywords`; they count for both.

    Raises
    ------
    BadOption
        The tolerance is not understood.
    InputError, GeometryRefused
        As `flare`, for either; NoSole if their bottoms do not lie together.
    """
    from footfit.pipeline.last_making.pair_of_lasts import closest_sides
    from footfit.pipeline.last_making.tolerances import tolerances
    from footfit.pipeline.last_making.two_lasts import last_difference

    tolerance_mm = tolerances(tolerance)
    pair = closest_sides(_either_side(first, reading), _either_side(second, reading))
    return last_difference(pair.first, pair.second, tolerance_mm, pair.notices)


def _either_side(shape: Shape, reading: ReadingKeywords) -> list[results.Profiled]:
    """A last by its detected side, and by the other one if that is not sure.

    If the shape shows no side, the last by both; neither is then detected.
    """
    settled = isinstance(shape, results.AlignedScan | results.Profiled)
    if settled or reading.get("side", "auto") != "auto":
        return [profiled_shape(shape, reading)]
    sides: list[results.SideName] = ["right", "left"]
    try:
        shown = [profiled_shape(shape, reading)]
    except SideUndecided:
        shown = []
    if shown:
        side = shown[0].aligned.alignment.side
        sure = side.confidence == "sure" or shown[0].aligned.alignment.info.is_stored_last
        sides = [] if sure else [name for name in sides if name != side.side]
    return shown + [profiled_shape(shape, {**reading, "side": name}) for name in sides]
