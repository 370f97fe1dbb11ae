"""A graded run: from the base outwards, size by size, each last measured again from its file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field

from footfit.errors import ImplausibleSize, NotAFoot, OutOfReach
from footfit.geometry.measures.landmarks import Shape
from footfit.geometry.stance.cues import StanceLabels
from footfit.meshes.write import encoded_mesh
from footfit.number_words import plain
from footfit.pipeline.batch.run_manifest import said_notices
from footfit.pipeline.batch.sources import RUN_MANIFEST, ReadingOptions, Source
from footfit.pipeline.graded_runs.grade_plan import (
    HEEL,
    SPRING,
    Fitting,
    GradePlan,
    Planned,
    standing,
    targets,
)
from footfit.pipeline.graded_runs.grade_shape import HELD, LENGTH, GradeStep, graded, graded_mm
from footfit.pipeline.graded_runs.graded_reading import (
    flare_of,
    measures_of,
    planes_of,
    spreads_of,
)
from footfit.pipeline.last_making.base_last import BaseLast
from footfit.pipeline.last_making.tolerances import TOLERANCE_MM
from footfit.pipeline.scan.preparation import right_copy
from footfit.pipeline.scan.reading import prepared_source
from footfit.pipeline.scan.standing import heights_by_shape
from footfit.results import LastLabels, Notice, PreparedScan
from footfit.results.last_making.graded_run import GradedLast, GradedMeasure, GradedRun

REFINED_MM = 0.03
"""A last is graded again if a measure of its file is farther from the plan."""
REFINEMENTS = 4
REFINED_BY = 0.85
"""A refinement takes back this share of a miss: the file answers by a little more than the frame,
and a reading may jump."""
ENDS = (HEEL, SPRING)
Place = tuple[float, float]
"""How many sizes and widths a last is from the base."""


@dataclass(frozen=True)
class Node:
    """A last on the way: its right shape in the base's frame, and where it is from the base.

    ``raised_mm`` is how far its seat and its tip were raised on the way, by measure.
    """

    shape: Shape
    sizes: float
    widths: float
    raised_mm: Mapping[str, float] = field(default_factory=lambda: dict.fromkeys(ENDS, 0.0))


@dataclass(frozen=True)
class Grader:
    """A base with its plan. ``base_mm`` are its measures, and ``base_flare_deg`` is its flare, read
    from a file as those of its lasts are.
    """

    base: BaseLast
    plan: GradePlan
    family: str
    first: Node
    base_mm: Mapping[str, float]
    in_frame_mm: Mapping[str, float]
    base_flare_deg: float | None

    def lasts(self) -> Iterator[GradedLast]:
        """Every last of the plan, from the base outwards in both directions.

        Raises
        ------
        OutOfReach
            A last cannot be reached; the message names it.
        """
        made: dict[Place, Node] = {(0.0, 0.0): self.first}
        for fitting in sorted(self.plan.fittings, key=_away):
            here = fitting.sizes, fitting.widths
            try:
                if here in made:
                    yield self._written(made[here], fitting)
                    continue
                made[here], last = self._last(self._node(made, *_before(*here)), fitting)
            except OutOfReach as error:
                raise OutOfReach(f"{self.name_of(fitting)}: {error.message}") from error
            except (ImplausibleSize, NotAFoot) as error:  # no last is so long, or has that form
                words = "would be longer or shorter than any last: ask for sizes nearer to the base"
                raise OutOfReach(f"{self.name_of(fitting)} {words}") from error
            yield last

    def names(self) -> tuple[str, ...]:
        """The names of all lasts of the plan."""
        return tuple(map(self.name_of, self.plan.fittings))

    def run(self, lasts: Iterable[GradedLast]) -> GradedRun:
        """The whole run, the smallest size and the narrowest width first."""
        record, plan = self.base.record, self.plan
        ordered = tuple(sorted(lasts, key=lambda last: (last.sizes, last.widths)))
        return GradedRun(
            base=self.base.name,
            base_sha256=record.info.sha256,
            base_size=plan.start.size,
            base_width=plan.start.width,
            side=record.side.side,
            family=self.family,
            mesh=self.base.mesh,
            size_system=plan.system.name,
            rule=plan.rule,
            held=tuple(name for name in HELD if name in plan.held),
            lasts=ordered,
            warnings=(
                *said_notices(record.warnings, record.info.path),
                *read_otherwise(ordered),
            ),
        )

    def name_of(self, fitting: Fitting) -> str:
        """The name of a last of the run."""
        size = fitting.size.replace(" ", "-").replace("/", "-")
        width = "" if fitting.width is None else f"-{fitting.width}"
        return f"{self.family}-{self.plan.system.name}{size}{width}"

    def _node(self, made: dict[Place, Node], sizes: float, widths: float) -> Node:
        """The last in a place, which is made from the one before it, asked for or not."""
        if (sizes, widths) not in made:
            before = self._node(made, *_before(sizes, widths))
            made[sizes, widths], _ = self._last(before, Fitting("", None, sizes, widths))
        return made[sizes, widths]

    def _step(
        self, node: Node, sizes: float, widths: float, shift_mm: Mapping[str, float] | None = None
    ) -> Node:
        """The last so many sizes and widths from the base, made from a neighbour."""
        planned = self._targets(sizes, widths)
        before = self._targets(node.sizes, node.widths)
        own = {
            name: self.in_frame_mm[name] + goal.target - self.base_mm[name]
            for name, goal in planned.items()
            if name not in (HEEL, SPRING)
        }
        shift = shift_mm or {}
        own = {name: target + shift.get(name, 0.0) for name, target in own.items()}
        step = GradeStep(
            ratio=planned[LENGTH].target / before[LENGTH].target,
            targets_mm=own,
            held=self.plan.held,
            labels=self._stands(planned),
            more_mm=(shift.get(HEEL, 0.0), shift.get(SPRING, 0.0)),
        )
        raised = {name: node.raised_mm[name] + shift.get(name, 0.0) for name in ENDS}
        return Node(graded(node.shape, step), sizes, widths, raised)

    def _targets(self, sizes: float, widths: float) -> dict[str, Planned]:
        return targets(self.plan, self.base_mm, sizes, widths)

    def _stands(self, planned: Mapping[str, Planned]) -> StanceLabels:
        return standing(planned, self.base.record.labels.platform_mm)

    def _last(self, node: Node, fitting: Fitting) -> tuple[Node, GradedLast]:
        """A last of the run, made from a neighbour; made again if its file reads otherwise."""
        shift: dict[str, float] = {}
        best: tuple[float, Node, GradedLast] | None = None
        for _ in range(1 + REFINEMENTS):
            new = self._step(node, fitting.sizes, fitting.widths, shift)
            last = self._written(new, fitting)
            misses = self._misses(new, last)
            worst = max(map(abs, misses.values()), default=0.0)
            if best is None or worst < best[0]:
                best = worst, new, last
            if worst <= REFINED_MM:
                break
            for name, miss in misses.items():
                shift[name] = shift.get(name, 0.0) - REFINED_BY * miss
        assert best is not None
        return best[1:]

    def _misses(self, node: Node, last: GradedLast) -> dict[str, float]:
        """What a step should take back of each measure, in mm.

        A held bottom is to stay, and so are its heel and its spring as they read. If the reading
        moves, because its line lies over another part of a longer seat, each of the two gets half.
        """
        misses = {m.name: m.difference for m in last.measures if m.difference is not None}
        if "bottom" not in self.plan.held:
            return misses
        raised = node.raised_mm
        both = {name: 0.5 * (misses[name] + raised[name]) for name in ENDS if name in misses}
        return misses | both

    def _written(self, node: Node, fitting: Fitting) -> GradedLast:
        """A last with the content of its file, and the measures that are read from that."""
        planned = self._targets(fitting.sizes, fitting.widths)
        stands = self._stands(planned)
        data = file_of(node.shape, self.base)
        said = self.base.record.labels
        labels = LastLabels(
            name=self.name_of(fitting),
            style=said.style,
            size=fitting.size,
            size_system=self.plan.system.name,
            width_label=fitting.width,
            heel_height_mm=stands.heel_height_mm,
            toe_spring_mm=stands.toe_spring_mm,
            platform_mm=said.platform_mm,
            family=self.family,
        )
        scan = file_scan(data, self.base, stands)
        shape = scan.shape
        reached, sd = measures_of(shape), spreads_of(shape)
        planes = planes_of(scan, frozenset(reached))
        measures = tuple(
            GradedMeasure(
                name=name,
                unit="mm",
                base=value,
                planned=planned[name].target if name in planned else None,
                reached=reached.get(name),
                by=planned[name].by if name in planned else "follows",
                sd=sd.get(name),
                plane=planes.get(name),
            )
            for name, value in self.base_mm.items()
        )
        return GradedLast(
            last=labels.name,
            size=fitting.size,
            width=fitting.width,
            sizes=fitting.sizes,
            widths=fitting.widths,
            measures=measures,
            labels=labels,
            data=data,
            heel_by_shape_mm=heights_by_shape(shape.stance).get(HEEL),
            flare=self._flare(shape),
        )

    def _flare(self, shape: Shape) -> GradedMeasure | None:
        """The flare of a last: that of the base is planned."""
        base_deg, own = self.base_flare_deg, flare_of(shape)
        if base_deg is None or own is None:
            return None
        return GradedMeasure("flare_angle", "deg", base_deg, base_deg, own[0], "kept", own[1])


def family_of(labels: LastLabels, size: str) -> str:
    """The family of a base: its label, else its name without its size.

    Examples
    --------
    >>> family_of(LastLabels("derby-42"), "42"), family_of(LastLabels("x", family="derby"), "42")
    ('derby', 'derby')
    """
    name = labels.name.removesuffix(size).rstrip("-_ ")
    return labels.family or name or labels.name


def grader(base: BaseLast, plan: GradePlan, family: str) -> Grader:
    """What grades a base by a plan.

    Raises
    ------
    OutOfReach
        The base lacks its length, so nothing can be planned.
    """
    stands = base.shape.labels
    base_mm: dict[str, float] = {}
    read = base.shape
    for _ in range(2):  # the second time on the ground that its own heel and spring give
        read = file_scan(file_of(base.shape, base), base, stands).shape
        base_mm = measures_of(read)
        if LENGTH not in base_mm:
            raise OutOfReach("its length along the bottom cannot be measured: take a whole last")
        stands = standing(targets(plan, base_mm, 0.0, 0.0), base.record.labels.platform_mm)
    own = Shape(base.shape.vertices_mm, base.shape.faces, "last", stands)
    in_frame = {name: graded_mm(own, name) for name in base_mm}
    kept = {name: value for name, value in in_frame.items() if math.isfinite(value)}
    flare = flare_of(read)
    return Grader(
        base=base,
        plan=plan,
        family=family,
        first=Node(own, 0.0, 0.0),
        base_mm={name: value for name, value in base_mm.items() if name in kept},
        in_frame_mm=kept,
        base_flare_deg=None if flare is None else flare[0],
    )


def file_of(shape: Shape, base: BaseLast) -> bytes:
    """The file of a right shape: an STL in mm, in the base's frame, of the base's side."""
    return encoded_mesh(*right_copy(shape.vertices_mm, shape.faces, base.record.side.side), "stl")


def file_scan(data: bytes, base: BaseLast, stands: StanceLabels) -> PreparedScan:
    """The last that is read from the content of its file."""
    return prepared_source(Source(None, data, "stl"), reading_of(base, stands))


def read_otherwise(lasts: Iterable[GradedLast]) -> tuple[Notice, ...]:
    """A warning if lasts stand as planned by their labels alone; it names the worst."""
    off = {last.last: last.heel_off_mm for last in lasts}
    off = {name: mm for name, mm in off.items() if abs(mm) > TOLERANCE_MM["height"]}
    if not off:
        return ()
    name, mm = max(off.items(), key=lambda each: abs(each[1]))
    count = "" if len(off) == 1 else f", and {len(off) - 1} more lasts of the run are off"
    how = "high" if mm > 0.0 else "low"
    words = f"without its label, the heel of {name!r} reads {plain(abs(mm))} mm too {how}{count}"
    return (Notice("heel_by_label", f"{words}: keep {RUN_MANIFEST} beside the files"),)


def reading_of(base: BaseLast, stands: StanceLabels) -> ReadingOptions:
    """How the file of a graded last is read: as a last, whatever its shape is near to."""
    return ReadingOptions(
        units="mm",
        side=base.record.side.side or "auto",
        kind="last",
        heel_height_mm=stands.heel_height_mm,
        toe_spring_mm=stands.toe_spring_mm,
        platform_mm=stands.platform_mm or None,
    )


def _away(fitting: Fitting) -> tuple[float, float]:
    return abs(fitting.sizes), abs(fitting.widths)


def _before(sizes: float, widths: float) -> Place:
    """From which last another one is made: a width or a size nearer to the base.

    Widths are changed where the last is longer, so that a run leads back: a larger last gets its
    size first, a smaller one its width.

    Examples
    --------
    >>> _before(2.0, 1.0), _before(-2.0, 1.0)
    ((2.0, 0.0), (-1.0, 1.0))
    """
    if sizes < 0.0 or not widths:
        return _nearer(sizes), widths
    return sizes, _nearer(widths)


def _nearer(steps: float) -> float:
    """The next step towards the base; the way down stops where the way up from there does.

    Examples
    --------
    >>> [_nearer(steps) for steps in (2.0, 2.5, -1.0, -0.5, -2.5)]
    [1.0, 2.0, 0.0, 0.0, -1.5]
    """
    if steps > 0.0:
        return math.ceil(steps - 1e-9) - 1.0
    return min(round(steps + 1.0, 9), 0.0)
