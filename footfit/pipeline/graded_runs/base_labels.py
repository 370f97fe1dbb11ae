"""The size, the width and the size system of a base: as labelled, or as they are given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from footfit.errors import BadOption
from footfit.geometry.fit.sizes import SizeSystem, label_number, system_named
from footfit.pipeline.graded_runs.grading_rules import known_system
from footfit.results import LastLabels

EXAMPLES = {"size_system": "eu", "base_size": "42", "base_width": "F"}
"""What is asked for, with an example of each."""


@dataclass(frozen=True, slots=True)
class KnownLabels:
    """The size system of a base, its size and its width; the width is None if it is not known."""

    system: SizeSystem
    size: str
    width: str | None


def known_labels(labels: LastLabels, asked: Mapping[str, object], name: str) -> KnownLabels:
    """What is known of a base by its labels and by what was ``asked``.

    ``name`` is what an error names: the last, or its file.

    Raises
    ------
    BadOption
        Something is not known, and the message asks for all of it together; the size system is none
        that there is; what was given contradicts a label.
    """
    said = {key: str(value) for key, value in asked.items() if value and key in EXAMPLES}
    system_name = said.get("size_system") or labels.size_system
    system = None if system_name is None else known_system(system_name)
    own = labels.size_system is None or system_named(labels.size_system) == system
    size = said.get("base_size") or (labels.size if own else None)
    width = said.get("base_width") or labels.width_label
    if size is None and labels.size is not None and system is not None:
        words = f"its size {labels.size} is of {labels.size_system}: add --base-size in"
        raise BadOption(f"{words} {system.name}", name)
    needed = {"size_system": system_name, "base_size": size}
    needed |= {"base_width": width} if asked.get("widths") else {}
    if missing := [key for key, value in needed.items() if value is None]:
        nouns = " and ".join(key.replace("base_", "").replace("_", " ") for key in missing)
        verb = "is" if len(missing) == 1 else "are"
        options = " ".join(f"--{key.replace('_', '-')} {EXAMPLES[key]}" for key in missing)
        raise BadOption(
            f"the {nouns} of the base {verb} not known: add for example {options}", name
        )
    assert system is not None
    assert size is not None
    if own:
        _refuse_contradiction("size", labels.size, said.get("base_size"), name)
    _refuse_contradiction("width", labels.width_label, said.get("base_width"), name)
    return KnownLabels(system, size, width)


def _refuse_contradiction(what: str, label: str | None, given: str | None, name: str) -> None:
    """Refuse a size or a width that is not the one of the label."""
    if label is None or given is None or label.casefold() == given.casefold():
        return
    numbers = label_number(label), label_number(given)
    if numbers[0] is not None and numbers[0] == numbers[1]:
        return
    words = f"its label has the {what} {label}, and --base-{what} says {given}"
    raise BadOption(
        f"{words}: leave it out, or correct the label with edit-last or in run.csv", name
    )
