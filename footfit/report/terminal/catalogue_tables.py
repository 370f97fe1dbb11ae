"""Answers about the catalogue as rich renderables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from rich.console import Group, RenderableType
from rich.text import Text

from footfit import results
from footfit.geometry.fit.sizes import LabelCheck, label_words
from footfit.number_words import bound_words, first_names, plain, signed
from footfit.report.terminal.scan_tables import (
    cell,
    eigenvalue_words,
    facts,
    lined_table,
    side_words,
)
from footfit.report.wording.text import (
    SPREADS,
    class_words,
    length_text,
    measured_text,
    size_text,
    turn_words,
    visible,
)

MEGABYTE = 1_000_000


class Mark(NamedTuple):
    """A letter for warnings of these codes, and what it says of a last."""

    letter: str
    codes: frozenset[str]
    words: str


MARKS = (
    Mark(
        "S",
        frozenset({"side_contradicted"}),
        "the shape looks like the other side than the one that was given",
    ),
    Mark("U", frozenset({"low_side_confidence"}), "the side is not sure"),
    Mark("F", frozenset({"looks_like_a_foot"}), "the shape is nearer to a foot's than to a last's"),
    Mark(
        "L",
        frozenset({"size_contradicted"}),
        "the size on the label is more than a size from the length",
    ),
    Mark("O", frozenset({"suspect_flare"}), "hardly any last has such a flare"),
    Mark(
        "H",
        frozenset({"stance_label_contradicted"}),
        "the shape contradicts the labels of heel height, toe spring or platform",
    ),
)
"""The warnings with a mark of their own; their sentences stand below the list."""
OTHER = Mark("W", frozenset(), "another warning of the scan")
NAMED = 3
"""So many lasts are named beside a mark."""


def marks_of(record: results.LastRecord) -> tuple[Mark, ...]:
    """The marks of a last: one for each kind of its warnings, stored ones and those of its labels.

    Examples
    --------
    >>> MARKS[0].letter, OTHER.letter
    ('S', 'W')
    """
    codes = {notice.code for notice in record.notices}
    known = tuple(mark for mark in MARKS if mark.codes & codes)
    return known if codes <= frozenset().union(*(m.codes for m in MARKS)) else (*known, OTHER)


def list_lasts_table(library: results.Library) -> RenderableType:
    """The library, one line per last: a star marks the reference, letters mark warnings."""
    ordered, reference = library.ordered(), library.reference
    numbers = ("length\nmm", "ball\nmm", "flare\ndeg", "heel\nmm")
    heads = ("last", "!", "style", "size", "side", *numbers[:3], "class", numbers[3])
    table = lined_table(*heads, right=frozenset(numbers))
    marked: dict[Mark, list[str]] = {}
    for record in ordered:
        labels, marks = record.labels, marks_of(record)
        for mark in marks:
            marked.setdefault(mark, []).append(labels.name)
        star = " *" if labels.name == reference else ""
        table.add_row(
            cell(labels.name, "bold").append(star),
            cell("".join(mark.letter for mark in marks), "bold yellow"),
            cell(labels.style),
            cell(size_text(labels)),
            record.side.side or "undecided",
            _number(record.length_mm),
            _number(record.value_of("ball_girth"), 0),
            signed(record.flare.angle_deg),
            record.flare.flare_class or "-",
            _number(record.drop_mm, 0),
        )
    lines = (*_legend(marked), *_made(ordered), Text(_count(library, len(ordered)), "dim"))
    return Group(table, *lines)


def _number(value: float | None, digits: int = 1) -> str:
    return "-" if value is None else plain(value, digits)


def _legend(marked: Mapping[Mark, Sequence[str]]) -> list[Text]:
    """What each mark in the list says, with the lasts that have it."""
    lines = []
    for mark in (*MARKS, OTHER):
        names = marked.get(mark, ())
        if names:
            lines.append(Text(f"{mark.letter}  {mark.words}: {_named(names)}", "yellow"))
    return [*lines, Text("footfit show-last NAME says more", "dim")] if lines else []


def _named(names: Sequence[str]) -> str:
    return first_names([visible(name) for name in names], NAMED)


def _made(records: Sequence[results.LastRecord]) -> list[Text]:
    """Which lasts were made from which, a line for each parent."""
    parents = sorted({each.labels.parent for each in records if each.labels.parent})
    children = {
        parent: [each.labels.name for each in records if each.labels.parent == parent]
        for parent in parents
    }
    return [
        Text(f"made from {visible(parent)}: {_named(names)}", "dim")
        for parent, names in children.items()
    ]


def _count(library: results.Library, listed: int) -> str:
    """How many lasts are listed, and which one is the reference."""
    noun = "last" if listed == 1 else "lasts"
    count = f"{listed} {noun}"
    if library.filters:
        asked = ", ".join(f"{name.replace('_', ' ')} {visible(v)}" for name, v in library.filters)
        count = f"{listed} of {library.total} lasts: {asked}"
    reference = library.reference
    if reference is None:
        return f"{count}; no reference is set"
    return f"{count}; * {visible(reference)} is the reference"


def off_label(record: results.LastRecord) -> LabelCheck | None:
    """The check of a label that is more than a size from its last's length, else None."""
    check = record.label_check
    return check if check is not None and check.flagged else None


