"""Draw a last or a foot in true size: from an aligned shape to its views."""

from __future__ import annotations

from footfit.errors import OtherKind
from footfit.geometry.drawing.views import views
from footfit.pipeline.last_making.tolerances import TOLERANCE_MM
from footfit.pipeline.scan.measure import check_side, scan_measures
from footfit.results import AlignedScan, Drawing, Profiled

FOOT_WORDS = "its shape is a foot's, not a last's: add --foot to draw it as a foot"
LAST_WORDS = "its shape is a last's, not a foot's: leave --foot out"


def drawing_of(shape: AlignedScan | Profiled, *, foot: bool = False) -> Drawing:
    """The views and the measures of a last, or of a ``foot``, on its own side.

    Raises
    ------
    OtherKind
        By its shape it is a foot where a last is asked for, or the other way round.
    SideUndecided
        Neither the user nor the shape says which side it is.
    """
    aligned = shape.aligned if isinstance(shape, Profiled) else shape
    alignment, prepared = aligned.alignment, aligned.prepared
    is_last = alignment.info.is_stored_last or alignment.pose.kind == "last"
    if foot == is_last:
        raise OtherKind(LAST_WORDS if foot else FOOT_WORDS, alignment.info.path)
    check_side(alignment)
    seen, missing = views(prepared.shape)
    if alignment.side.side == "left":
        seen = tuple(view.mirrored() for view in seen)
    measures = shape.measures if isinstance(shape, Profiled) else scan_measures(prepared)
    labels = (shape.labels if isinstance(shape, Profiled) else None) or {}
    tolerance_mm = {} if foot else TOLERANCE_MM
    has_rim = bool(prepared.shape.filled.any())
    return Drawing(alignment, measures, seen, missing, labels, tolerance_mm, has_rim)
