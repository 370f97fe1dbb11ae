"""A custom last: what was asked of it, what it has, and what moved from its base."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from footfit.results.values import (
    Document,
    Json,
    Notice,
    Part,
    SideName,
    Verdict,
    fields,
    in_mm,
    rows,
)

if TYPE_CHECKING:
    from footfit.geometry.numeric.arrays import Floats, Ints
    from footfit.results.heel import HeelChange
    from footfit.results.last_record import LastRecord, Parentage
    from footfit.results.meshes import ShapeSections


ROOM_WHY = "this is the room that was asked for, and without it the zone is good"
"""Why a zone is not good, if it was good before room for single places was added."""
MeshOfBase = Literal["file", "full copy", "original file", "light copy"]


def target_words(measure: str) -> str:
    """A measure that the foot sets, in words; a girth of the least tape is said to be one.

    Examples
    --------
    >>> target_words("ball_girth_least"), target_words("heel_width")
    ('least ball girth', 'heel width')
    """
    words = measure.replace("_", " ")
    return f"least {words.removesuffix(' least')}" if words.endswith(" least") else words


@dataclass(frozen=True, slots=True)
class BaseMesh(Part):
    """Which mesh of the base was changed: its file, the full copy, or a light copy.

    ``error_mm`` is the largest distance between that mesh and the base's own file.
    """

    kind: MeshOfBase
    error_mm: float


@dataclass(frozen=True, slots=True)
class GirthPlane(Part):
    """Where a girth was taken, in the axes of the written file: ``point_mm`` lies in the plane, and
    ``normal`` has the length 1.
    """

    point_mm: tuple[float, float, float]
    normal: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class CustomZone(Part):
    """A measure that the foot sets: of the base, what it should be, and of the written last.

    ``name`` is that of the measure, and ``zone`` that of the fit profile's zone whose allowance
    counts. ``foot`` is the foot's measure as it would be in the base's heel, and ``allowance`` what
    the target is more than that. ``room`` is what ``--room`` adds to the target. A girth has its
    ``plane``. Each ``sd`` is the spread of a second scan: of the foot, the base and the written
    last. One that ``follows`` has no target of its own: the parts that are kept nearly set it, and
    its target is what the others bring it to.
    """

    name: str
    zone: str
    unit: str
    foot: float | None
    allowance: float | None
    base: float
    target: float
    reached: float
    room: float = 0.0
    follows: bool = False
    plane: GirthPlane | None = None
    foot_sd: float | None = None
    base_sd: float | None = None
    reached_sd: float | None = None

    @property
    def words(self) -> str:
        """The measure in words."""
        return target_words(self.name)

    def _keys(self) -> Json:
        return in_mm(fields(self))


@dataclass(frozen=True, slots=True)
class JudgedZone(Part):
    """A zone of the fit profile in the base and in the custom last, as ``match`` judges it.

    ``why`` says what a custom last keeps of its base, if the zone is not good in it. Each ``sd`` is
    the spread of second scans of foot and last.
    """

    name: str
    label: str
    unit: str
    target: float
    base: float | None
    base_verdict: Verdict | None
    custom: float | None
    custom_verdict: Verdict | None
    why: str | None = None
    base_sd: float | None = None
    custom_sd: float | None = None

    def _keys(self) -> Json:
        return in_mm(fields(self))


@dataclass(frozen=True, slots=True)
class KeptPlace(Part):
    """A part that a custom last keeps from its base, and by how much it moved all the same."""

    name: str
    moved_mm: float


@dataclass(frozen=True, slots=True)
class RoomPlace(Part):
    """A place that ``--room`` gives a swelling: what was asked for, and what it comes to.

    ``reached_mm`` is how far the surface moves there at most, over the same last without the room.
    """

    name: str
    asked_mm: float
    reached_mm: float


@dataclass(frozen=True, slots=True)
class BetterInStock(Part):
    """The best last of the catalogue that fits the foot better than the custom last, with both
    verdicts.
    """

    last: str
    verdict: Verdict
    custom_verdict: Verdict | None


@dataclass(frozen=True, slots=True)
class ToeBoxChange(Part):
    """By how much the toe box was changed between the ball and the toe, which keeps its shape.

    Where that is most, the outer and the inner wall lie so much farther out, and the top so much
    higher.
    """

    outer_mm: float = 0.0
    inner_mm: float = 0.0
    higher_mm: float = 0.0


@dataclass(frozen=True, slots=True)
class CustomLast(Document):
    """A last that was made from a base for one foot.

    ``kept`` are the parts that must not move. ``toe_shift_mm`` is how far the toe moved ahead as a
    whole, and ``flare_turn_deg`` how far the plan was turned. ``toe_box`` is what changed behind
    the toe so that the toes fit. ``largest_move_mm`` is that of any
    place of the surface. ``least_determinant`` says how far the change is from a fold: 1 keeps all
    volumes, 0 folds. The mesh is in the axes of the written file, with ``moved_mm`` (n,) + outward
    at each vertex; ``base_vertices_mm`` (n, 3) is the base there. ``output`` is the written file.
    ``better_in_stock`` is None if there is no catalogue, or no last of it fits better.
    """

    base: str
    base_sha256: str
    base_mesh: BaseMesh
    foot: str | None
    foot_sha256: str
    side: SideName
    mirrored: bool
    profile: str
    profile_version: int
    profile_sha256: str
    heel: HeelChange | None
    zones: tuple[CustomZone, ...]
    judged: tuple[JudgedZone, ...]
    kept: tuple[KeptPlace, ...]
    toe_shift_mm: float
    flare_turn_deg: float
    largest_move_mm: float
    least_determinant: float
    warnings: tuple[Notice, ...]
    record: LastRecord
    sections: ShapeSections
    parentage: Parentage
    vertices_mm: Floats
    base_vertices_mm: Floats
    faces: Ints
    moved_mm: Floats
    rooms: tuple[RoomPlace, ...] = ()
    better_in_stock: BetterInStock | None = None
    toe_box: ToeBoxChange = ToeBoxChange()
    output: str | None = None
    stored_as: str | None = None

    schema = "customise/1"
    columns = (
        *("last", "side", "output", "measure", "zone", "unit", "foot", "allowance", "room"),
        *("base", "target", "reached", "follows", "foot_sd", "base_sd", "reached_sd"),
    )
    not_written = (
        *("record", "sections", "parentage", "vertices_mm", "base_vertices_mm"),
        *("faces", "moved_mm"),
    )

    @property
    def verdict(self) -> Verdict | None:
        """The worst verdict of the zones that could be judged."""
        order: tuple[Verdict, ...] = ("good", "acceptable", "poor", "reject")
        known = [zone.custom_verdict for zone in self.judged if zone.custom_verdict is not None]
        return max(known, key=order.index) if known else None

    def rows(self) -> list[Json]:
        """A table: a row for each measure that the foot sets, with what was asked and reached."""
        start = (self.record.labels.name, self.side, self.output)
        values = []
        for zone in self.zones:
            known = zone.to_dict()  # with the decimals that JSON has
            values.append((*start, zone.name, *(known[name] for name in self.columns[4:])))
        return rows(self.columns, values)

    def _keys(self) -> Json:
        mesh = {"faces": len(self.faces), "vertices": len(self.vertices_mm)}
        return fields(self, *self.not_written) | {"verdict": self.verdict, "mesh": mesh}
