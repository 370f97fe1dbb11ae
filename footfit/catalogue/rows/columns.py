"""Every column of the catalogue, in one place.

The schema, writing, reading, the hashes and the checks of plausible values follow these tables.
A new column is one line here and a migration (docs/catalogue.md, "Changing the schema").
A column is never renamed: its name is part of the hashes.

Nothing here opens SQLAlchemy, because ``match`` reads the catalogue without it.
"""

from __future__ import annotations

import dataclasses
import json
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter, itemgetter
from pathlib import PurePath
from typing import Any, Literal, TypeVar, cast

from footfit.catalogue.rows import rules
from footfit.catalogue.rows.array_blobs import (
    array_of,
    blob,
    definition_of,
    definition_text,
    json_text,
)
from footfit.catalogue.rows.digests import Row
from footfit.catalogue.rows.rules import Rule, choice, number
from footfit.geometry.fit.stations import STATIONS
from footfit.geometry.flare.definition import CHANNELS

T = TypeVar("T")
Reader = Callable[[Row], T]


@dataclass(frozen=True, slots=True)
class Kind:
    """How a value of a record is stored in SQLite, and how it is read back.

    ``from_sql`` None leaves a value as SQLite gives it. A null becomes ``null`` in the record.
    ``rule`` is for the columns of this kind that have no rule of their own.
    """

    sql: Literal["integer", "real", "text", "flag", "blob"]
    to_sql: Callable[[Any], Any]
    rule: Rule
    from_sql: Callable[[Any], Any] | None = None
    null: float | None = None


def _text(value: str) -> str:
    """Text that UTF-8 can hold: a file name may be made of any bytes."""
    return value if value.isascii() else value.encode("utf-8", "backslashreplace").decode("utf-8")


def _number(value: float) -> float | None:
    """SQLite keeps NaN as null and -0.0 as 0.0."""
    return None if value != value else float(value) + 0.0


def _array(*shape: int) -> Kind:
    return Kind("blob", blob, rules.array(*shape), lambda data: array_of(data, *shape))


INTEGER = Kind("integer", int, rules.WHOLE)
REAL = Kind("real", _number, number())
REAL_OR_NAN = Kind("real", _number, number(), float, null=math.nan)
TEXT = Kind("text", _text, rules.TEXT)
FLAG = Kind("flag", bool, choice(0, 1), bool)
BYTES = Kind("blob", bytes, rules.BYTES)
FILE_NAME = Kind("text", lambda path: _text(PurePath(path).name), rules.TEXT)
DEFINITION = Kind("text", definition_text, rules.TEXT, definition_of)
JSON = Kind("text", json_text, rules.JSON, json.loads)
VECTOR, SERIES, POINTS, EDGES = _array(3), _array(), _array(-1, 2), _array(-1, 3)
ROTATION, TRANSFORM = _array(3, 3), _array(4, 4)


@dataclass(frozen=True)
class Column:
    """One column.

    ``path`` says where its value stands in the record, such as ``side.score``; it is empty for
    a value that the writer adds. ``rule`` None takes the rule of the kind. ``on_delete`` marks a
    key of a last, and says what happens when that last is removed. ``hashed`` is False for keys,
    which foreign keys check, and for the hash itself; columns are hashed in the order of their
    names. ``read`` is False for a value that another column gives.
    """

    name: str
    kind: Kind
    path: str = ""
    rule: Rule | None = None
    nullable: bool = False
    key: bool = False
    unique: bool = False
    on_delete: Literal["CASCADE", "RESTRICT"] | None = None
    hashed: bool = True
    read: bool = True

    def value_in(self, record: object) -> Any:
        """What is stored of a record."""
        value = self.getter(record)
        return None if value is None else self.kind.to_sql(value)

    @cached_property
    def getter(self) -> Callable[[Any], Any]:
        """What reads the value of a record, also where the path goes through a mapping."""
        mapping = next((name for name in ("curvature.", "sections.") if name in self.path), None)
        if mapping is None:
            return attrgetter(self.path)
        owner, _, rest = self.path.partition(mapping)
        items, (key, *field) = attrgetter(f"{owner}{mapping[:-1]}"), rest.split(".")
        if not field:
            return lambda record: items(record).get(key)
        return lambda record: getattr(items(record).get(key), field[0], None)

    def reader(self) -> Reader[Any]:
        """A function from a row to what the value is in a record."""
        name, from_sql, null = self.name, self.kind.from_sql, self.kind.null
        if from_sql is None:
            return itemgetter(name)
        return lambda row: null if row[name] is None else from_sql(row[name])

    def implausible(self, value: object) -> str | None:
        """What the value must be, in words; None if it is plausible."""
        rule = self.rule or self.kind.rule
        return None if (value is None and self.nullable) or rule.holds(value) else rule.words


