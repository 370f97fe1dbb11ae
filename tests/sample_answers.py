"""What footfit answers about the sample feet and lasts, and about the same scans spoilt.

``tests/data/answers.json`` keeps the answers, and `tests.test_sample_answers` compares. A change
that is meant to change them writes them anew, ``python -m tests.sample_answers``, and its author
reads the difference.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from footfit.meshes.write import encoded_mesh
from tests import distortions
from tests.conftest import ROOT, SAMPLES
from tests.reading import read_scan

KEPT = ROOT / "tests" / "data" / "answers.json"
CATALOGUE = "lasts.footfit"
FOOT, OTHER = "feet/mh008_R.stl", "feet/mh007_L.stl"

COMMANDS: dict[str, str] = {
    **{
        f"{verb} {name}": f"{verb} {name}.stl"
        for verb in ("align", "flare", "measure")
        for name in ("feet/mh007_L", "feet/mh008_R", "lasts/loafer-40", "lasts/trainer-41")
    },
    **{
        f"measure {name}": f"measure spoilt/{name}.stl"
        for name in ("noisy", "holed", "plate", "inside-out", "inches", "blobs", "toeless")
    },
    "align noisy": "align spoilt/noisy.stl",
    "align holed": "align spoilt/holed.stl",
    "flare noisy": "flare spoilt/noisy.stl",
    "align plate": "align spoilt/plate.stl",
    "align the paper's way": f"align {FOOT} --method paper --catalogue {CATALOGUE}",
    "align literally": f"align {FOOT} --method paper-literal --catalogue {CATALOGUE}",
    "align by a length": f"align {FOOT} --known-length 250",
    "split": "measure spoilt/two.stl --split",
    "curvature": f"curvature {FOOT}",
    "curvature by one ring": f"curvature {FOOT} --radius 0",
    "match": f"match {FOOT} --catalogue {CATALOGUE} --top 99",
    "match as scanned": f"match {FOOT} --catalogue {CATALOGUE} --top 99 --as-scanned",
    "match a foot scanned in the heel": f"match {FOOT} --catalogue {CATALOGUE} "
    "--scanned-at-drop 25",
    "match with clearance": f"match {OTHER} --catalogue {CATALOGUE} --top 2 --clearance",
    "match a pair": f"match {OTHER} feet/mh007_R.stl --pair --catalogue {CATALOGUE}",
    "match by flare": f"match {FOOT} --catalogue {CATALOGUE} --by flare --top 99",
    "match by shape": f"match lasts/loafer-40.stl --catalogue {CATALOGUE} --by shape --top 99",
    "match noisy": f"match spoilt/noisy.stl --catalogue {CATALOGUE}",
    **{
        f"match for {name}": f"match {OTHER} --profile {name} --catalogue {CATALOGUE} --top 3"
        for name in ("dress", "sport", "child", "safety")
    },
    "compare": f"compare {OTHER} derby-40 --catalogue {CATALOGUE}",
    "compare as scanned": f"compare {OTHER} derby-40 --catalogue {CATALOGUE} --as-scanned",
    "compare with a left last": f"compare {FOOT} trainer-42 --catalogue {CATALOGUE}",
    "list-lasts": f"list-lasts --catalogue {CATALOGUE}",
    "show-last": f"show-last trainer-41 --catalogue {CATALOGUE}",
}
"""Each command by its name, without ``--json``; the paths are those of `lay_out`."""

VARYING = ("sha256", "record_sha256", "content_sha256", "path", "footfit_version")
"""Keys whose value is no answer, or another one for each machine."""


def lay_out(folder: Path, stocked: Path) -> None:
    """The sample scans, the spoilt ones and a catalogue of the lasts, in one folder."""
    for name in ("feet", "lasts"):
        (folder / name).symlink_to(SAMPLES / name)
    (folder / CATALOGUE).write_bytes(stocked.read_bytes())
    (folder / "spoilt").mkdir()
    scan = read_scan(SAMPLES / OTHER)
    vertices, faces = scan.vertices_mm, scan.faces
    rng = np.random.default_rng(7)
    pose = distortions.random_pose(rng)
    toes = vertices[:, 0].max() - 60.0
    made = {
        "noisy": (distortions.white_noise(vertices, rng, 0.3), faces),
        "holed": distortions.with_holes(vertices, faces, rng, 4, 9.0),
        "plate": distortions.floor_plate(vertices, faces),
        "inside-out": distortions.inside_out(vertices, faces),
        "inches": (vertices / 25.4, faces),
        "blobs": distortions.joined((vertices, faces), blob(vertices)),
        "toeless": distortions.plane_cut(
            vertices, faces, np.array([toes, 0.0, 0.0]), np.array([-1.0, 0.0, 0.0])
        ),
        "two": distortions.joined(
            (vertices, faces), (vertices * [1.0, -1.0, 1.0] + [0.0, 150.0, 0.0], faces[:, ::-1])
        ),
    }
    for name, (points, triangles) in made.items():
        posed = points if name in ("inches", "two") else distortions.moved(points, pose)
        (folder / "spoilt" / f"{name}.stl").write_bytes(encoded_mesh(posed, triangles, "stl"))


def blob(vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A small ball beside a foot, as a scanner leaves it."""
    from tests import shapes

    ball, faces = shapes.sphere(6.0, 1)
    return ball + vertices.max(axis=0) + 25.0, faces


def answer(code: int, out: str, err: str) -> dict[str, Any]:
    """The exit code, the documents, and the code of the error, without what varies."""
    documents = [_steady(json.loads(line)) for line in out.splitlines()]
    errors = [json.loads(line)["code"] for line in err.splitlines() if line.startswith("{")]
    return {"exit": code, "documents": documents, "errors": errors}


def _steady(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _steady(item) for key, item in value.items() if key not in VARYING}
    return [_steady(item) for item in value] if isinstance(value, list) else value


def main() -> None:
    """Write the answers of this tree; of the commands that are named alone, if any are."""
    named = sys.argv[1:] or list(COMMANDS)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        stocked = folder / "stocked.footfit"
        known = os.environ | {"HOME": name, "PYTHONPATH": str(ROOT)}

        def run(words: str, where: Path) -> subprocess.CompletedProcess[str]:
            command = [sys.executable, "-m", "footfit", *words.split()]
            return subprocess.run(
                command, cwd=where, env=known, capture_output=True, text=True, check=False
            )

        run(f"ingest-last --manifest lasts.csv --catalogue {stocked}", SAMPLES)
        lay_out(folder, stocked)
        kept = json.loads(KEPT.read_text(encoding="utf-8"))
        answers = {title: kept.get(title) for title in COMMANDS}
        for title in named:
            words = COMMANDS[title]
            done = run(f"{words} --json", folder)
            answers[title] = answer(done.returncode, done.stdout, done.stderr)
            print(f"{title}: {answers[title]['exit']} {answers[title]['errors']}", flush=True)
    lines = [f"{json.dumps(key)}: {json.dumps(value)}" for key, value in answers.items()]
    KEPT.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
