"""What the window shows, on Qt's platform without a display."""

import os
import subprocess
import sys

import pytest

os.environ["QT_QPA_PLATFORM"] = "offscreen"
from python_qt_binding.QtWidgets import QApplication  # noqa: E402
from turtlesim.pictures import TURTLES, draw_all  # noqa: E402
from turtlesim.window import TurtleWindow  # noqa: E402
from turtlesim.world import METRE, SIZE, Line, Pen, World  # noqa: E402

BLUE = (69, 86, 255)


@pytest.fixture(scope="module", autouse=True)
def application():
    yield QApplication.instance() or QApplication([])


@pytest.fixture
def window():
    window = TurtleWindow(World())
    window.clear(*BLUE)
    yield window
    window.close()


def test_fourteen_different_turtles():
    pictures = draw_all()
    assert len(pictures) == len({looks.name for looks in TURTLES}) == 14
    assert {(image.width(), image.height()) for image in pictures} == {(METRE, METRE)}
    assert len({bytes(image.constBits().asarray(image.sizeInBytes())) for image in pictures}) == 14


def test_lines_stay_on_the_paper(window):
    window.draw([Line((1, 1), (5, 1), Pen((255, 0, 0), 3)), Line((-1e30, 9), (1e30, 9), Pen((0, 255, 0), 1))])
    assert window.color_at((3, 1)) == (255, 0, 0)
    assert window.color_at((3, 2)) == BLUE
    assert window.color_at((3, 9)) == (0, 255, 0)
    assert window.color_at((0, 0)) == window.color_at((SIZE, SIZE)) == BLUE
    window.clear(256 + 150, 0, 1)
    assert window.color_at((3, 1)) == (150, 0, 1)


def test_a_turtle_looks_where_it_goes(window):
    """The head of a turtle that faces right is right of its middle; no colour of the paper shows there."""
    turtle = window._world.spawn("", 5, 5, 0.0)
    paper = window.grab().toImage().pixelColor(5 * METRE + 19, round((SIZE - 5) * METRE)).getRgb()[:3]
    assert paper != BLUE
    turtle.theta = 1.570796
    image = window.grab().toImage()
    assert image.pixelColor(5 * METRE, round((SIZE - 5) * METRE) - 19).getRgb()[:3] != BLUE
    assert image.pixelColor(5 * METRE + 21, round((SIZE - 5) * METRE)).getRgb()[:3] == BLUE


@pytest.mark.parametrize("display, said", [(None, "DISPLAY is not set"), (":997", "the display :997 (DISPLAY) cannot be opened")])
def test_without_a_display_one_line_says_what_to_do(display, said):
    environment = {k: v for k, v in os.environ.items() if k not in ("QT_QPA_PLATFORM", "DISPLAY", "WAYLAND_DISPLAY")}
    ended = subprocess.run(
        [sys.executable, "-c", "import sys; from turtlesim.node import main; sys.exit(main())"],
        env=dict(environment, **({"DISPLAY": display} if display else {})),
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1
    assert said in ended.stderr and "QT_QPA_PLATFORM=offscreen" in ended.stderr
