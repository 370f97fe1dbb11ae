"""The customer's sheet against the JSON document: what it must say, and a reader of it.

See `tests.readback`. The facts are made from the document alone, by rules that stand here a second
time.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from footfit import __version__
from tests.readback import MARKS, SAID, Fact, Reading, fact, plain
from tests.readers import Node, tree

SHEET = "sheet"
SYSTEMS = ("eu", "uk", "us-men", "us-women", "mondopoint")
ROWS = {"length": "Length", "ball_girth": "Around the ball", "ball_width": "Width of the ball"}


def sheet_facts(document: dict[str, Any], title: str, customer: str, day: str) -> Iterator[Fact]:
    """Everything with a number or a name on the sheet of a ``footfit.match`` document."""
    feet = document["feet"]
    values = [{name: foot["measures"][name]["value"] for name in ROWS} for foot in feet]
    longest = max(feet, key=lambda foot: foot["measures"]["length"]["value"])
    girths = [row["ball_girth"] or 0.0 for row in values]
    widest = feet[girths.index(max(girths))]["width"]
    system = document["size_system"] or "eu"
    yield fact("title", title, SHEET)
    yield fact("head", [customer, day], SHEET)
    yield fact("size 1", longest["sizes"][system]["words"], SHEET)
    fitting = widest["fittings"].get(system)
    after = 2
    if fitting is not None:
        yield fact("size 2", fitting["width"], SHEET)
        after = 3
    others = []
    for name in SYSTEMS:
        if name != system:
            others.append(longest["sizes"][name]["words"])
            if name in widest["fittings"]:
                others.append(widest["fittings"][name]["width"])
    yield fact(f"size {after}", others, SHEET)
    for people, share in widest["wider_than"].items():
        yield fact(f"wide {people}", _share(share, people), SHEET)
    for name, words in ROWS.items():
        numbers = [row[name] for row in values]
        if any(number is not None for number in numbers):
            shown = ["not measured" if n is None else plain(n) for n in numbers]
            yield fact(f"row {words}", shown, SHEET)
    if sorted(str(foot["side"]) for foot in feet) == ["left", "right"]:
        yield from _differences(values)
    best, fits = document["candidates"] or document["nearest"], bool(document["candidates"])
    yield from _shoes(best, fits=fits)
    if fits:
        places = [_places(fit) for fit in best[0]["fits"]]
        verdicts = {v for known in places for place, v in known.items() if place != "sole"}
        order = [verdict for verdict in MARKS if verdict in verdicts]
        marks = [text for verdict in order for text in (MARKS[verdict], verdict)]
        if marks:
            yield fact("marks", marks, SHEET)
    yield fact(f"{SAID} rounding", ["10", "5", "95"], SHEET)
    yield fact(f"{SAID} survey", ["1,986", "4,082", "2012", "17", "58"], SHEET)
    yield fact("footer", __version__, SHEET)


def _share(share: dict[str, Any], people: str) -> list[str]:
    """A share in steps of 10 %, from 5 to 95 %; below 50 as those who are wider."""
    if share["percent"] is None:
        return [share["reason"]]
    least = min(max(10 * int(share["percent"] / 10 + 0.5), 5), 95)
    than = ["wider", str(least)] if least >= 50 else ["narrower", str(100 - least)]
    return [*than, people]


def _differences(values: list[dict[str, float | None]]) -> Iterator[Fact]:
    number = 0
    for name, equal in (("length", 1.0), ("ball_girth", 2.0)):
        left, right = (row[name] for row in values)
        if left is None or right is None:
            continue
        number += 1
        off = round(abs(left - right), 1)  # as it is shown
        words = "equally" if off < equal else plain(off)
        yield fact(f"difference {number}", words, SHEET)


def _places(fit: dict[str, Any]) -> dict[str, str]:
    """The worst verdict at each place that the picture marks and the sentence names."""
    from footfit.report.wording.sheet_words import PLACES

    order = list(MARKS)
    worst: dict[str, str] = {}
    for zone, judged in fit["zones"].items():
        if judged["counts"] and judged["verdict"] is not None:
            place = PLACES[zone].name
            known = (worst.get(place, "good"), judged["verdict"])
            worst[place] = max(known, key=order.index)
    return worst


def _shoes(shown: list[dict[str, Any]], *, fits: bool) -> Iterator[Fact]:
    """The best shoe and the next."""
    for number, (name, candidate) in enumerate(zip(("best", "next"), shown, strict=False)):
        room = candidate["clearance_mm"]["length"]["value"]
        room_text = None if room is None else plain(abs(room))
        if number == 0 and not fits:
            yield fact("best 1", "No shoe here fits.", SHEET)
            yield fact("best 2", [candidate["last"], room_text], SHEET)
            continue
        system = (candidate["size_system"] or "").upper() or None
        labels = [candidate["style"], system, candidate["size"], candidate["width_label"]]
        labels.append(candidate["size_asked"])
        verdict = [MARKS[candidate["verdict"]], candidate["verdict"]]
        yield fact(f"{name} 1", [candidate["last"], *labels, *verdict], SHEET)
        yield fact(f"{name} 2", room_text, SHEET)
    if not shown:
        yield fact("best 1", "No shoe here could be judged.", SHEET)
    if fits and len(shown) == 1:
        yield fact("next 1", "No other shoe here fits.", SHEET)


def read_sheet(page: str) -> Reading:
    """What a customer reads on the sheet."""
    body, reading = tree(page).one("body"), Reading()
    reading.cells["title"] = body.one("h1").text
    reading.cells["head"] = body.one("header").one("p").text
    reading.cells["footer"] = body.one("footer").text
    for caption in body.every("figcaption"):
        reading.cells["marks"] = caption.text
    for row in body.one("tbody").every("tr"):
        name = row.one("th").text
        reading.cells[f"row {name}"] = " ".join(cell.text for cell in row.every("td"))
    for term, words in zip(body.every("dt"), body.every("dd"), strict=True):
        reading.cells[f"wide {term.text.lower()}"] = words.text
    for heading, name in (("Your size", "size"), ("Best shoe", "best"), ("The next", "next")):
        for part in body.every("div"):
            titles = part.every("h2")
            if titles and titles[0].text.startswith(heading):
                _cells(part, name, reading)
    for part in body.every("section"):
        if any(isinstance(child, Node) and child.tag == "table" for child in part.inside):
            _cells(part, "difference", reading)
    reading.said += [text.text for text in body.every("section")[-1].every("p")]
    return reading


def _cells(part: Node, name: str, reading: Reading) -> None:
    for number, text in enumerate(part.every("p"), 1):
        reading.cells[f"{name} {number}"] = text.text
