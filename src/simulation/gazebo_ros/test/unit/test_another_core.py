"""C++ reads the world where ode_sim has put it: not when the two were built with other headers."""

import subprocess
import sys

import pytest

CODE = """
import sys
import ode_sim._core
if {other}:
    ode_sim._core.layout = "of other headers"
from gazebo_ros import compiled
from plugin_loader import PluginError
try:
    compiled.bridge(None, False)
except PluginError as error:
    print(error)
except AttributeError:  # it has gone on to look at the server
    print("goes on")
"""


@pytest.mark.parametrize(
    "other, told",
    [
        (False, "goes on"),
        (True, "gazebo_cpp was not built with this ode_sim and would read its world wrongly; build both: catkin build ode_sim gazebo_cpp"),
    ],
)
def test_compiled_plugins_are_refused_in_one_line(other, told):
    pytest.importorskip("gazebo_cpp._core")
    done = subprocess.run([sys.executable, "-c", CODE.format(other=other)], capture_output=True, text=True, timeout=60)
    assert done.stdout == told + "\n", done.stderr
