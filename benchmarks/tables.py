"""Tables of the benchmarks: printed, and with ``--write`` put between the markers of a page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1] / "docs"


def markdown(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def put(page: str, name: str, text: str) -> None:
    """Replace what stands between ``<!-- table:NAME -->`` and the next ``<!-- end -->``."""
    path = DOCS / page
    content = path.read_text(encoding="utf-8")
    start = f"<!-- table:{name} -->"
    before, rest = content.split(start, 1)
    _, after = rest.split("<!-- end -->", 1)
    path.write_text(f"{before}{start}\n{text}\n<!-- end -->{after}", encoding="utf-8")
