"""The pose of a foot or last among all poses, by its shape: which way is up, which way is forward.

A coarse search over all rotations, ICP from the best of them, and a choice that also says by how
much the next best pose is worse. Left or right is decided afterwards (``side.py``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import nearest_rotation, super_fibonacci
from footfit.geometry.search.clouds import MIRROR, Cloud, both_clouds
from footfit.geometry.search.icp import (
    FIT,
    Poses,
    forward_costs,
    icp_steps,
    joined_poses,
    levelled_poses,
    reverse_cost,
    size_of,
)
from footfit.geometry.search.templates import Singles, Template
from footfit.geometry.search.turned_poses import mirror_image, straight_turns, turned_about

Windows = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class PoseSearchSettings:
    """Everything numeric of the search."""

    first_templates: int = 2  # the others are tried only if these fit badly
    boot_template: int = 2  # a boot with a low heel: a shape that looks like a foot may be one
    boot_cost: float = 0.33  # boots cost .35 or more on the foot
    likely_cost: float = 0.05  # more than the best costs: then a template is not searched again
    rotations: int = 576
    more_rotations: int = 1728
    sample_points: int = 1500
    few_points: int = 256
    coarse_points: int = 128
    kept_coarse: int = 24
    icp_rounds: tuple[tuple[int, int], ...] = ((4, 10), (8, 10))  # steps, poses kept after them
    kept_poses: int = 4
    apart_deg: float = 25.0
    final_steps: int = 10
    final_stride: int = 3
    rival_deg: float = 37.0
    rival_steps: int = 14
    refit_steps: int = 20  # the best pose on other templates: a wide foot goes slowly
    rivals_finished: int = 2
    middle: tuple[float, float] = (0.5, 0.17)  # x and z that a rival is turned about
    reverse_height: float = 0.30
    reverse_points: int = 400
    reverse_share: float = 0.75
    reverse_normal: float = -1.0  # points whose normal's z lies below it are not looked for
    retry_cost: float = 0.40
    retry_margin: float = 0.07
    cost_maximum: float = 0.62
    margin_minimum: float = 0.04
    doubtful_cost: float = 0.42
    margin_per_cost: float = 1.5
    margin_without_rival: float = 1.0  # only if even the turned poses fall back to the winner
    upright: float = 0.70  # cosine with Z of where an end looks
    long_leg: float = 0.70  # over L: a scan that reaches higher is searched again
    crop: float = 0.60  # without what lies higher than this


POSE_SEARCH = PoseSearchSettings()
SOLELESS = PoseSearchSettings(reverse_normal=-0.5, cost_maximum=0.50)
"""For a scan whose sole is missing: the template's sole is not looked for in it."""


@dataclass(frozen=True, slots=True)
class RoughPose:
    """The pose that fits best: canonical is about rotation @ p + shift, in the mesh's unit.

    ``length`` is approximate; ``cost`` and ``margin`` are those of :class:`PoseQuality`; ``kind``
    is that of the template that fits best, and ``kind_margin`` how much more the best template of
    the other kind costs; ``accepted`` says whether it is a foot or last at all.
    """

    rotation: Floats
    shift: Floats
    length: float
    cost: float
    margin: float
    kind: str
    accepted: bool
    kind_margin: float = 0.0


def rough_pose(
    vertices: Floats,
    faces: Ints,
    templates: Sequence[Template],
    windows: Windows = (),
    settings: PoseSearchSettings = POSE_SEARCH,
    ends: Floats | None = None,
) -> RoughPose:
    """The pose of a mesh, by the fit to the templates.

    If the pose found has a long leg, the search is made again without it: a leg takes points from
    the foot and adds cost.

    Parameters
    ----------
    vertices, faces : (n, 3) float64, (m, 3) int64
        Outward winding.
    templates : sequence of Template
        In the order in which ties are settled; one that is not needed is not asked for.
    windows : pairs of float
        Lengths, in the mesh's unit, that are plausible; poses with another length are taken last.
        Empty: any length.
    settings : PoseSearchSettings
    ends : (k, 3), optional
        Directions that look up or down: a pose that turns one of them sideways is implausible.
    """
    search = _Search(templates, windows, settings, np.empty((0, 3)) if ends is None else ends)
    pose = search.pose_of(vertices, faces)
    height = (vertices @ pose.rotation[2] + pose.shift[2]) / pose.length
    if height.max() < settings.long_leg:
        return pose
    low = height[faces].max(axis=1) < settings.crop
    if not low.any():
        return pose
    without_leg = search.pose_of(vertices, faces[low])
    return min(pose, without_leg, key=lambda each: (not each.accepted, each.cost))


