"""Where the camera's head goes."""

import math

import pytest
from axis_camera_ptz.head import DEFAULTS, Head


def head(**changed):
    return Head.from_parameters({**DEFAULTS, **changed})


def test_it_goes_where_it_is_told_within_its_limits():
    camera = head()
    camera.go(0.5, 0.3, 100.0)
    assert (camera.pan, camera.tilt, camera.zoom) == (0.5, 0.3, 100.0)
    camera.go(0.25, -0.1, 50.0, relative=True)
    assert (camera.pan, camera.tilt, camera.zoom) == pytest.approx((0.75, 0.2, 150.0))
    camera.go(9.0, -9.0, 1e9)
    assert (camera.pan, camera.tilt, camera.zoom) == (2.97, 0.0, 20000.0)


def test_upside_down_it_turns_the_other_way():
    camera = head(invert_ptz=True, min_tilt_value=-1.0)
    camera.go(0.5, 0.3, 10.0)
    assert (camera.pan, camera.tilt, camera.zoom) == (-0.5, -0.3, 10.0)


def test_what_is_no_number_changes_nothing():
    camera = head()
    camera.go(0.5, 0.3, 1.0)
    camera.go(math.nan, 0.0, 0.0)
    assert (camera.pan, camera.tilt) == (0.5, 0.3)
    with pytest.raises(ValueError, match="min_pan_value 3 is above max_pan_value 2.97"):
        head(min_pan_value=3.0)
    with pytest.raises(ValueError, match="max_zoom_value must be numbers"):
        head(max_zoom_value="far")
