"""Readers of what footfit writes for people and for spreadsheets: see `tests.readback`.

The page is read as a browser shows it: headings, tables, lists and sentences, no class and no id.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser

from tests.readback import Reading

VOID = {"meta", "br", "img", "input", "link", "hr", "rect"}
UNSEEN = {"script", "style", "title", "svg", "canvas"}
HOW_TO_READ = "How to read it"
COLUMNS = ("room", "flare", "distance", "why", "verdict")
"""A word of each column's head on the page, in the table of the lasts."""


# ------------------------------------------------------------------ the page


@dataclass
class Node:
    """An element of the page; ``inside`` are texts and elements in order."""

    tag: str
    shown: dict[str, str | None] = field(default_factory=dict)
    inside: list[Node | str] = field(default_factory=list)

    def walk(self) -> Iterator[Node]:
        """This element and all in it, in order."""
        yield self
        for part in self.inside:
            if isinstance(part, Node):
                yield from part.walk()

    def every(self, *tags: str) -> list[Node]:
        """The elements of these tags in it."""
        return [node for node in self.walk() if node.tag in tags]

    def one(self, *tags: str) -> Node:
        """The first of them."""
        return self.every(*tags)[0]

    @property
    def text(self) -> str:
        """What is read of it: a mark with its word, which a screen reader says, behind it."""
        if self.tag in UNSEEN:
            return ""
        parts = [part if isinstance(part, str) else part.text for part in self.inside]
        words = " ".join(" ".join(parts).split())
        title = self.shown.get("title")
        return f"{words} ({title})" if title else words


class _Tree(HTMLParser):
    """Builds the elements, and complains where they are not nested."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.root = Node("page")
        self.open = [self.root]
        self.feed(page)
        assert self.open == [self.root], [node.tag for node in self.open]

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        node = Node(tag, dict(attrs))
        self.open[-1].inside.append(node)
        if tag not in VOID:
            self.open.append(node)

    def handle_endtag(self, tag: str) -> None:
        if tag not in VOID:
            assert self.open.pop().tag == tag, tag

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.open[-1].inside.append(Node(tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.open[-1].inside.append(data)


def tree(page: str) -> Node:
    """A page's elements."""
    return _Tree(page).root


def read_match_page(page: str) -> Reading:
    """The page of a match."""
    body, reading = tree(page).one("body"), Reading()
    taken: list[Node] = []
    _headline(body, reading, taken)
    for number, card in enumerate(_cards(body), 1):
        _card(card, f"foot {number}", reading)
        taken.append(card)
    rooms = 0
    for table in body.every("table"):
        heads = [head.text for head in table.one("thead").every("th")]
        first = heads[0].lower()
        taken.append(table)
        if any("why" in head.lower() for head in heads):
            _lasts(table, heads, reading)
        elif first.startswith("zone by zone"):
            _zones(table, heads, reading)
        elif first == "zone":
            rooms += 1
            _rooms(table, heads, f"room {rooms}", reading)
        else:
            _surfaces(table, reading)
    _notes(body, taken, "", reading)
    _legend(body, taken, reading)
    _sentences(body, taken, reading)
    return reading


def read_compare_page(page: str) -> Reading:
    """The page of one foot in one last."""
    body, reading = tree(page).one("body"), Reading()
    title, lead = body.one("h1"), body.one("p")
    reading.cells |= {"title": title.text, "lead": lead.text}
    taken = [title, lead]
    for table in body.every("table"):
        heads = [head.text for head in table.one("thead").every("th")]
        taken.append(table)
        if heads[0].lower() == "zone":
            _rooms(table, heads, "room 1", reading)
        else:
            _sections(table, heads, reading)
    _notes(body, taken, "", reading)
    _legend(body, taken, reading)
    _sentences(body, taken, reading)
    return reading


def _headline(body: Node, reading: Reading, taken: list[Node]) -> None:
    """The lead, and the block of the first bold words: the best last."""
    title, (first, second, *_) = body.one("h1"), body.every("p")
    named = first if [node.text for node in first.every("b")] == [first.text] else None
    lead = second if named else first
    if named:
        reading.cells["customer"] = named.text
        taken.append(named)
    blocks = body.every("div")
    bold = next(  # the head of the page and the notes stand in no block of their own
        node
        for node in body.every("b")
        if not node.text.startswith("Note") and any(node in block.walk() for block in blocks)
    )
    block = [node for node in blocks if bold in node.walk()][-1]
    verdict = " ".join(node.text for node in block.inside if isinstance(node, Node))
    reading.cells |= {"lead": lead.text, "best last": bold.text, "best": verdict}
    taken += [title, lead, block]