def _size_row(record: results.LastRecord) -> Text:
    """The size on the label, and what is wrong with it."""
    labels, off = record.labels, off_label(record)
    size = cell(size_text(labels))
    return size.append(f" ! {label_words(off)}", "yellow") if off else size


def show_last_table(last: results.StoredLast) -> RenderableType:
    """What a person reads of one last."""
    record, reference = last.record, last.reference
    labels, flare, info = record.labels, record.flare, record.info
    upgraded = f", upgraded from {record.upgraded_from}" if record.upgraded_from else ""
    turned = f"{turn_words(flare, 'deg')}{class_words(flare)}"
    return facts(
        ("style", cell(labels.style)),
        ("size", _size_row(record)),
        ("family, parent", cell(", ".join(p for p in (labels.family, labels.parent) if p))),
        ("heel", "-" if labels.heel_height_mm is None else f"{plain(labels.heel_height_mm)} mm"),
        *_stance_labels(record),
        ("side", side_words(record.side)),
        ("length", length_text(record.length)),
        ("flare", f"{turned}, definition {visible(flare.definition.version)}{upgraded}"),
        *_parentage(last.parentage),
        *_measures(record),
        ("±", Text(SPREADS, "dim")),
        ("reference", "this is the reference last" if labels.name == reference else "no"),
        ("paper's frame", _paper_words(last)),
        ("eigenvalues", eigenvalue_words(record.eigenframe)),
        ("mesh", f"{info.vertices:,} vertices, {info.faces:,} faces, {info.units} in the file"),
        ("content", f"sha256 {info.sha256}"),
        *(("warning", cell(notice.message, "yellow")) for notice in record.warnings),
        title=labels.name,
    )


def _stance_labels(record: results.LastRecord) -> list[tuple[str, str | Text]]:
    """The labels of platform and toe spring, if there are any, and what decides the stance."""
    labels = record.labels
    said = (("platform", labels.platform_mm), ("toe spring label", labels.toe_spring_mm))
    rows: list[tuple[str, str | Text]] = [
        (name, f"{plain(value)} mm") for name, value in said if value
    ]
    if record.stance_by is not None:
        rows.append(("stands by", f"its {record.stance_by}"))
    return rows


def _parentage(parentage: results.Parentage | None) -> list[tuple[str, Text]]:
    """How a last was made from another one, and each target beside what was reached."""
    if parentage is None:
        return []
    how = {"grade": f"graded by the rule {parentage.rule}", "customise": "made for a foot"}
    profile = f" to the fit profile {parentage.profile}" if parentage.profile else ""
    made = f"{parentage.base}, {how[parentage.made_by]}{profile}"
    return [("made from", cell(made)), *map(_target, parentage.targets)]


def _target(target: results.Target) -> tuple[str, Text]:
    values = (("", target.target), ("reached", target.reached), ("the base has", target.base))
    words = (
        f"{name} {'-' if value is None else plain(value)} {target.unit}".strip()
        for name, value in values
    )
    return f"target {target.name.replace('_', ' ')}", cell(", ".join(words))


def _measures(record: results.LastRecord) -> list[tuple[str, str | Text]]:
    """Every stored measure except the length, which has its own row."""
    return [
        (measure.words, cell(measured_text(measure.measured, measure.unit)))
        for measure in record.measures
        if measure.name != "length"
    ]


def _paper_words(last: results.StoredLast) -> str:
    angle = last.paper_frame_angle_deg
    if angle is None:
        return "none: no reference is set"
    return f"turned by {plain(angle)} deg from footfit's"


def catalogue_info_table(info: results.CatalogueFacts) -> RenderableType:
    """Where the catalogue is, what it holds, and that it keeps no feet."""
    error = info.worst_copy_error_mm
    worst = "" if error is None else f", {bound_words(error)} from the file's mesh"
    size = plain(info.mesh_copy_bytes / MEGABYTE)
    return facts(
        ("catalogue", cell(info.path)),
        ("size", f"{plain(info.bytes / MEGABYTE)} MB, schema {visible(info.schema_revision)}"),
        ("lasts", _total_words(info.lasts, info.sides)),
        ("reference", cell(info.reference)),
        ("styles", _count_words(info.styles)),
        ("size systems", _count_words(info.size_systems)),
        ("definitions", _count_words(info.definitions)),
        ("mesh copies", f"{info.mesh_copies}, {size} MB{worst}"),
        ("rows kept", _count_words(info.kept)),
        ("feet", "no scan: it is read, matched and forgotten"),
    )


def _count_words(counts: Iterable[tuple[str, int]]) -> Text:
    return cell(", ".join(f"{name or 'none'} {count}" for name, count in counts))


def _total_words(total: int, sides: Iterable[tuple[str, int]]) -> Text:
    split = ", ".join(f"{count} {name}" for name, count in sides)
    return cell(f"{total} ({split})" if split else str(total))