@dataclass(frozen=True)
class Table:
    """One table: its columns in the order of the schema; ``single`` allows one row alone."""

    name: str
    columns: tuple[Column, ...]
    single: bool = False

    @cached_property
    def unhashed(self) -> frozenset[str]:
        """The names of the columns that are under no hash."""
        return frozenset(column.name for column in self.columns if not column.hashed)

    @property
    def last_key(self) -> str:
        """The column that says which last a row belongs to; the key of what belongs to none."""
        keys = {"last": "id", "fit": "number", "search_block": "block"}
        return keys.get(self.name, "last_id")

    def row(self, record: object, **added: object) -> Row:
        """The row of a record, with the values that the writer adds."""
        return {c.name: c.value_in(record) for c in self.columns if c.path} | added

    def readers(self, part: str) -> dict[str, Reader[Any]]:
        """A reader for each field of one part of a record: of the paths that begin with it."""
        read = [column for column in self.columns if column.path and column.read]
        split = [(*column.path.rpartition(".")[::2], column.reader()) for column in read]
        return {field: reader for owner, field, reader in split if owner == part}

    def fields_reader(self, part: str) -> Reader[dict[str, Any]]:
        """A function from a row to the fields of one part of a record."""
        steps = self.readers(part)
        return lambda row: {field: step(row) for field, step in steps.items()}

    def reader(self, part: str, made: type[T], **others: Reader[Any]) -> Reader[T]:
        """A function from a row to one part of a record, a ``made``.

        ``others`` read the fields that have no column of this part.

        Raises
        ------
        KeyError
            A field has no column; the function raises it for a row that lacks a column.
        """
        steps = self.readers(part) | others
        ordered = [steps[field.name] for field in dataclasses.fields(cast(Any, made))]
        return lambda row: made(*[step(row) for step in ordered])


def _owned(name: str, *columns: Column, hashed: bool = False) -> Table:
    """A table of rows that belong to a last and are removed with it."""
    owner = Column("last_id", INTEGER, key=True, on_delete="CASCADE", hashed=hashed)
    return Table(name, (owner, *columns))


LAST = Table(
    "last",
    (
        Column("id", INTEGER, key=True, hashed=False),
        Column("name", TEXT, "labels.name", rules.NOT_BLANK, unique=True),
        Column("style", TEXT, "labels.style", nullable=True),
        Column("size", TEXT, "labels.size", nullable=True),
        Column("size_system", TEXT, "labels.size_system", nullable=True),
        Column("width_label", TEXT, "labels.width_label", nullable=True),
        Column("heel_height_mm", REAL, "labels.heel_height_mm", nullable=True),
        Column("family", TEXT, "labels.family", nullable=True),
        Column("parent_id", INTEGER, nullable=True, on_delete="RESTRICT"),
        Column("content_sha256", TEXT, "info.sha256", rules.SHA256, unique=True),
        Column("file_name", FILE_NAME, "info.path", nullable=True),
        Column("format", TEXT, "info.format"),
        Column("units", TEXT, "info.units", choice("mm", "cm", "m", "in", "scaled")),
        Column("units_source", TEXT, "info.units_source", rules.UNITS_SOURCE),
        Column("unit_scale", REAL, "info.unit_scale", rules.ABOVE_ZERO),
        Column("vertices", INTEGER, "info.vertices", rules.ABOVE_ZERO),
        Column("faces", INTEGER, "info.faces", rules.ABOVE_ZERO),
        Column("watertight", FLAG, "info.watertight"),
        Column("side", TEXT, "side.side", choice("left", "right"), nullable=True),
        Column("side_confidence", TEXT, "side.confidence", choice("sure", "low", "undecided")),
        Column("side_score", REAL, "side.score"),
        Column("side_source", TEXT, "side.source", choice("given", "detected")),
        Column("footfit_version", TEXT),
        Column("record_sha256", TEXT, rule=rules.SHA256, hashed=False),
        Column("toe_spring_mm", REAL, "labels.toe_spring_mm", nullable=True),
        Column("platform_mm", REAL, "labels.platform_mm", nullable=True),
    ),
)
"""One last: its labels, what its file was, which side it is."""