def _cards(body: Node) -> list[Node]:
    """The blocks of the feet: the smallest ones with a heading and a list of terms."""
    blocks = [node for node in body.every("section", "div") if node.every("dl")]
    return [
        node
        for node in blocks
        if not any(other in node.walk() for other in blocks if other is not node)
    ]


def _card(card: Node, name: str, reading: Reading) -> None:
    reading.cells[f"{name} title"] = card.one("h3").text
    chips = card.every("li")
    if chips:
        reading.cells[f"{name} sizes"] = " ".join(chip.text for chip in chips)
    for term, value in zip(card.every("dt"), card.every("dd"), strict=True):
        reading.cells[f"{name} {term.text.lower()}"] = value.text
    for words in card.every("p"):
        if not _is_note(words):
            reading.cells[f"{name} lacking"] = words.text
    _notes(card, [], f"{name} ", reading)


def _is_note(node: Node) -> bool:
    return node.tag == "p" and node.text.startswith("Note:")


def _notes(body: Node, taken: list[Node], name: str, reading: Reading) -> None:
    known = {id(inner) for node in taken for inner in node.walk()}
    notes = [node for node in body.every("p") if _is_note(node) and id(node) not in known]
    for number, node in enumerate(notes, 1):
        reading.cells[f"{name}note {number}"] = node.text.removeprefix("Note:").strip()
    taken += notes


def _lasts(table: Node, heads: list[str], reading: Reading) -> None:
    lower = [head.lower().replace("length", "room") for head in heads]  # by shape: no toe room
    named = {place: word for word in COLUMNS for place, head in enumerate(lower) if word in head}
    for row in table.one("tbody").every("tr"):
        cells = [cell.text for cell in row.every("th", "td")]
        assert len(cells) == len(heads)
        names = {0: "rank", 1: "name"} | named
        for place, text in enumerate(cells):
            reading.cells[f"last {cells[0]} {names[place]}"] = text


def _zones(table: Node, heads: list[str], reading: Reading) -> None:
    for row in table.one("tbody").every("tr"):
        name, asked, *lasts = (cell.text for cell in row.every("th", "td"))
        reading.cells[f"zone {name} asked"] = asked
        for last, text in zip(heads[2:], lasts, strict=True):
            reading.cells[f"zone {name} {last}"] = text


def _rooms(table: Node, heads: list[str], name: str, reading: Reading) -> None:
    words = [re.sub(r", .*", "", head.lower()) for head in heads[1:]]
    columns = ["from 5 to 95 %" if "95" in word else word for word in words]
    for row in table.one("tbody").every("tr"):
        zone, *cells = (cell.text for cell in row.every("th", "td"))
        for column, text in zip(columns, cells, strict=True):
            reading.cells[f"{name} {zone} {column}"] = text


def _surfaces(table: Node, reading: Reading) -> None:
    """The lines of each last, in the order of the lasts' ranks: a line a foot."""
    names = {
        text: key for key, text in reading.cells.items() if re.fullmatch(r"last \d+ name", key)
    }
    for row in table.one("tbody").every("tr"):
        name, lines = row.every("th", "td")
        place = next(key for text, key in names.items() if text.startswith(f"{name.text} "))
        texts = [part for part in lines.inside if isinstance(part, str) and part.strip()]
        for number, text in enumerate(texts, 1):
            reading.cells[place.replace("name", f"surface {number}")] = text


def _sections(table: Node, heads: list[str], reading: Reading) -> None:
    columns = [re.sub(r",.*| edge", "", head.lower()) for head in heads[1:]]
    for row in table.one("tbody").every("tr"):
        station, *cells = (cell.text for cell in row.every("th", "td"))
        for column, text in zip(columns, cells, strict=True):
            reading.cells[f"section {station} {column}"] = text


def _legend(body: Node, taken: list[Node], reading: Reading) -> None:
    """The words that explain the page; of their numbers only the two that are this answer's."""
    block = next(
        node
        for node in reversed(body.every("div", "section"))
        if any(head.text == HOW_TO_READ for head in node.every("h2"))
    )
    reference = re.search(r"reference last is ([^ ]+)\.", block.text)
    definition = re.search(r"definition ([^ )]+)", block.text)
    if reference:
        reading.cells["reference"] = reference[1]
    if definition:
        reading.cells["definition"] = definition[1]
    taken += [block, *body.every("footer")]


def _sentences(body: Node, taken: list[Node], reading: Reading) -> None:
    known = {id(inner) for node in taken for inner in node.walk()}
    for node in body.every("p", "figcaption", "h1", "h2", "li"):
        if id(node) not in known and node.text:
            reading.said.append(node.text)


# ------------------------------------------------------------------ CSV


def rows_of(text: str) -> list[dict[str, str]]:
    """A CSV's rows; a formula's guard, an apostrophe before a sign, is taken off."""
    found = list(csv.DictReader(io.StringIO(text)))
    assert all(None not in row and None not in row.values() for row in found)
    return found