def set_reference_line(outcome: results.ReferenceOutcome) -> Text:
    """The new reference last, and how many frames were rewritten."""
    noun = "frame" if outcome.rewritten == 1 else "frames"
    line = Text("reference  ").append(visible(outcome.reference.last), "bold")
    return line.append(f"  {outcome.rewritten} stored {noun} rewritten", "not bold")


def edit_last_table(outcome: results.EditOutcome) -> RenderableType:
    """The labels that changed, and what was measured again."""
    rows = [
        (label.removesuffix("_mm").replace("_", " "), f"{_label_words(old)} to {_label_words(new)}")
        for label, old, new in outcome.changes
    ]
    if outcome.measured_again:
        names = ", ".join(name.replace("_", " ") for name in outcome.measured_again)
        rows.append(("measured again", names))
    return facts(*rows, title=f"{outcome.status}  {outcome.last}")


def _label_words(value: str | float | None) -> str:
    """A label's value; a number is in mm."""
    if value is None:
        return "none"
    return visible(value) if isinstance(value, str) else f"{value:g} mm"


def rename_last_line(outcome: results.RenameOutcome) -> Text:
    """A last under its new name."""
    names = f"{visible(outcome.renamed_from)} to {visible(outcome.last)}"
    return Text("renamed  ").append(names, "bold")


def remove_last_line(outcome: results.RemoveOutcome) -> Text:
    """A last that was removed; after the last one, what becomes of the catalogue."""
    line = Text("removed  ").append(visible(outcome.last), "bold")
    if outcome.left:
        return line
    words = "the catalogue is empty: the next last that you ingest becomes the reference"
    return line.append(f"  {words}", "not bold")


def export_last_line(outcome: results.ExportOutcome) -> Text:
    """The file of a last, and how far its mesh is from the original."""
    line = Text("exported  ").append(visible(outcome.last), "bold")
    line.append(f" to {visible(outcome.output)}")
    if outcome.faces is not None and outcome.error_mm is not None:
        near = bound_words(outcome.error_mm)
        line.append(f"  {outcome.faces:,} faces, {near} from the file's mesh")
    if outcome.sections is not None and outcome.outlines is not None:
        line.append(f"\nsections  {visible(outcome.sections)}, {visible(outcome.outlines)}")
    return line


def upgrade_catalogue_line(outcome: results.UpgradeOutcome) -> RenderableType:
    """What the upgrade changed, and where the old file is."""
    before, after = visible(outcome.revision_before), visible(outcome.revision_after)
    schema = f"{after}, as before" if before == after else f"{before} to {after}"
    count = len(outcome.recomputed)
    return facts(
        ("catalogue", cell(outcome.path)),
        ("schema", schema),
        ("lasts", f"{count} measured again by {visible(outcome.definition)}"),
        ("left", ", ".join(map(visible, outcome.left)) or "none"),
        ("backup", cell(outcome.backup)),
    )


def demo_table(demo: results.DemoOutcome) -> RenderableType:
    """The files of the demo; the page is in the last line."""
    return facts(
        ("folder", cell(demo.folder)),
        ("lasts", str(demo.lasts)),
        ("best last", cell(demo.best, "bold")),
        *(("file", cell(output)) for output in demo.outputs),
    )


def check_catalogue_table(outcome: results.CheckOutcome) -> RenderableType:
    """What was checked, and a line for each finding."""
    line = Text("checked  ").append(visible(outcome.path), "bold")
    line.append(f"  {outcome.lasts} lasts, {outcome.mesh_copies} mesh copies", "not bold")
    if not outcome.findings:
        return line.append("  sound", "green")
    table = lined_table("found", "last", "what")
    for finding in outcome.findings:
        table.add_row(cell(finding.code), cell(finding.last, "bold"), cell(finding.message))
    return Group(line, table)


def backup_catalogue_line(outcome: results.BackupOutcome) -> Text:
    """Where the copy is, and what it holds."""
    line = Text("backed up  ").append(visible(outcome.path), "bold")
    size = plain(outcome.bytes / MEGABYTE)
    return line.append(
        f" to {visible(outcome.backup)}  {outcome.lasts} lasts, {size} MB, checked", "not bold"
    )


def copy_catalogue_line(outcome: results.CopyOutcome) -> Text:
    """Where the copy is, and what it holds."""
    line = Text("copied  ").append(visible(outcome.path), "bold")
    entries = "entry" if outcome.fits == 1 else "entries"
    words = f"{outcome.lasts} lasts, {outcome.fits} {entries} of the fit log, checked"
    return line.append(f" to {visible(outcome.copy)}  {words}", "not bold")


def restore_catalogue_table(outcome: results.RestoreOutcome) -> RenderableType:
    """What was restored, and where the old file is."""
    return facts(
        ("catalogue", cell(outcome.path)),
        ("from", cell(outcome.backup)),
        ("lasts", str(outcome.lasts)),
        ("the one before", cell(outcome.kept)),
    )
