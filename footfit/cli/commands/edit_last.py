"""``footfit edit-last``: other labels for a last."""

from __future__ import annotations

from typing import Any

from footfit.cli import options

LABELS = "What people say of the last"


def _label(flag: str, metavar: str, text: str) -> Any:
    return options.option(flag, text, metavar, panel=LABELS)


def edit_last(
    last: str = options.LAST,
    style: str | None = _label("--style", "S", "Set the style, such as derby."),
    size: str | None = _label("--size", "42", "Set the size as it is marked."),
    size_system: str | None = _label(
        "--size-system", "eu", "Set the system of the size, such as eu or uk."
    ),
    width_label: str | None = _label("--width-label", "G", "Set the width as it is marked."),
    family: str | None = _label(
        "--family", "F", "Set the family: the lasts of one model in all sizes and widths."
    ),
    parent: str | None = _label(
        "--parent", "LAST", "Set the last of the catalogue that this one was made from."
    ),
    heel_height: str | None = _label(
        "--heel-height", "MM", "Set the heel height in mm. The last is then measured again."
    ),
    toe_spring: str | None = _label(
        "--toe-spring", "MM", "Set the toe spring at the tip in mm. The last is measured again."
    ),
    platform: str | None = _label(
        "--platform", "MM", "Set the height under the forepart in mm. The last is measured again."
    ),
    *,
    lasts: options.Lasts,
    mode: options.OutputMode,
) -> object:
    """Change labels of a last. An empty value removes a label: --style "".

    footfit says which labels the geometry contradicts.

    Example: footfit edit-last derby-42 --size 42 --size-system eu --heel-height 25
    """
    texts = {
        "style": style,
        "size": size,
        "size_system": size_system,
        "width_label": width_label,
        "family": family,
        "parent": parent,
    }
    heights = {
        "heel_height_mm": heel_height,
        "toe_spring_mm": toe_spring,
        "platform_mm": platform,
    }
    labels: dict[str, Any] = {name: text for name, text in texts.items() if text is not None}
    labels |= {name: height(text, name) for name, text in heights.items() if text is not None}
    return lasts.open().edit_last(last, **labels)


def height(text: str, label: str) -> float | None:
    """A height in mm as it was typed; None for an empty text.

    Raises
    ------
    BadOption
        It is no number.
    """
    from footfit.errors import BadOption

    try:
        return float(text.replace(",", ".")) if text.strip() else None
    except ValueError as error:
        flag = "--" + label.removesuffix("_mm").replace("_", "-")
        words = f'{flag} takes a number of mm, or "" to remove the label, not {text!r}'
        raise BadOption(words) from error
