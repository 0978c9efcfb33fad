"""<gui><camera> of a world."""

import math

import pytest
import rospy
from gazebo_ros.first_view import first_view
from ode_sim.description import ResourceFinder
from ode_sim.math3 import quat_rotate

WORLD = """<sdf version="1.6"><world name="w"><gui fullscreen="1">{}</gui></world></sdf>"""
CAMERA = '<camera name="user_camera"><pose frame="">{}</pose><view_controller>orbit</view_controller></camera>'


@pytest.fixture
def lines(monkeypatch):
    said = []
    monkeypatch.setattr(rospy, "logwarn", lambda text, *arguments: said.append(text % arguments))
    return said


def view(tmp_path, inside):
    file = tmp_path / "w.world"
    file.write_text(WORLD.format(inside))
    return first_view(str(file), ResourceFinder(environment=False))


def test_it_stands_there_and_looks_along_x(tmp_path, lines):
    eye = view(tmp_path, CAMERA.format("1 -2 3 0 0.5 1.5708"))
    assert eye.p == (1, -2, 3)
    ahead = quat_rotate(eye.q, (1, 0, 0))  # turned to the left, then down
    assert ahead == pytest.approx((0, math.cos(0.5), -math.sin(0.5)), abs=1e-5)
    assert not lines


def test_a_place_alone_looks_ahead(tmp_path, lines):
    eye = view(tmp_path, CAMERA.format("1 -2 3"))
    assert (eye.p, eye.q) == ((1, -2, 3), (0, 0, 0, 1)) and not lines


@pytest.mark.parametrize("inside", ["", "<camera name='user_camera'/>", "<plugin name='p' filename='libp.so'/>"])
def test_a_world_that_says_nothing_leaves_it_to_the_window(tmp_path, lines, inside):
    assert view(tmp_path, inside) is None and not lines


@pytest.mark.parametrize("numbers", ["somewhere", "1 2", "1 2 3 4", "nan 0 0 0 0 0", "1e30 0 0 0 0 0"])
def test_what_is_no_pose_is_one_line(tmp_path, lines, numbers):
    assert view(tmp_path, CAMERA.format(numbers)) is None
    assert len(lines) == 1 and "w.world" in lines[0] and "<gui><camera><pose>" in lines[0] and numbers in lines[0]