@dataclass(frozen=True, slots=True)
class _Candidate:
    """One pose (a batch of one) of a cloud on a template, and its cost."""

    pose: Poses
    template: Template
    cloud: Cloud
    cost: float

    @property
    def rotation(self) -> Floats:
        """The rotation for the mesh as it is: mirrored before and after, if at all."""
        rotation = self.pose.rotation[0].astype(np.float64)
        return np.asarray(MIRROR @ rotation @ MIRROR) if self.cloud.mirrored else rotation


@dataclass(frozen=True, slots=True)
class _Search:
    """What a search is made with: the templates, plausible lengths, settings."""

    templates: Sequence[Template]
    windows: Windows
    settings: PoseSearchSettings
    ends: Floats

    def pose_of(self, vertices: Floats, faces: Ints) -> RoughPose:
        """The pose of a mesh with its leg, searched more finely if a doubt is left.

        Lengths that would make nearly all of the mesh leg are not plausible.
        """
        settings = self.settings
        used = np.zeros(len(vertices), dtype=bool)
        used[faces] = True
        points = vertices if used.all() else vertices[used]
        # About the middle of the box float32 loses nothing, wherever the origin is.
        centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
        clouds = both_clouds(
            vertices - centre, faces, self.ends, settings.sample_points, settings.few_points
        )
        least = 1.001 * FIT.least_length * size_of(clouds[0].few)
        limits = tuple((max(low, least), high) for low, high in self.windows or ((0.0, np.inf),))
        limited = replace(self, windows=limits)
        first = self.templates[: settings.first_templates]
        candidates = limited.candidates(clouds, first, settings.rotations)
        pose = _cheapest(candidates, settings)
        for place in range(settings.first_templates, len(self.templates)):
            if not self.is_doubtful(pose):
                break
            candidates += limited.candidates(clouds, (self.templates[place],), settings.rotations)
            pose = _cheapest(candidates, settings)
        doubt = self.is_doubtful(pose)
        if doubt:
            likely = self.likely_templates(candidates)
            candidates += limited.candidates(clouds, likely, settings.more_rotations)
            candidates += limited.refitted(candidates, clouds, likely)
        if doubt or pose.margin == settings.margin_without_rival:
            candidates += limited.rivals(candidates)
            pose = _cheapest(candidates, settings)
        if pose.kind == "foot" and pose.cost > settings.boot_cost:
            candidates += limited.boots(candidates)
            pose = _cheapest(candidates, settings)
        return replace(pose, shift=pose.shift - pose.rotation @ centre)

    def is_doubtful(self, pose: RoughPose) -> bool:
        """Whether a pose fits badly, or another nearly as well."""
        badly = pose.cost > self.settings.retry_cost
        return badly or pose.margin < self.settings.retry_margin

    def likely_templates(self, candidates: list[_Candidate]) -> tuple[Template, ...]:
        """The first templates, and those of the others that fit about as well as the best."""
        costs = [_least_cost(candidates, template) for template in self.templates]
        limit = min(costs) + self.settings.likely_cost
        return tuple(
            template
            for place, (template, cost) in enumerate(zip(self.templates, costs, strict=True))
            if place < self.settings.first_templates or cost < limit
        )

    def candidates(
        self, clouds: tuple[Cloud, Cloud], templates: Sequence[Template], count: int
    ) -> list[_Candidate]:
        """The best few poses per template over both mirrors, fitted with all points."""
        rotations = super_fibonacci(count).astype(np.float32)
        result = []
        for template in templates:
            start = self._coarse(clouds[0], template, rotations)
            starts = start, mirror_image(start, template.middle_y)
            fitted = [
                (cost, pose, cloud)
                for cloud, poses in zip(clouds, starts, strict=True)
                for cost, pose in self._fitted(cloud, template, poses)
            ]
            fitted.sort(key=lambda each: each[0])
            best = fitted[: self.settings.kept_poses]
            for cloud in clouds:
                mine = [pose for _, pose, owner in best if owner is cloud]
                if mine:
                    result += self._finished(joined_poses(mine), cloud, template)
        return result

    def refitted(
        self,
        candidates: list[_Candidate],
        clouds: tuple[Cloud, Cloud],
        templates: tuple[Template, ...],
    ) -> list[_Candidate]:
        """The best pose fitted on each template, as it is and mirrored.

        On a very wide foot one template may reach the right valley alone, which leads others there.
        """
        best, result = min(candidates, key=lambda each: each.cost), []
        for template, cloud in product(templates, clouds):
            pose = best.pose if cloud is best.cloud else mirror_image(best.pose, template.middle_y)
            few, steps = (cloud.few, cloud.few_normals), self.settings.refit_steps
            result += self._finished(icp_steps(pose, *few, template, steps), cloud, template)
        return result

    def rivals(self, candidates: list[_Candidate]) -> list[_Candidate]:
        """The best of each template turned upside down, on its sides and end for end, and fitted.

        Which poses the search keeps depends on the pose that the mesh came in. If all of them lie
        in one valley, the margin would measure nothing; the turned poses are always there.
        """
        settings, result = self.settings, []
        tried = {id(each.template): each.template for each in candidates}.values()
        for template in tried:
            fitted = (each for each in candidates if each.template is template)
            best = min(fitted, key=lambda each: each.cost)
            cloud = best.cloud
            poses = turned_about(best.pose, straight_turns(), template.middle_y, settings.middle)
            poses = icp_steps(poses, cloud.few, cloud.few_normals, template, settings.rival_steps)
            costs = self._costs(poses, cloud, template)
            cheapest = np.argsort(costs, kind="stable")[: settings.rivals_finished]
            result += self._finished(poses.at(cheapest), cloud, template)
        return result

    def boots(self, candidates: list[_Candidate]) -> list[_Candidate]:
        """The boot, fitted from the best pose: it costs less than the foot if the shape is one."""
        if len(self.templates) <= self.settings.boot_template:
            return []
        best = min(candidates, key=lambda each: each.cost)
        return self._finished(best.pose, best.cloud, self.templates[self.settings.boot_template])

    def _costs(
        self, poses: Poses, cloud: Cloud, template: Template, few: int | None = None
    ) -> Singles:
        """The cost of each pose, (k,). An implausible length or an end turned aside adds to it."""
        costs = forward_costs(poses, cloud.few[:few], cloud.few_normals[:few], template)
        costs += cloud.implausible(poses, self.settings.upright)
        lengths = 1 / poses.scale
        plausible = np.any([(low < lengths) & (lengths < high) for low, high in self.windows], 0)
        costs += np.where(plausible, 0.0, FIT.implausible_cost)
        return costs

    def _coarse(self, cloud: Cloud, template: Template, rotations: Singles) -> Poses:
        """The cheapest of all rotations, length and shift taken from the mesh's low part.

        Of the mesh as it is only: a left foot lies on a right template well enough to start from.
        """
        few = self.settings.coarse_points
        poses = levelled_poses(rotations, cloud.few, template.middle_y)
        costs = self._costs(poses, cloud, template, few)
        return poses.at(np.argsort(costs, kind="stable")[: self.settings.kept_coarse])

    def _fitted(self, cloud: Cloud, template: Template, poses: Poses) -> list[tuple[float, Poses]]:
        """The best poses of one cloud on one template after ICP in two halves, with their costs."""
        points, normals = cloud.few, cloud.few_normals
        costs = np.zeros(len(poses.scale), dtype=np.float32)
        for steps, kept in self.settings.icp_rounds:
            poses = icp_steps(poses, points, normals, template, steps)
            costs = self._costs(poses, cloud, template)
            best = np.argsort(costs, kind="stable")[:kept]
            poses, costs = poses.at(best), costs[best]
        return [(float(costs[i]), poses.at(np.array([i]))) for i in self._apart(poses, costs)]

    def _apart(self, poses: Poses, costs: Singles) -> list[int]:
        """Indices of the cheapest poses that differ by over ``apart_deg`` from a cheaper one."""
        traces = np.einsum("aij,bij->ab", poses.rotation, poses.rotation)
        near = traces > 1 + 2 * np.cos(np.radians(self.settings.apart_deg))
        kept: list[int] = []
        for place in np.argsort(costs, kind="stable"):
            if len(kept) < self.settings.kept_poses and not near[place, kept].any():
                kept.append(int(place))
        return kept

    def _finished(self, poses: Poses, cloud: Cloud, template: Template) -> list[_Candidate]:
        """Poses of one cloud fitted with all points, and their costs both ways."""
        settings, points, normals = self.settings, cloud.many, cloud.many_normals
        some = slice(None, None, settings.final_stride)
        poses = icp_steps(poses, points[some], normals[some], template, settings.final_steps)
        costs = forward_costs(poses, points, normals, template)
        costs += cloud.implausible(poses, settings.upright)
        sought = template.normals[:, 2] >= settings.reverse_normal
        low = np.flatnonzero(sought & (template.points[:, 2] < settings.reverse_height))
        low = low[np.linspace(0, len(low) - 1, settings.reverse_points).astype(int)]
        sparse = template.points[low], template.normals[low]
        result = []
        for place, forward in enumerate(costs.tolist()):
            pose = poses.at(np.array([place]))
            back = reverse_cost(pose, points, normals, sparse, settings.reverse_share)
            result.append(_Candidate(pose, template, cloud, forward + back))
        return result


