"""What every result is made of, and how it becomes JSON; docs/json.md lists every key.

A number is rounded by the unit that its key names: mm, mm2 and degrees to 0.001, cm2 to 0.1,
everything else to 0.000001.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

from footfit.version import __version__

Json = dict[str, Any]
SideName = Literal["left", "right"]
Confidence = Literal["sure", "low", "undecided"]
KindName = Literal["foot", "last"]
KindWord = Literal["sure", "low", "given"]
Method = Literal["footfit", "paper", "paper-literal"]
SearchBy = Literal["fit", "flare", "shape"]
Verdict = Literal["good", "acceptable", "poor", "reject"]
VERDICTS: tuple[Verdict, ...] = ("good", "acceptable", "poor", "reject")
"""The verdicts, the best first."""

MILLIMETRE_DIGITS = 3
RATIO_DIGITS = 6
_UNIT_DIGITS = {"mm": MILLIMETRE_DIGITS, "mm2": MILLIMETRE_DIGITS, "deg": 3, "cm2": 1}


# ---------------------------------------------------------------- JSON


def part(keys: Mapping[str, object]) -> Json:
    """``keys`` with their values as JSON can carry them.

    Floats are rounded by the unit of their key, and None if they are not finite. Arrays and
    tuples become lists, results their ``to_dict()``. A dict stays as it is: it is a part already.

    Examples
    --------
    >>> part({"length_mm": 252.12345, "score": -0.0000001, "shift_mm": (1.0, float("nan"))})
    {'length_mm': 252.123, 'score': 0.0, 'shift_mm': [1.0, None]}
    """
    return {key: _plain(value, digits_of(key)) for key, value in keys.items()}


def rows(columns: Sequence[str], values: Iterable[Sequence[object]]) -> list[Json]:
    """The rows of a table as dicts, their values as `part` gives them."""
    return [part(dict(zip(columns, row, strict=True))) for row in values]


def fields(result: Any, *without: str) -> Json:
    """The fields of a result by name, except for those in ``without``."""
    names = (field.name for field in dataclasses.fields(result))
    return {name: getattr(result, name) for name in names if name not in without}


def exact(parameters: Mapping[str, object]) -> Json:
    """The parameters of a definition as JSON can carry them: not rounded, and finite or null.

    Examples
    --------
    >>> exact({"sd": 0.1, "limit": float("inf"), "windows": ((0.08, 0.3),)})
    {'sd': 0.1, 'limit': None, 'windows': [[0.08, 0.3]]}
    """
    return {key: _plain(value, None) for key, value in parameters.items()}


def digits_of(key: str) -> int:
    """How many decimals a number has under this key.

    Examples
    --------
    >>> digits_of("length_mm"), digits_of("area_cm2"), digits_of("k1_per_mm")
    (3, 1, 6)
    """
    quantity, _, unit = key.rpartition("_")
    return RATIO_DIGITS if quantity.endswith("_per") else _UNIT_DIGITS.get(unit, RATIO_DIGITS)


def json_number(value: float | None, digits: int | None = MILLIMETRE_DIGITS) -> float | None:
    """``value`` to so many decimals (all if ``digits`` is None); None for NaN and infinity.

    Examples
    --------
    >>> json_number(1.23456, 3), json_number(-0.0001, 3), json_number(float("nan"), 3)
    (1.235, 0.0, None)
    """
    if value is None or not math.isfinite(value):
        return None
    return float(value) if digits is None else round(float(value), digits) + 0.0


def _plain(value: Any, digits: int | None) -> object:
    if hasattr(value, "to_dict"):
        return value.to_dict()
    if hasattr(value, "tolist"):  # an array, or a number of NumPy's
        value = value.tolist()
    if isinstance(value, tuple | list):
        return [_plain(item, digits) for item in value]
    return json_number(value, digits) if isinstance(value, float) else value


class Part:
    """A result that is a part of documents: its fields, except for those ``not_written``."""

    __slots__ = ()
    not_written: ClassVar[tuple[str, ...]] = ()

    def _keys(self) -> Json:
        return fields(self, *self.not_written)

    def to_dict(self) -> Json:
        """The keys as JSON has them."""
        return part(self._keys())


def in_mm(keys: Json) -> Json:
    """Keys whose numbers have the digits of millimetres: the unit is in a key of its own."""
    return {key: json_number(v) if isinstance(v, float) else v for key, v in keys.items()}


class Document(Part):
    """A result that is a document of its own: its keys under a ``schema`` and this version."""

    __slots__ = ()
    schema: ClassVar[str]

    def to_dict(self) -> Json:
        """The document that the command prints with ``--json``."""
        header = {"schema": f"footfit.{self.schema}", "footfit_version": __version__}
        return header | part(self._keys())


# ---------------------------------------------------------------- values


@dataclass(frozen=True, slots=True)
class Measured:
    """A measured value with its uncertainty, or the reason why there is none.

    ``sd`` is the repeatability: how far a second scan of the same shape reads another value.
    ``total_sd`` also holds what is known of the trueness. ``bias`` is the mean error that is known;
    it is in ``total_sd``, and it is not subtracted. None where nothing is known of them.
    """

    value: float | None
    sd: float | None = None
    reason: str | None = None
    total_sd: float | None = None
    bias: float | None = None

    def to_dict(self) -> Json:
        """All in mm, and a ``reason`` only if the value is null.

        Examples
        --------
        >>> Measured(262.31049, 0.4).to_dict()
        {'value': 262.31, 'sd': 0.4, 'total_sd': None, 'bias': None, 'reason': None}
        """
        value = json_number(self.value)
        return {
            "value": value,
            "sd": json_number(self.sd),
            "total_sd": json_number(self.total_sd),
            "bias": json_number(self.bias),
            "reason": None if value is not None else self.reason or "not measured",
        }


LABELS = ("style", "size", "size_system", "width_label")
"""What people say of a last first."""
FIT_NAMES = ("length", "ball_width", "ball_girth", "heel_width", "instep_girth")
"""The measures and clearances that every document names, measured or not."""

NOT_YET = Measured(None, reason="this version does not measure it")


@dataclass(frozen=True, slots=True)
class Measure:
    """One row of a shape's measures: a new measure is a new row, never a new column."""

    name: str
    measured: Measured
    definition: str

    @property
    def unit(self) -> str:
        """Either "deg", if the name ends so, or "mm"."""
        return "deg" if self.name.endswith("_deg") else "mm"

    @property
    def words(self) -> str:
        """The name in words, without its unit.

        Examples
        --------
        >>> Measure("seat_angle_deg", NOT_YET, "seat_angle_deg/1").words
        'seat angle'
        """
        return self.name.removesuffix("_deg").replace("_", " ")


