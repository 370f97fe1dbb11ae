"""Left or right by the name of a file, in the languages of those who name scans.

A word counts as a whole token of the name, in any case, with or without its accents.
"""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass
from pathlib import Path

from footfit.results import SideName


def _plain(word: str) -> str:
    """A word in lower case without its accents."""
    split = unicodedata.normalize("NFD", word.casefold())
    return unicodedata.normalize("NFC", "".join(c for c in split if not unicodedata.combining(c)))


_WORDS: dict[SideName, str] = {
    "left": """left links linke linker linkes gauche izquierdo izquierda esquerdo esquerda sinistro
        sinistra esquerra vänster venstre lewy lewa levý levá vasen stâng stânga левый левая левое
        лівий ліва αριστερό αριστερή αριστερά 左 左足 左脚 왼쪽 왼발""",
    "right": """right rechts rechte rechter rechtes droit droite derecho derecha direito direita
        destro destra dret dreta höger højre høyre prawy prawa pravý pravá oikea drept dreapta
        правый правая правое правий права δεξί δεξιό δεξιά 右 右足 右脚 오른쪽 오른발""",
}
_FOOT = """foot feet fuß fuss pied pie pé piede voet fot fod jalka stopa noga нога стопа πόδι 足 脚
    발 scan mesh 3d"""
"""What names no customer."""
_LETTERS: dict[SideName, str] = {"left": "l", "right": "r"}
_SHORT: dict[SideName, str] = {
    "left": "li lt lf lh izq izda izqda izqdo esq sx",
    "right": "re rt rf rh der dcha dcho dir dx",
}
_TIERS: tuple[dict[str, SideName], ...] = tuple(
    {_plain(word): side for side, words in tier.items() for word in words.split()}
    for tier in (_WORDS, _LETTERS, _SHORT)
)
"""A word goes before a letter, and a letter before an abbreviation: Li_left is the foot of Li."""
_TOKEN = re.compile(r"[^\W_]+")
_EMPTY_BRACKETS = re.compile(r"\(\s*\)|\[\s*\]")


@dataclass(frozen=True, slots=True)
class SideInName:
    """What a name says: its ``sides``, of which there should be one, and the ``rest`` of it."""

    sides: frozenset[SideName]
    rest: str

    @property
    def side(self) -> SideName | None:
        """The side, if the name has exactly one."""
        return next(iter(self.sides)) if len(self.sides) == 1 else None


def side_in_name(name: str, *, short: bool = True) -> SideInName:
    """The side in a name without its folder and suffix; abbreviations count if ``short``.

    Examples
    --------
    >>> side_in_name("Ann-Smith_L").side, side_in_name("Ann-Smith_L").rest
    ('left', 'Ann-Smith')
    >>> side_in_name("pied DROIT, Zoé").rest
    'pied, Zoé'
    >>> side_in_name("Li_rechts").rest, side_in_name("Lee").sides
    ('Li', frozenset())
    >>> sorted(side_in_name("left_right").sides)
    ['left', 'right']
    """
    name = unicodedata.normalize("NFC", name)
    tokens = [(match, _plain(match.group())) for match in _TOKEN.finditer(name)]
    for tier in _TIERS if short else _TIERS[:2]:
        named = [(match, tier[word]) for match, word in tokens if word in tier]
        if named:
            rest = _without(name, [match.span() for match, _ in named])
            return SideInName(frozenset(side for _, side in named), rest)
    return SideInName(frozenset(), name)


def names_somebody(rest: str) -> bool:
    """Whether the rest of a name says more than that it is a scan of a foot.

    Examples
    --------
    >>> names_somebody("Fuß"), names_somebody("foot scan"), names_somebody("Ann foot")
    (False, False, True)
    """
    words = {_plain(word) for word in _FOOT.split()}
    return any(_plain(token) not in words for token in _TOKEN.findall(rest))


def side_of_file(path: str | None) -> SideName | None:
    """The side that the name of a file says beyond doubt: in a word, or with L or R.

    Examples
    --------
    >>> side_of_file("scans/ann_R.stl"), side_of_file("scans/der.stl"), side_of_file(None)
    ('right', None, None)
    """
    return side_in_name(Path(path).stem, short=False).side if path else None


def _without(name: str, spans: list[tuple[int, int]]) -> str:
    """A name without some of its tokens; one separator goes with each."""
    for start, end in reversed(spans):
        before, after = name[:start], name[end:]
        name = before.rstrip(" _-.") + after if before.strip(" _-.") else after
    return _EMPTY_BRACKETS.sub("", name).strip(" _-.,")