def _least_cost(candidates: list[_Candidate], template: Template) -> float:
    """The least cost on a template; infinite if it was not tried."""
    return min((each.cost for each in candidates if each.template is template), default=np.inf)


def _cheapest(candidates: list[_Candidate], settings: PoseSearchSettings) -> RoughPose:
    """The cheapest candidate, and its margin to the cheapest that points elsewhere."""
    order = sorted(candidates, key=lambda candidate: candidate.cost)
    winner, rotation = order[0], order[0].rotation
    limit = np.cos(np.radians(settings.rival_deg))
    rivals = [
        other.cost
        for other in order
        if any(other.rotation[axis] @ rotation[axis] < limit for axis in (0, 2))
    ]
    margin = rivals[0] - winner.cost if rivals else settings.margin_without_rival
    others = [each.cost for each in order if each.template.kind != winner.template.kind]
    length = 1 / float(winner.pose.scale[0])
    shift = winner.pose.shift[0].astype(np.float64) * length
    return RoughPose(
        rotation=nearest_rotation(rotation),
        shift=MIRROR @ shift if winner.cloud.mirrored else shift,
        length=length,
        cost=winner.cost,
        margin=margin,
        kind=winner.template.kind,
        kind_margin=others[0] - winner.cost if others else 0.0,
        accepted=is_accepted(winner.cost, margin, settings),
    )


def is_accepted(cost: float, margin: float, settings: PoseSearchSettings = POSE_SEARCH) -> bool:
    """Whether a pose is that of a foot or last: the worse it fits, the clearer it must be.

    Cost alone does not tell: a cylinder has 0.55, an ellipsoid 0.55; their margins are below 0.03.
    """
    extra = settings.margin_per_cost * max(0.0, cost - settings.doubtful_cost)
    return cost <= settings.cost_maximum and margin >= settings.margin_minimum + extra