def read_match_csv(text: str) -> Reading:
    """The rows of a match: the feet are counted by their path, in the order of the rows."""
    reading, paths = Reading(), []
    for row in rows_of(text):
        if row["path"] not in paths:
            paths.append(row["path"])
        foot = paths.index(row["path"]) + 1
        for column, cell in row.items():
            _once(reading, f"foot {foot} last {row['rank']} {column}", cell)
    return reading


def read_keyed_csv(text: str, *keys: str) -> Reading:
    """Rows that these columns name; the other columns are the cells."""
    reading = Reading()
    for row in rows_of(text):
        name = " ".join(row.pop(key) for key in keys)
        for column, cell in row.items():
            _once(reading, f"{name} {column}", cell)
    return reading


def read_stations_csv(text: str) -> Reading:
    """A row per station of one profile."""
    reading = Reading()
    for number, row in enumerate(rows_of(text), 1):
        for column, cell in row.items():
            reading.cells[f"station {number} {column}"] = cell
    return reading


def _once(reading: Reading, name: str, cell: str) -> None:
    assert name not in reading.cells, f"{name} stands there twice"
    reading.cells[name] = cell


# ------------------------------------------------------------------ the terminal


def read_match_terminal(text: str) -> Reading:
    """A match in a terminal that is wide enough for every line."""
    reading, rank, heads = Reading(), "", []
    zones = False
    for line in text.splitlines():
        cells = re.split(r"\s{2,}", line.strip())
        if set(line.strip()) <= {"─"}:
            continue
        if re.match(r"\s{2,}last\s{2,}style", line):
            heads = ["rank", "name", "labels", *(["verdict"] if "verdict" in cells else [])]
            heads += ["room", "flare", "distance"]
        elif re.match(r" ?\d+  \S", line) and heads and not zones:
            rank = cells[0]
            for head, cell in zip(heads, cells, strict=True):
                _once(reading, f"last {rank} {head}", cell)
        elif rank and line.startswith("    ") and not zones and "mm     deg" not in line:
            lines = sum(key.startswith(f"last {rank} surface") for key in reading.cells)
            why = f"last {rank} why" not in reading.cells
            name = "why" if why else f"surface {lines + 1}"
            _once(reading, f"last {rank} {name}", line.strip())
        elif cells[0] == "zone":
            zones = True
        elif zones and line.startswith(" ") and len(cells) > 2:
            zone, *feet, asked, verdict = cells
            _once(reading, f"zone {zone} asked", asked)
            _once(reading, f"zone {zone} verdict", verdict)
            for number, cell in enumerate(feet, 1):
                _once(reading, f"zone {zone} foot {number}", cell)
        elif line.strip() and not re.fullmatch(r"\s*mm\s+deg", line):
            reading.said.append(line.strip())
    return reading


def read_compare_terminal(text: str) -> Reading:
    """A comparison in a terminal: two tables with lines between."""
    reading, heads = Reading(), []
    for line in text.splitlines():
        cells = re.split(r"\s{2,}", line.strip())
        if not line.strip() or set(line.strip()) <= {"─"}:
            continue
        if cells[0] in ("zone", "section"):
            kind, *heads = cells
            names = [re.sub(r" mm| cm2| edge", "", head) for head in heads]
            names = ["area" if name.startswith("of") else name for name in names]
        elif heads and line.startswith(" ") and len(cells) == len(heads) + 1:
            place = f"section {cells[0]}" if kind == "section" else f"room 1 {cells[0]}"
            for name, cell in zip(names, cells[1:], strict=True):
                _once(reading, f"{place} {name}", cell)
        else:
            reading.said.append(line.strip())
    return reading


def read_terms(text: str, *, titled: bool = True) -> Reading:
    """A title, if there is one, and names with values in two columns."""
    title, *lines = text.splitlines() if titled else ["", *text.splitlines()]
    reading = Reading({"title": title} if titled else {})
    for line in lines:
        name, value = re.split(r"\s{2,}", line.strip(), maxsplit=1)
        _once(reading, name, value)
    return reading


def read_lasts_terminal(text: str) -> Reading:
    """The library's table: a line per last."""
    reading = Reading()
    columns = (
        *("last", "marks", "style", "size", "side"),
        *("length", "ball", "flare", "class", "heel"),
    )
    for line in text.splitlines():
        cells = re.split(r"\s{2,}", line.strip())
        if len(cells) == len(columns) and cells[0] != "last":
            name = cells[0].removesuffix(" *")
            for column, cell in zip(columns, cells, strict=True):
                _once(reading, f"{name} {column}", cell)
        elif line.strip() and cells[0] not in ("last", "mm") and set(line.strip()) - {"─"}:
            reading.said.append(line.strip())
    return reading