@dataclass(frozen=True, slots=True)
class Notice(Part):
    """A warning: a stable ``code`` for scripts, a ``message`` for people.

    ``path`` is the file that it speaks of, where that is not the file of the result.
    """

    code: str
    message: str
    path: str | None = dataclasses.field(default=None, compare=False)

    not_written = ("path",)


def notices_about(path: str | None, notices: Iterable[Notice]) -> tuple[Notice, ...]:
    """Notices that speak of a file; those that speak of another one stay as they are."""
    return tuple(dataclasses.replace(each, path=each.path or path) for each in notices)


def count_notice(code: str, count: int, words: str, one: str = "") -> tuple[Notice, ...]:
    """A notice of how many there were; none if there were none. ``one`` are the words for one.

    Examples
    --------
    >>> count_notice("spikes_pressed", 1, "spikes were pressed", "spike was pressed")[0].message
    '1 spike was pressed'
    """
    return (Notice(code, f"{count:,} {one if one and count == 1 else words}"),) if count else ()


def measured_part(values: Iterable[tuple[str, Measured]]) -> Json:
    """Measured values by name, completed with the names that every document has."""
    return part(dict.fromkeys(FIT_NAMES, NOT_YET) | dict(values))


def measures_part(measures: Iterable[Measure]) -> Json:
    """Every measure by its name, completed with the names that every document has."""
    return measured_part((measure.name, measure.measured) for measure in measures)
