"""The foot in the heel of a last: the model of how a foot changes, and what it changed."""

from __future__ import annotations

from dataclasses import dataclass

from footfit.number_words import plain
from footfit.results.values import Json, Measured, Part, exact, fields, part

FLARE = "flare_angle"
"""The rule of the flare angle, which changes by degrees; all other rules are of measures."""
WORTH_SAYING_MM = 1.0
"""A heel that changes the foot's length by less is not worth a word, unless it is unproven."""
NAMED_FROM = 0.5
"""The least change, in mm or degrees, that a sentence names."""


@dataclass(frozen=True, slots=True)
class HeelRule:
    """How one measure of a foot that was scanned flat changes in the heel, at the full drop.

    ``change`` and its standard deviation ``sd`` are shares of the measure, or degrees of the flare
    angle. ``grade`` says how well the sign and the size are known, ``why`` says from what.
    """

    measure: str
    change: float
    sd: float
    grade: str
    why: str

    def to_dict(self) -> Json:
        """The rule without its measure's name, which is its key."""
        return exact(fields(self, "measure"))


@dataclass(frozen=True, slots=True)
class HeelModel:
    """How a foot that was scanned flat changes with the drop of a last.

    The rules hold at ``full_drop_mm``; below, they hold in proportion. From ``unproven_from_mm`` on
    an answer says that the model is unproven. Over ``largest_drop_mm`` the change grows no more,
    and only the length is judged. ``sha256`` is of the values.
    """

    name: str
    version: int
    source: str
    full_drop_mm: float
    unproven_from_mm: float
    largest_drop_mm: float
    rules: tuple[HeelRule, ...]
    sha256: str

    @property
    def model_id(self) -> str:
        """The name with the version."""
        return f"{self.name}/{self.version}"

    def rule_of(self, measure: str) -> HeelRule | None:
        """The rule of a measure; None if the model does not change it."""
        return next((rule for rule in self.rules if rule.measure == measure), None)

    def to_dict(self) -> Json:
        """The whole model, its rules by measure."""
        rules = {rule.measure: rule.to_dict() for rule in self.rules}
        return exact(fields(self, "rules")) | {"rules": rules}


@dataclass(frozen=True, slots=True)
class HeelQuestion:
    """How feet are compared with lasts that have a heel.

    ``model`` is None for feet that are compared as scanned. ``scanned_at_drop_mm`` is the drop of
    what the foot stood on in the scanner: 0 is a flat floor. ``heel_lift_mm`` is put under the heel
    in the shoe, and adds to each last's drop.
    """

    model: HeelModel | None = None
    scanned_at_drop_mm: float = 0.0
    heel_lift_mm: float = 0.0


AS_SCANNED = HeelQuestion()


@dataclass(frozen=True, slots=True)
class HeelChange(Part):
    """What the heel of one last changes of one foot.

    ``drop_mm`` is None if the last's is not known: nothing is changed then. ``share`` of the full
    change was applied; it is - if the foot was scanned at a larger drop. ``changes`` are by
    measure: heel minus scan, in mm, or in degrees for the flare angle, with the model's standard
    deviation. ``length_only``: the model says nothing of girths there.
    """

    drop_mm: float | None
    scanned_at_drop_mm: float
    model: str
    share: float
    unproven: bool
    length_only: bool
    changes: tuple[tuple[str, Measured], ...]

    def _keys(self) -> Json:
        changes_mm = part({name: known for name, known in self.changes if name != FLARE})
        return fields(self, "changes") | {
            "changes_mm": changes_mm,
            "flare_change_deg": self.change_of(FLARE),
        }

    def change_of(self, measure: str) -> Measured | None:
        """The change of one measure; None if the model or the foot does not have it."""
        return dict(self.changes).get(measure)


def heel_words(heel: HeelChange | None, measures: tuple[str, ...]) -> str:
    """What the heel changes of the foot, in words; empty if it is not worth a word.

    Examples
    --------
    >>> from footfit.results import Measured
    >>> changes = (("length", Measured(-1.17, 0.8)), ("ball_girth", Measured(0.4, 1.1)))
    >>> heel = HeelChange(25.0, 0.0, "flat-to-heel/1", 0.31, False, False, changes)
    >>> heel_words(heel, ("length",))
    'at a drop of 25 mm the foot counts as 1.2 mm shorter'
    """
    length = None if heel is None else heel.change_of("length")
    if heel is None or heel.drop_mm is None or length is None or length.value is None:
        return ""
    if abs(length.value) < WORTH_SAYING_MM and not heel.unproven and not heel.length_only:
        return ""
    names = [name for name in measures if name == "length" or not heel.length_only]
    changes = [(name, heel.change_of(name)) for name in names]
    said = [
        _change_words(name, known.value)
        for name, known in changes
        if known is not None and known.value is not None and abs(known.value) >= NAMED_FROM
    ]
    doubt = " (unproven model)" if heel.unproven else ""
    parts = [f"the foot counts as {', '.join(said)}{doubt}"] if said else []
    parts += ["only the length is judged"] if heel.length_only else []
    return f"at a drop of {plain(heel.drop_mm, 0)} mm {' and '.join(parts)}" if parts else ""


def _change_words(measure: str, change: float) -> str:
    if measure == "length":
        return f"{plain(abs(change))} mm {'shorter' if change < 0 else 'longer'}"
    if measure == FLARE:
        return f"turned {plain(abs(change))} deg {'more' if change > 0 else 'less'} inward"
    size = "larger" if change > 0 else "smaller"
    return f"{measure.replace('_', ' ')} {plain(abs(change))} mm {size}"
