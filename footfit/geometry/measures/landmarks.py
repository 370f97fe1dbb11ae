"""Landmarks of a canonical right shape, found by geometry: without markers, without a template.

mm; x from heel to toe, y to the medial side, z up.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from footfit.geometry.flare.definition import FlareDefinition
from footfit.geometry.flare.flattened import Flattened, flattened
from footfit.geometry.flare.leaning_shank import heel_end
from footfit.geometry.flare.levelled_bottom import low_length
from footfit.geometry.measures.bottom_arc import BottomArc, bottom_arc
from footfit.geometry.measures.tape import ConeCut, Crown, cone_cut, crosses_cone, touched_mm
from footfit.geometry.measures.top_cut import TOP_CUT, runs_over_cut, top_cut_faces
from footfit.geometry.mesh.filled_holes import filled_faces
from footfit.geometry.mesh.outermost_point import LAST_TIPS, TIPS, Tip, TipSettings, tip
from footfit.geometry.mesh.outlines import OUTLINES, Outline, OutlineSettings, outline
from footfit.geometry.numeric.arrays import Bools, Floats, Ints
from footfit.geometry.stance.cues import NO_LABELS, StanceLabels
from footfit.geometry.stance.stance import Stance, stance_of

AXES = np.eye(3)
BACK_AND_DOWN = np.array([-1.0, 0.0, -1.0]) / np.sqrt(2.0)


@dataclass(frozen=True, slots=True)
class LandmarkSettings:
    """Where landmarks are looked for; heights and places over the length."""

    length_height: float = 0.30  # higher parts are leg
    toes: float = 0.30  # so far back from the foremost point a last has toes
    width_height: float = 0.20  # over the floor; above it ankles may stand out
    inner_joint: tuple[float, float] = (0.60, 0.82)  # MT1 of a foot lies at .72, MT5 at .63
    outer_joint: tuple[float, float] = (0.52, 0.76)
    joint_edge: float = 0.008  # a joint this close to the edge of its search window is rejected
    waist: float = 0.40
    instep: float = 0.50
    cone: float = 0.15  # a place on a last's cone
    top_crossed: float = 0.05  # a section that runs farther over the top cut is not measured
    gap: float = 0.03  # a section with a wider gap is not measured
    ground: float = 0.006  # a flat sole lies so near to the ground
    filled_crossed: float = 0.05  # a tape that runs farther over a filled hole is not read
    touched: float = 0.008  # what lies so deep under a tape is touched by it
    crown: float = 0.004  # what is so near to a section's highest point is its crown
    filled_beside: float = 0.004  # a joint this near to a filled hole may have lain in it


LANDMARKS = LandmarkSettings()


@dataclass(frozen=True)
class Shape:
    """A canonical right shape; each landmark is found when it is first read, and kept.

    ``vertices_mm`` (n, 3), ``faces`` (m, 3) wound outward, ``kind`` "foot" or "last", ``labels``
    what people say of how a last stands. A scan has one shape, which all methods read. Between
    processes only these four travel.
    """

    vertices_mm: Floats
    faces: Ints
    kind: str = "foot"
    labels: StanceLabels = NO_LABELS

    def __reduce__(self) -> tuple[type[Shape], tuple[Floats, Ints, str, StanceLabels]]:
        """What a copy is made from: without what was found on this one."""
        return Shape, (self.vertices_mm, self.faces, self.kind, self.labels)

    # ------------------------------------------------------------ the ends

    @cached_property
    def low(self) -> Ints:
        """The faces (k, 3) that are not leg; all of them if none is low."""
        height_mm = LANDMARKS.length_height * self._rough_length_mm
        low = self._faces_of(self.vertices_mm[:, 2] < height_mm)
        return low if len(low) else self.faces

    def under(self, height: float) -> Ints:
        """The faces (k, 3) lower than a height over the length, without those that fill a hole."""
        a, b, c = (self.vertices_mm[:, 2] < height * self.length_mm)[self.faces.T]
        return np.asarray(self.faces[a & b & c & ~self.filled])

    @cached_property
    def ends(self) -> tuple[Tip, Tip]:
        """The rearmost point of the heel (its reach towards -X) and the foremost of the toes."""
        rough_mm = self._rough_length_mm
        rear = tip(self.vertices_mm, self._heel, -AXES[0], rough_mm, self.tips)
        return rear, tip(self.vertices_mm, self.toes, AXES[0], rough_mm, self.tips)

    @cached_property
    def toes(self) -> Ints:
        """The faces (k, 3) that the foremost point is looked for in: what is low.

        Of a last it is all in front of .7 of what is low: as a last with a high heel rests, its toe
        lies higher than .30 of its length.
        """
        if self.kind == "foot":
            return self.low
        x = self.vertices_mm[:, 0]
        front_mm = x[self.low[:, 0]].max() - LANDMARKS.toes * self._rough_length_mm
        return self._faces_of(x > front_mm)

    @property
    def tips(self) -> TipSettings:
        """How its outermost points are found."""
        return LAST_TIPS if self.kind == "last" else TIPS

    @cached_property
    def _heel(self) -> Ints:
        """The faces (k, 3) that the heel's rearmost point is looked for in.

        Of a foot whose shank leans back over its heel these are the faces below the heel's own
        narrowing.
        """
        end_mm = heel_end(self.vertices_mm, self.faces) if self.kind == "foot" else np.inf
        return self.low if end_mm == np.inf else self._faces_of(self.vertices_mm[:, 2] < end_mm)

    @cached_property
    def length_mm(self) -> float:
        """From the pternion to the foremost point along X."""
        rear, front = self.ends
        return rear.reach + front.reach

    @property
    def pternion(self) -> Floats:
        """The rearmost point of the heel, (3,)."""
        rear = self.ends[0]
        return np.array([-rear.reach, *rear.place[1:]])

    @cached_property
    def heel_base(self) -> Floats:
        """Where the heel's back turns into its bottom, (3,): the middle of the cap farthest back
        and down. It is a little inside: at the outermost point a section changes too fast.
        """
        return tip(self.vertices_mm, self.low, BACK_AND_DOWN, self.length_mm).place

    @cached_property
    def stance(self) -> Stance | None:
        """How it stands; None if a last's bottom is open or has no tread."""
        return stance_of(self.vertices_mm, self.faces, self.kind, self.labels)

    @property
    def shape_heel_mm(self) -> float | None:
        """About how high a last's heel stands by its shape, whatever a label says."""
        return None if self.stance is None else self.stance.shape_heel_mm(self.length_mm)

    @property
    def standing_transform(self) -> Floats | None:
        """From the resting frame to the standing one, (4, 4); None if its stance is not known."""
        return None if self.stance is None else self.stance.standing_transform

    @cached_property
    def flat_bottom(self) -> Flattened:
        """Its bottom as the flare and the toes' outline are read: a last's is laid flat.

        Raises
        ------
        HalfScan
            It has no length.
        """
        stance = self.stance if self.kind == "last" else None
        return flattened(self.vertices_mm, self.faces, stance, FlareDefinition())

    # ------------------------------------------------------------ the ball

    @cached_property
    def mt1(self) -> Floats | None:
        """The most medial point of the inner joint (first metatarsal head), (3,)."""
        return self._joint(1.0, LANDMARKS.inner_joint)

    @cached_property
    def mt5(self) -> Floats | None:
        """The most lateral point of the outer joint (fifth metatarsal head), (3,)."""
        return self._joint(-1.0, LANDMARKS.outer_joint)

    @property
    def ball_plane(self) -> tuple[Floats, Floats] | None:
        """The upright plane through MT1 and MT5; None if a joint is not found.

        A point (3,), half-way between them at z = 0, and the plane's axes (2, 3), to MT1 and up.
        """
        if self.mt1 is None or self.mt5 is None:
            return None
        level = np.array([1.0, 1.0, 0.0])
        across = (self.mt1 - self.mt5) * level
        axes = np.stack([across / np.linalg.norm(across), AXES[2]])
        return 0.5 * (self.mt1 + self.mt5) * level, axes

    def _joint(self, side: float, window: tuple[float, float]) -> Floats | None:
        """The outermost point (3,) of a joint; None if there is none in the search window.

        The outline must turn inward again before the window's edge. Over a big toe that is turned
        in it goes on outward: that is not a joint.
        """
        place = self.outermost(side, window)
        if place is None:
            return None
        share = float(place[0] - self.x_mm(0.0)) / self.length_mm
        return place if self._is_joint(share, window) else None

    @staticmethod
    def _is_joint(share: float, window: tuple[float, float]) -> bool:
        """Whether an outermost place does not lie at the edge of its search window."""
        return window[0] + LANDMARKS.joint_edge < share < window[1] - LANDMARKS.joint_edge

    def outermost(self, side: float, window: tuple[float, float]) -> Floats | None:
        """The outermost point (3,) of one side (+1 medial, -1 lateral) between two shares of the
        length; None if there is no surface.
        """
        x, _, z = self.vertices_mm.T
        start, end = (self.x_mm(share) for share in window)
        height_mm = LANDMARKS.width_height * self.length_mm
        return self._outermost_of(side, (x > start) & (x < end) & (z < height_mm))

    def _outermost_of(self, side: float, near: Bools) -> Floats | None:
        """The outermost point (3,) of the faces that have one of some vertices (n,)."""
        a, b, c = near[self.faces.T]
        faces = self.faces[a | b | c]  # coarse triangles at the window's ends count too
        if not len(faces):
            return None
        outermost = tip(self.vertices_mm, faces, side * AXES[1], self.length_mm, self.tips)
        filled = faces[self.filled[a | b | c]]
        beside_mm = (side * self.vertices_mm[filled, 1]).max(initial=-np.inf)
        if beside_mm > outermost.reach - LANDMARKS.filled_beside * self.length_mm:
            return None
        return np.array([outermost.place[0], side * outermost.reach, outermost.place[2]])

    @cached_property
    def filled(self) -> Bools:
        """Which faces (m,) a program closed a hole with: nothing was scanned there.

        A leg's lid and a flat sole on the ground are no such faces. Of a last no plane is, and no
        facet as high as the top of its cone.
        """
        z_mm = self.vertices_mm[:, 2]
        flat = np.abs(z_mm) < LANDMARKS.ground * self.length_mm
        if self.kind == "last":
            flat |= z_mm > LANDMARKS.length_height * self.length_mm
        a, b, c = flat[self.faces.T]
        return filled_faces(
            self.vertices_mm,
            self.faces,
            self.length_mm,
            self.top_cut | (a & b & c),
            plane_is_shape=self.kind == "last",
        )

    def unscanned(
        self, section: Outline, *, upright: bool = False, below_mm: float = np.inf
    ) -> bool:
        """Whether a tape around a section runs over a filled hole.

        Only over upright parts, or below a height (mm), if one of these is asked for.
        """
        filled = self.filled[section.face]
        filled &= section.segments[:, :, 1].min(axis=1) < below_mm
        if upright:
            across, up = np.abs(section.segments[:, 1] - section.segments[:, 0]).T
            filled &= up > across
        crossed_mm = touched_mm(section, filled, LANDMARKS.touched * self.length_mm)
        return crossed_mm > LANDMARKS.filled_crossed * self.length_mm

    # ------------------------------------------------------------ the top

    @cached_property
    def top_cut(self) -> Bools:
        """Which faces (m,) close the shape at its top: a leg's cut, a last's cone top."""
        top = top_cut_faces(self.vertices_mm, self.faces, self.length_mm, self.x_mm(0.0))
        in_cut = self.kind == "last" and top.any() and self.cone_cut
        return top & ~in_cut.holds(self.vertices_mm, self.faces) if in_cut else top

    @cached_property
    def at_instep(self) -> Outline:
        """The section at half the length."""
        return self.across(LANDMARKS.instep)

    @cached_property
    def instep(self) -> Floats:
        """The top of the section at half the length, (3,)."""
        points = self.at_instep.points
        return np.array([self.x_mm(LANDMARKS.instep), *points[np.argmax(points[:, 1])]])

    # ------------------------------------------------------------ where a tape lies

    @cached_property
    def bottom_arc(self) -> BottomArc | None:
        """The arc along which a tape's places are counted; None of a foot or an open bottom."""
        return None if self.kind == "foot" or self.stance is None else bottom_arc(self.stance)

    @property
    def upright(self) -> Floats:
        """What is up when the shape stands, (3,): a last's tread lies level then."""
        return AXES[2] if self.bottom_arc is None else self.bottom_arc.stands[2, :3]

    @cached_property
    def joints(self) -> tuple[Floats, Floats] | None:
        """Where a tape lies at the ball: the outer and the inner joint, (3,) each.

        A foot's are MT5 and MT1. On a last they are looked for between the same shares of the
        bottom's arc. None if one is not found.
        """
        if self.bottom_arc is None:
            return None if self.mt1 is None or self.mt5 is None else (self.mt5, self.mt1)
        along, over = self.bottom_arc.shares(self.vertices_mm)
        low = over < LANDMARKS.width_height
        places = []
        for side, window in ((-1.0, LANDMARKS.outer_joint), (1.0, LANDMARKS.inner_joint)):
            place = self._outermost_of(side, low & (along > window[0]) & (along < window[1]))
            if place is None or not self._is_joint(self.share_of(place), window):
                return None
            places.append(place)
        return places[0], places[1]

    @cached_property
    def instep_crown(self) -> Crown:
        """Across the foot at half the length; of a last, at half its bottom's arc."""
        return self._crown(LANDMARKS.instep)

    @cached_property
    def waist_crown(self) -> Crown | None:
        """Half-way between the middle of the joints and the instep; None without joints."""
        if self.joints is None:
            return None
        ball = self.share_of(0.5 * (self.joints[0] + self.joints[1]))
        return self._crown(0.5 * (ball + LANDMARKS.instep))

    def share_of(self, place: Floats) -> float:
        """How far forward a place (3,) is, over the length, or over the arc of a last's bottom."""
        if self.bottom_arc is None:
            return float(place[0] - self.x_mm(0.0)) / self.length_mm
        return float(self.bottom_arc.shares(place[None])[0][0])

    def _crown(self, share: float) -> Crown:
        """The section across X at a share of the length, or of the arc of a last's bottom."""
        if self.bottom_arc is not None:
            share = (self.bottom_arc.x_mm(share) - self.x_mm(0.0)) / self.length_mm
        crown_mm = LANDMARKS.crown * self.length_mm
        return Crown(self.across(share), self.x_mm(share), crown_mm)

    # ------------------------------------------------------------ places and sections

    def x_mm(self, share: float) -> float:
        """Where a share of the length lies along X."""
        return float(-self.ends[0].reach + share * self.length_mm)

    def across(self, share: float, settings: OutlineSettings = OUTLINES) -> Outline:
        """The section normal to X at a share of the length, as (y, z)."""
        if (share, settings) not in self._across:
            origin = np.array([self.x_mm(share), 0.0, 0.0])
            self._across[share, settings] = self.cut(origin, AXES[1:], settings)
        return self._across[share, settings]

    def cut(self, origin: Floats, axes: Floats, settings: OutlineSettings = OUTLINES) -> Outline:
        """The section by the plane through ``origin`` (3,) along ``axes`` (2, 3)."""
        section = outline(self.vertices_mm, self.faces, origin, axes, self.length_mm, settings)
        near = self.kind == "last" and crosses_cone(origin, axes, self.length_mm, self.x_mm(0.0))
        cut = self.cone_cut if near else None
        return section if cut is None else cut.bridged(section, origin, axes, self.length_mm)

    @cached_property
    def cone_cut(self) -> ConeCut | None:
        """The cut across a last's cone, which its sections bridge; None if it has none."""
        return cone_cut(self.vertices_mm, self.faces, self.length_mm, self.x_mm(0.0))

    def opened(self, section: Outline, below_mm: float = np.inf) -> bool:
        """Whether a section has a gap, below a height (mm) if one is given."""
        return not section.loops or section.gap_mm(below_mm) > LANDMARKS.gap * self.length_mm

    def topped(self, section: Outline) -> bool:
        """Whether a section runs over the shape's top cut, or out of its open top.

        The round instep of a last may lie in the plane of its cone's top. It is no cut. Farther
        back the top is one, also if it is round.
        """
        over_top = self.top_cut[section.face]
        top_mm = float(section.length_mm[over_top].sum())
        closed = top_mm > LANDMARKS.top_crossed * self.length_mm
        if closed and self.kind == "last":
            places = self.vertices_mm[self.faces[section.face[over_top]], 0]
            if places.mean() > self.x_mm(TOP_CUT.front):
                closed = runs_over_cut(section.segments, over_top, self.length_mm)
        return closed or self.opened(section)

    @cached_property
    def _across(self) -> dict[tuple[float, OutlineSettings], Outline]:
        return {}

    @cached_property
    def _rough_length_mm(self) -> float:
        return low_length(self.vertices_mm, LANDMARKS.length_height)[1]

    def _faces_of(self, vertices: Bools) -> Ints:
        """The faces (k, 3) whose three corners are among the chosen vertices (n,)."""
        a, b, c = vertices[self.faces.T]
        return np.asarray(self.faces[a & b & c])
