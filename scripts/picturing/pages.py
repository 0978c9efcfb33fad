"""Pictures of the simulator's window, by clicks in a browser, and README's film."""

from __future__ import annotations

import contextlib
import io
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from .common import PICK, ROOT, Options, Trouble, launched, master, running, save

from browser import Browser, missing, wait  # isort: skip  # beside gzclient's tests, where common looks

SIZE = (1280, 900)  # of the browser's window, bars included
WIDTH = 1000  # pixels of a picture
FIELD = 0.9  # rad, of the page's eye
HOUSE = "aws-robomaker-small-house-world"
# of mbot_gazebo's room.world, between the middles of its walls
CORNERS = ((-2.75, -2.45), (5.6, -2.45), (5.6, 2.4), (-0.75, 2.4), (-0.75, 0.05), (-5.6, 0.05), (-5.6, -1.8), (-5.6, -2.4))
ROOM = ("roslaunch", "mbot_gazebo", "view_mbot_gazebo_room.launch", "gui:=false")


@contextlib.contextmanager
def window(*command: str, models: str = "") -> Iterator[Any]:
    """The simulator's window over what is launched, in a home folder of its own.

    :param models: a folder of models for it
    """
    with master() as found, tempfile.TemporaryDirectory() as home, contextlib.ExitStack() as stack:
        environment = {name: value for name, value in found.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        environment.update(HOME=home, GAZEBO_MODEL_PATH=models)
        stack.enter_context(running(environment, *command, stdout=subprocess.DEVNULL))
        client = stack.enter_context(running(environment, "gzclient", "--port", "0", "--shadows", stdout=subprocess.PIPE))
        assert client.stdout is not None
        page = stack.enter_context(Browser(client.stdout.readline().split()[-1], size=SIZE, frames=0))
        page.see("real-time factor", seconds=180.0)
        yield page


def gzclient(page: Any) -> None:
    """The mobile robot's room; its robot is picked."""
    page.click("mbot")
    page.see("Position (m)")


def gzclient_building(page: Any) -> None:
    """The same room, drawn in the building editor."""
    page.click("Building")
    page.check("Edit a building")
    at_rest(page)
    page.unfold("Snap")
    page.fill("Length (m)", 0.05)

    def at(x: float, y: float, z: float = 0.0) -> Any:  # seen from above, as the editor looks
        return page.pixel((x, y, z), (0.0, -0.01, 13.0), (0.0, 0.0, 0.0), FIELD)

    page.mouse(at(*CORNERS[0]), at(*CORNERS[1]), drag=True)
    page.see("1 wall on 1 level")
    for corner in (*CORNERS[1:], CORNERS[0]):
        page.mouse(at(*corner))
    page.see("8 walls on 1 level")
    page.choose("Tool", "Door")
    page.mouse(at(0.0, -2.45, 2.5))
    page.see("Picked: door")
    page.choose("Tool", "Window")
    page.mouse(at(2.5, 2.4, 2.5))
    page.see("Picked: window")


def gzclient_house(page: Any) -> None:
    """A house of others from above, unmodified: needs --house, a copy of aws-robotics/aws-robomaker-small-house-world."""
    page.see("more: search", seconds=180.0)
    page.click("Scene")
    page.click("Show all")
    at_rest(page)
    page.click("Top")


#: name -> what is launched, what is clicked
PAGES: dict[str, tuple[tuple[str, ...], Callable[[Any], None]]] = {
    "gzclient": (ROOM, gzclient),
    "gzclient_building": (ROOM, gzclient_building),
    "gzclient_house": (("rosrun", "gazebo_ros", "gzserver", "worlds/small_house.world"), gzclient_house),
}


def shot(page: Any) -> Any:
    """The page as it is, an image of PIL."""
    from PIL import Image

    return Image.open(io.BytesIO(page.driver.get_screenshot_as_png())).convert("RGB")


def at_rest(page: Any) -> Any:
    """The page once only the times below it change."""
    foot = 60

    def still() -> Any:
        first = shot(page)
        page.driver.execute_async_script("setTimeout(arguments[0], 1000)")
        last = shot(page)
        above = (0, 0, last.width, last.height - foot)
        return last if first.crop(above).tobytes() == last.crop(above).tobytes() else None

    return wait(still, "a page on which nothing moves any more", 120.0)


def make(name: str, options: Options) -> Path:
    """:raises Trouble: it cannot be made here. :raises AssertionError: something did not appear."""
    if missing():
        raise Trouble(f"not installed: {missing()}")
    command, act = PAGES[name]
    models = ""
    if act is gzclient_house:
        house = options.house
        if house is None or not (house / command[-1]).is_file():
            raise Trouble(f"{name} shows a world of others: give its folder with --house (git clone .../aws-robotics/{HOUSE})")
        command, models = (*command[:-1], str(house / command[-1])), str(house / "models")
    with window(*command, models=models) as page:
        act(page)
        picture = at_rest(page)
    file = options.out / f"{name}.jpg"
    save(picture, file, WIDTH)
    return file


def film(name: str, options: Options) -> Path:
    """A film: a UR5 with a gripper plans round a post, picks a block and puts it down behind it."""
    file = options.out / f"{name}.webp"
    with launched(PICK) as environment:
        done = subprocess.run([sys.executable, str(ROOT / "scripts" / "film.py"), str(file)], env=environment, stdout=subprocess.DEVNULL)
    if done.returncode:
        raise Trouble("what film.py said is above")
    return file