FRAME = _owned(
    "frame",
    Column("centroid_mm", VECTOR, "eigenframe.centroid_mm", rules.POINT),
    Column("eigenvectors", ROTATION, "eigenframe.eigenvectors", rules.ROTATION),
    Column("eigenvalues_mm2", VECTOR, "eigenframe.eigenvalues_mm2", rules.MOMENTS),
    Column("printed_centroid_mm", VECTOR, "printed_frame.centroid_mm", rules.POINT),
    Column("printed_eigenvectors", ROTATION, "printed_frame.eigenvectors", rules.ROTATION),
    Column("printed_eigenvalues_mm2", VECTOR, "printed_frame.eigenvalues_mm2", rules.MOMENTS),
    Column("canonical_transform", TRANSFORM, "canonical_transform"),
    Column("paper_transform", TRANSFORM, "paper_transform", nullable=True),
    Column("pose_cost", REAL, "pose.cost", number(0.0)),
    Column("pose_margin", REAL, "pose.margin"),
    Column("pose_support", REAL, "pose.support"),
    Column("pose_sole", FLAG, "pose.sole"),
    Column("pose_kind", TEXT, "pose.kind", choice("foot", "last")),
    Column("length_mm", REAL, "extent_mm", rules.LENGTH),
    Column("standing_transform", TRANSFORM, "standing_transform", nullable=True),
    Column("ground_sd_deg", REAL, "ground_sd_deg", number(0.0), nullable=True),
    Column("stance_by", TEXT, "stance_by", choice("label", "shape"), nullable=True),
)
"""How the last lies: its exact and its printed eigenframe, both transforms, its pose.

``length_mm`` is the mesh's extent along X, under the name that it had first.
"""

FLARE = _owned(
    "flare",
    Column("angle_deg", REAL_OR_NAN, "flare.angle_deg", rules.FLARE_ANGLE, nullable=True),
    Column("angle_sd_deg", REAL_OR_NAN, "flare.angle_sd_deg", number(0.0), nullable=True),
    Column("flare_class", TEXT, "flare.flare_class", rules.FLARE_CLASS),
    Column("definition_version", TEXT, "flare.definition.version", read=False),
    Column("definition", DEFINITION, "flare.definition"),
    Column("stations", SERIES, "flare.stations", rules.STATIONS),
    Column("heading_deg", SERIES, "flare.heading_deg"),
    Column("centre_line", POINTS, "flare.centre_line"),
    *(
        Column(f"curvature_{channel}", SERIES, f"flare.curvature.{channel}", nullable=True)
        for channel in CHANNELS
    ),
    Column("upgraded_from", TEXT, "upgraded_from", nullable=True),
)
"""The flare profile with the definition it follows; a null channel could not be measured."""

MEASURE = _owned(
    "measure",
    Column("name", TEXT, "name", rules.NOT_BLANK, key=True),
    Column("position", INTEGER, rule=number(0)),
    Column("value", REAL, "measured.value", nullable=True),
    Column("sd", REAL, "measured.sd", number(0.0), nullable=True),
    Column("reason", TEXT, "measured.reason", nullable=True),
    Column("definition", TEXT, "definition"),
    Column("total_sd", REAL, "measured.total_sd", number(0.0), nullable=True),
    Column("bias", REAL, "measured.bias", nullable=True),
)
"""One measure of one last: a new measure is a new row, never a new column."""

NOTICE = _owned(
    "notice",
    Column("position", INTEGER, key=True),
    Column("code", TEXT, "code"),
    Column("message", TEXT, "message"),
)
"""One warning that was given when the last was ingested."""

MESH_COPY = _owned(
    "mesh_copy",
    Column("faces", INTEGER, "faces", rules.ABOVE_ZERO),
    Column("error_mm", REAL, "error_mm", number(0.0)),
    Column("data", BYTES, "data"),
    Column("sha256", TEXT, rule=rules.SHA256, hashed=False),
    hashed=True,
)
"""The last's compact mesh; a table of its own, so that ranking reads no mesh."""

