"""Room for single places of a custom last: what is refused, and what is said."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from footfit.errors import BadOption
from footfit.pipeline.last_making.custom.custom_aims import CustomAim
from footfit.pipeline.last_making.custom.custom_rooms import change_notices, refuse_unknown


@pytest.mark.parametrize("size_mm", [0.0, -3.0, float("nan"), 12.1])
def test_room_is_more_than_nothing(size_mm) -> None:
    with pytest.raises(
        BadOption, match=r"the room at .* must be more than 0 and up to 12 mm, not "
    ):
        refuse_unknown({"ball-medial": size_mm})


def test_room_that_changes_a_measure_is_said() -> None:
    firm = CustomAim("ball_girth_least", "ball_girth", 230.0, 226.0)
    free = replace(firm, measure="ball_girth", firm=False)
    aims = [firm, replace(firm, measure="ball_width"), free]
    (notice,) = change_notices(aims, np.array([-0.31, 0.25, 3.0]))
    assert notice.code == "room_changes"
    assert notice.message.endswith("from their targets: least ball girth -0.3 mm")
    assert change_notices(aims, np.array([0.2, -0.2, 3.0])) == ()
