"""Feet that are matched with no last: lasts in their place, feet whose length is not known."""

from __future__ import annotations

from collections.abc import Sequence

from footfit.errors import BadOption, HalfScan, OtherKind
from footfit.pipeline.scan.one_shape import SURE_KIND
from footfit.results import Profiled


def refuse_lasts(feet: Sequence[Profiled], *, forced: bool = False, hint: str = "") -> None:
    """Refuse a last in place of a foot; ``hint`` ends the message.

    Raises
    ------
    BadOption
        It is a last of the catalogue.
    OtherKind
        By its shape it is surely a last, and it is not ``forced`` to be a foot.
    """
    for foot in feet:
        info, pose = foot.aligned.alignment.info, foot.aligned.alignment.pose
        if info.is_stored_last:
            words = (
                "is a last of the catalogue, not a foot: give a scan of a foot; --by shape finds"
                " lasts like this one, and footfit compare puts it into another"
            )
            raise BadOption(words, info.path)
        if pose.kind == "last" and foot.aligned.prepared.kind_margin > SURE_KIND and not forced:
            words = (
                "is surely a last, not a foot: give a scan of a foot; footfit match --by shape"
                " finds lasts like this one"
            )
            raise OtherKind(f"{words}{hint}", info.path)


def refuse_unknown_length(feet: Sequence[Profiled]) -> None:
    """Refuse a foot without a known length: lasts that are too small would pass the gate.

    Raises
    ------
    HalfScan
        A foot's length is not known.
    """
    for foot in feet:
        alignment = foot.aligned.alignment
        if alignment.length.value is None:
            words = f"{alignment.length.reason}; no last is judged without it: scan again"
            raise HalfScan(words, alignment.info.path)