SECTION = _owned(
    "section",
    *(
        column
        for station in STATIONS
        for column in (
            Column(
                f"{station.name}_plane", TRANSFORM, f"sections.{station.name}.plane", nullable=True
            ),
            Column(
                f"{station.name}_points_mm",
                POINTS,
                f"sections.{station.name}.points_mm",
                nullable=True,
            ),
        )
    ),
    Column("toes_outline_mm", EDGES, "toes_outline_mm", nullable=True),
    Column("sha256", TEXT, rule=rules.SHA256, hashed=False),
    hashed=True,
)
"""The sections of a last at the named stations; a null station could not be cut."""

PARENTAGE = _owned(
    "parentage",
    Column("base", TEXT, "base", rules.NOT_BLANK),
    Column("base_sha256", TEXT, "base_sha256", rules.SHA256),
    Column("made_by", TEXT, "made_by", choice("customise", "grade")),
    Column("foot_sha256", TEXT, "foot_sha256", rules.SHA256, nullable=True),
    Column("profile", TEXT, "profile", rules.NOT_BLANK, nullable=True),
    Column("profile_version", INTEGER, "profile_version", nullable=True),
    Column("profile_sha256", TEXT, "profile_sha256", rules.SHA256, nullable=True),
    Column("rule", TEXT, "rule", rules.NOT_BLANK, nullable=True),
    Column("figures", JSON, "figures"),
    Column("targets", JSON, "targets"),
    Column("sha256", TEXT, rule=rules.SHA256, hashed=False),
    hashed=True,
)
"""How a last was made from another one; a last that was scanned has no row."""

SEALED = (MESH_COPY, SECTION, PARENTAGE)
"""What has a hash of its own in its row, so that ranking does not read it."""

REFERENCE = Table(
    "reference",
    (
        Column("id", INTEGER, key=True),
        Column("last_id", INTEGER, on_delete="RESTRICT"),
        Column("om_e", ROTATION, "om_e", rules.ROTATION),
        Column("centroid_mm", VECTOR, "centroid_mm", rules.POINT),
        Column("sha256", TEXT, rule=rules.SHA256, hashed=False),
    ),
    single=True,
)
"""The one reference last: OM_E (Eq. 6), and its centroid in its canonical frame."""

FIT = Table(
    "fit",
    (
        Column("number", INTEGER, key=True, hashed=False),
        Column("id", TEXT, "id", rules.NOT_BLANK, unique=True),
        Column("recorded", TEXT, "recorded", rules.NOT_BLANK),
        Column("wearer", TEXT, "wearer", rules.NOT_BLANK, nullable=True),
        Column("last", TEXT, "last", rules.NOT_BLANK),
        Column("last_sha256", TEXT, "last_sha256", rules.SHA256),
        Column("foot_sha256", TEXT, "foot_sha256", rules.SHA256),
        Column("side", TEXT, "side", choice("left", "right"), nullable=True),
        Column("profile", TEXT, "profile", rules.NOT_BLANK),
        Column("profile_version", INTEGER, "profile_version"),
        Column("profile_sha256", TEXT, "profile_sha256", rules.SHA256),
        Column("worn", JSON, "worn"),
        Column("zones", JSON, "zones"),
        Column("ratings", JSON, "ratings"),
        Column("comfort", REAL, "comfort", number(0.0, 100.0), nullable=True),
        Column("outcome", TEXT, "outcome", choice("kept", "returned", "altered"), nullable=True),
        Column("alteration", TEXT, "alteration", nullable=True),
        Column("hours", REAL, "hours", number(0.0), nullable=True),
        Column("days", REAL, "days", number(0.0), nullable=True),
        Column("footfit_version", TEXT, "footfit_version"),
        Column("sha256", TEXT, rule=rules.SHA256, hashed=False),
    ),
)
"""One entry of the fit log. It names its last by name and hash, and outlives it."""

SEARCH_BLOCK = Table(
    "search_block",
    (
        Column("block", INTEGER, key=True, hashed=False),
        Column("part", TEXT, key=True, hashed=False),
        Column("layout", TEXT, hashed=False),
        Column("data", BYTES, hashed=False),
        Column("hash", TEXT, hashed=False),
    ),
)
"""What ranking reads of some lasts, packed (`catalogue.blocks`); made from the other tables."""

TABLES = (
    *(LAST, FRAME, FLARE, MEASURE, NOTICE, MESH_COPY, SECTION, REFERENCE, FIT, PARENTAGE),
    SEARCH_BLOCK,
)
