"""The paper's weighted PCA alignment (II, Eq. 1-8): the steps, and what a catalogue keeps of them.

``R`` has eigenvectors as rows, ``OM_E`` the reference's eigenvectors as columns in its canonical
frame. A left shape is mirrored before Eq. 1, in the file's first axis: once aligned, that is
y -> -y of the canonical frame.
"""

from __future__ import annotations

from itertools import permutations

import numpy as np

from footfit.geometry.arrays import Floats, Ints
from footfit.geometry.moments import principal_axes, printed_covariance, vertex_mean
from footfit.geometry.rotations import transform

FILE_MIRROR = np.diag([-1.0, 1.0, 1.0])
CANONICAL_MIRROR = np.diag([1.0, -1.0, 1.0])


def aligned_by_wpca(vertices: Floats, faces: Ints, OM_E: Floats, *, literal: bool) -> Floats:
    """The paper's steps 1-5, 7 and 8 on one mesh: vertices (n, 3) -> V_A (n, 3).

    Parameters
    ----------
    vertices, faces : (n, 3) float64, (m, 3) int64
    OM_E : (3, 3) float64
        Step 6: the reference's eigenvectors as columns in the position it was turned to (Eq. 6).
    literal : bool
        True: Eq. 7 as printed, in which R cancels and V_A is OM_E v' whatever the pose.
        False: the consistent reading, R' = OM_E.
    """
    P_c = vertex_mean(vertices)  # step 1, Eq. 1
    v_1 = vertices - P_c  # step 2
    C_M = printed_covariance(vertices, faces)  # step 3, Eq. 2-4
    R = largest_positive(principal_axes(C_M)[1])  # step 4
    v_2 = v_1 @ R.T  # step 5, Eq. 5
    TM = R.T
    R_prime = OM_E @ TM if literal else OM_E  # step 7, Eq. 7
    return np.asarray(v_2 @ R_prime.T)  # step 8, Eq. 8


def largest_positive(rows: Floats) -> Floats:
    """Rows (3, 3) with the sign that makes each one's largest entry positive.

    The last row is then turned so that the rows are a rotation.
    """
    largest = rows[np.arange(3), np.abs(rows).argmax(axis=1)]
    signed = rows * np.where(largest < 0, -1.0, 1.0)[:, None]
    signed[2] *= np.sign(np.linalg.det(signed))
    return signed


def settled(rows: Floats, canonical_rotation: Floats) -> Floats:
    """Eigenvectors (3, 3 rows) in the order and with the signs of the canonical axes.

    The order is the one whose axes lie nearest to X, Y, Z; the result is a rotation.

    Examples
    --------
    >>> rows = np.array([[-1.0, 0, 0], [0, 0, 1], [0, 1, 0]])
    >>> np.array_equal(settled(rows, np.eye(3)), np.eye(3))
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


def paper_transform(
    centroid_mm: Floats,
    eigenvectors: Floats,
    unit_scale: float,
    OM_E: Floats,
    reference_centroid_mm: Floats,
    *,
    mirrored: bool = False,
) -> Floats:
    """The paper's Eq. 8 (consistent reading) as one (4, 4), from stored values only.

    It takes the file's coordinates (mirrored in the first axis where ``mirrored``) to the
    reference's frame in mm: V_A = OM_E R (x - P_c) + the reference's centroid.
    """
    R, P_c = eigenvectors, centroid_mm
    if mirrored:
        R, P_c = CANONICAL_MIRROR @ R @ FILE_MIRROR, FILE_MIRROR @ P_c
    turn = OM_E @ R  # Eq. 5, then Eq. 8 with R' = OM_E
    return transform(turn, reference_centroid_mm - turn @ P_c, unit_scale)


def literal_transform(
    centroid_mm: Floats,
    unit_scale: float,
    OM_E: Floats,
    reference_centroid_mm: Floats,
    *,
    mirrored: bool = False,
) -> Floats:
    """Eq. 7-8 as printed, as one (4, 4): R cancels, and V_A = OM_E (x - P_c) + the centroid.

    Input and output are mirrored as in :func:`paper_transform`.
    """
    P_c = FILE_MIRROR @ centroid_mm if mirrored else centroid_mm
    return transform(OM_E, reference_centroid_mm - OM_E @ P_c, unit_scale)


def unmirrored(transform_of_mirrored: Floats, *, mirrored: bool) -> Floats:
    """The transform for the file as it is, into the frame of a left shape: never a mirror.

    ``transform_of_mirrored`` takes the mirrored file to a right shape's frame; mirroring before
    and after makes it take the file itself to the left shape's.
    """
    if not mirrored:
        return transform_of_mirrored
    before, after = np.eye(4), np.eye(4)
    before[:3, :3], after[:3, :3] = FILE_MIRROR, CANONICAL_MIRROR
    return np.asarray(after @ transform_of_mirrored @ before)
