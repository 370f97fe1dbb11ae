"""The pictures of docs/, drawn by footfit itself from the sample data.

python -m tools.make_pictures [FOLDER]
"""

from __future__ import annotations

import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

import footfit
from footfit.pipeline.scan.curvature import surface_curvature
from footfit.pipeline.scan.flare import profiled_scan
from footfit.report.pictures.curvature_figure import curvature_figure
from footfit.report.pictures.figures import png_bytes
from footfit.report.pictures.flare_figure import flare_figure
from footfit.report.pictures.frames_figure import frames_figure
from footfit.results import Scan
from tests.distortions import moved, random_pose, white_noise
from tests.reading import read_scan
from tests.scans import aligned
from tools.custom_picture import custom_picture
from tools.drawing_pictures import drawing_pictures
from tools.measure_pictures import measure_pictures
from tools.page_pictures import page_pictures
from tools.stance_picture import stance_picture
from tools.tape_pictures import tape_pictures

ROOT = Path(__file__).resolve().parents[1]
SAMPLES = ROOT / "sample_data"
SEED = 7
NOISE_MM = 0.3


def pictures() -> dict[str, bytes]:
    """Every picture by its file's name."""
    rng = np.random.default_rng(SEED)
    foot = read_scan(SAMPLES / "feet" / "mh007_R.stl")
    last = read_scan(SAMPLES / "lasts" / "trainer-40.stl")
    thrown = replace(foot, vertices_mm=moved(foot.vertices_mm, random_pose(rng)))
    return {
        **method_pictures(thrown),
        "flare-foot.png": png_bytes(flare_figure(profiled_scan(aligned(foot)))),
        "flare-last.png": png_bytes(flare_figure(profiled_scan(aligned(last)))),
        **curvature_pictures(foot, rng),
        **page_pictures(),
        **measure_pictures(),
        **tape_pictures(),
        **drawing_pictures(),
        "standing_last.png": stance_picture(),
        "custom_last.png": custom_picture(),
    }


def method_pictures(scan: Scan) -> dict[str, bytes]:
    """One scan in one arbitrary pose, aligned by each method."""
    with tempfile.TemporaryDirectory() as folder:
        lasts = footfit.open_catalogue(Path(folder) / "lasts.footfit")
        lasts.ingest(manifest=SAMPLES / "lasts.csv")
        lasts.set_reference("loafer-42")
        reference = lasts.reference()
    drawn = {"align-footfit.png": png_bytes(frames_figure(aligned(scan)))}
    for method in ("paper", "paper-literal"):
        shape = aligned(scan, method=method, reference=reference)
        drawn[f"align-{method}.png"] = png_bytes(frames_figure(shape))
    return drawn


def curvature_pictures(foot: Scan, rng: np.random.Generator) -> dict[str, bytes]:
    """A foot with a scanner's noise: the paper's one ring, and pooled over a radius."""
    noisy = replace(foot, vertices_mm=white_noise(foot.vertices_mm, rng, NOISE_MM))
    view = aligned(foot).alignment.canonical_transform
    return {
        "curvature-one-ring.png": png_bytes(curvature_figure(surface_curvature(noisy, 0.0), view)),
        "curvature-pooled.png": png_bytes(curvature_figure(surface_curvature(noisy), view)),
    }


def main() -> None:
    """Write the pictures."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for name, data in pictures().items():
        (folder / name).write_bytes(data)
        print(f"{folder / name}: {len(data) // 1000} kB")


if __name__ == "__main__":
    main()
