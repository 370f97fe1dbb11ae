"""The paper's weighted PCA alignment (II, Eq. 1-8), step by step, and its mirror images.

``R`` has eigenvectors as rows, ``OM_E`` the reference's eigenvectors as columns in its canonical
frame: both by Eq. 1-4 as printed, else a reference would not lie on itself. A left shape is
mirrored before Eq. 1, in the file's first axis: once aligned, that is y -> -y of the canonical
frame.
"""

from __future__ import annotations

from itertools import permutations

import numpy as np

from footfit.geometry.mesh.moments import principal_axes, printed_covariance, vertex_mean
from footfit.geometry.numeric.arrays import Floats, Ints
from footfit.geometry.numeric.rotations import angle_deg, nearest_rotation, transform

FILE_MIRROR = np.diag([-1.0, 1.0, 1.0])
CANONICAL_MIRROR = np.diag([1.0, -1.0, 1.0])


def printed_axes(vertices: Floats, faces: Ints) -> tuple[Floats, Floats, Floats]:
    """The paper's steps 1-4, as printed, on one mesh.

    Parameters
    ----------
    vertices, faces : (n, 3) float64, (m, 3) int64

    Returns
    -------
    P_c : (3,) float64
        The barycentre.
    C_M : (3, 3) float64
        The covariance.
    R : (3, 3) float64
        Its eigenvectors as rows, by descending eigenvalue. Their signs are open:
        :func:`settled_axes` and :func:`largest_positive` choose them.
    """
    P_c = vertex_mean(vertices)  # step 1, Eq. 1
    v_1 = vertices - P_c  # step 2
    C_M = printed_covariance(v_1, faces)  # step 3, Eq. 2-4
    R = principal_axes(C_M)[1]  # step 4
    return P_c, C_M, R


def paper_transform(
    P_c: Floats,
    R: Floats,
    OM_E: Floats,
    reference_centroid_mm: Floats,
    unit_scale: float,
    *,
    literal: bool = False,
) -> Floats:
    """The paper's steps 5, 7 and 8 as one (4, 4): the file's coordinates to mm, V_A.

    Parameters
    ----------
    P_c, R : (3,), (3, 3) float64
        From steps 1-4, of a right shape; a left one's go through :func:`mirrored_frame` first.
    OM_E, reference_centroid_mm : (3, 3), (3,) float64
        Step 6, :func:`om_e`, and where V_A is docked: the reference's own P_c in its frame.
    unit_scale : float
        From the file's coordinates to mm.
    literal : bool
        True: Eq. 7 as printed, in which R cancels and V_A is OM_E v' whatever the pose.
        False: the consistent reading, R' = OM_E.
    """
    TM = R.T
    R_prime = OM_E @ TM if literal else OM_E  # step 7, Eq. 7
    turn = R_prime @ R  # step 8, Eq. 8: V_A = R' v'', of step 5, Eq. 5: v'' = R v'
    return transform(turn, reference_centroid_mm - turn @ P_c, unit_scale)


def largest_positive(rows: Floats) -> Floats:
    """Rows (3, 3) with the sign that makes each one's largest entry positive.

    The last row is then turned so that the rows are a rotation.
    """
    largest = rows[np.arange(3), np.abs(rows).argmax(axis=1)]
    signed = rows * np.where(largest < 0, -1.0, 1.0)[:, None]
    signed[2] *= np.sign(np.linalg.det(signed))
    return signed


def settled_axes(rows: Floats, canonical_rotation: Floats) -> Floats:
    """Eigenvectors (3, 3 rows) in the order and with the signs of the canonical axes.

    The order is the one whose axes lie nearest to X, Y, Z; the result is a rotation.

    Examples
    --------
    >>> rows = np.array([[-1.0, 0, 0], [0, 0, 1], [0, 1, 0]])
    >>> np.array_equal(settled_axes(rows, np.eye(3)), np.eye(3))
    True
    """
    closeness = np.abs(rows @ canonical_rotation.T)
    order = max(permutations(range(3)), key=lambda p: sum(closeness[p[i], i] for i in range(3)))
    ordered = rows[list(order)]
    along = np.einsum("ij,ij->i", ordered, canonical_rotation)
    signed = ordered * np.where(along < 0, -1.0, 1.0)[:, None]
    if np.linalg.det(signed) < 0:
        signed[np.abs(along).argmin()] *= -1
    return signed


def om_e(eigenvectors: Floats, canonical_transform: Floats, *, mirrored: bool = False) -> Floats:
    """OM_E (3, 3): a reference's eigenvectors as columns in its canonical frame (Eq. 6).

    Parameters
    ----------
    eigenvectors : (3, 3) float64
        Rows, in the file's axes.
    canonical_transform : (4, 4) float64
        From the file's coordinates, any scale.
    mirrored : bool
        True for a left reference: it is mirrored to a right one first.
    """
    linear = canonical_transform[:3, :3]
    rotation = linear / np.cbrt(np.linalg.det(linear))
    columns = rotation @ eigenvectors.T  # Eq. 6
    return np.asarray(CANONICAL_MIRROR @ columns @ CANONICAL_MIRROR if mirrored else columns)


def canonical_centroid_mm(
    centroid_mm: Floats, canonical_transform: Floats, unit_scale: float, *, mirrored: bool = False
) -> Floats:
    """The stored centroid (3,), mm in the file's axes, in the canonical frame of a right shape."""
    linear, shift = canonical_transform[:3, :3], canonical_transform[:3, 3]
    moved = linear @ (centroid_mm / unit_scale) + shift
    return CANONICAL_MIRROR @ moved if mirrored else np.asarray(moved)


def mirrored_frame(P_c: Floats, R: Floats) -> tuple[Floats, Floats]:
    """Centroid (3,) and axes (3, 3 rows) of a left shape's mirror image, a right shape."""
    return FILE_MIRROR @ P_c, CANONICAL_MIRROR @ R @ FILE_MIRROR


def unmirrored_transform(transform_of_mirrored: Floats, *, mirrored: bool) -> Floats:
    """The transform for the file as it is, into the frame of a left shape: never a mirror.

    ``transform_of_mirrored`` takes the mirrored file to a right shape's frame; mirroring before
    and after makes it take the file itself to the left shape's.
    """
    if not mirrored:
        return transform_of_mirrored
    before, after = np.eye(4), np.eye(4)
    before[:3, :3], after[:3, :3] = FILE_MIRROR, CANONICAL_MIRROR
    return np.asarray(after @ transform_of_mirrored @ before)


def paper_frame_angle_deg(
    transform_of_mirrored: Floats, canonical_transform: Floats, *, mirrored: bool
) -> float:
    """How far the frame of a :func:`paper_transform` is turned from the canonical one, degrees.

    Both (4, 4) may have any scale; ``mirrored`` as in :func:`unmirrored_transform`.
    """
    paper = unmirrored_transform(transform_of_mirrored, mirrored=mirrored)
    return angle_deg(nearest_rotation(paper[:3, :3]), nearest_rotation(canonical_transform[:3, :3]))
