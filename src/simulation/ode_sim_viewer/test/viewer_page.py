"""A page without a browser, and what a browser would send to it."""

import time
import types

import pytest
from ode_sim import World
from ode_sim.description import model as d
from ode_sim.math3 import Pose
from ode_sim_viewer import LocalSimulation, Page
from ode_sim_viewer.shapes import shape_model

EVIL = "<img src=x onerror=alert(1)>"


class Client:
    """A page that clicks."""

    def __init__(self, client_id=1):
        self.client_id = client_id
        self.camera = types.SimpleNamespace(aspect=1.6)
        self.told = []
        self.files = {}

    def add_notification(self, title, body, **_):
        self.told.append(body)

    def send_file_download(self, name, content, save_immediately=False):
        self.files[name] = content


def event(client, value=None):
    return types.SimpleNamespace(client=client, client_id=client.client_id, target=types.SimpleNamespace(value=value))


def use(handle, client, value=None):
    """What viser does when a page clicks or changes something."""
    if value is not None:
        handle._impl.value = value
    for callback in list(handle._impl.update_cb):
        callback(types.SimpleNamespace(client=client, client_id=client.client_id, target=handle))


@pytest.fixture
def page():
    """A box at the origin and a ball with markup in its name, paused."""
    world = World(d.World(lights=(d.Light("sun", "directional"),), models=(shape_model("box", d.Box()), shape_model(EVIL, d.Sphere(0.5)))))
    world.models[EVIL].pose = Pose((3.0, 0.0, 0.5))
    page = Page(LocalSimulation(world, paused=True), port=0)
    wait(page, lambda: page.frame is not None)
    yield page
    page.close()


def wait(page, condition, turns=500):
    for _ in range(turns):
        page.turn()
        if page.frame is not None and page.frame.revision == page.world.revision and condition():
            return
        time.sleep(0.02)
    raise AssertionError("it did not come about")


def panel(page, kind):
    return next(p for p in page.panels if type(p).__name__ == kind)


def position(page, model):
    return page.world.model(model).pose(page.frame).p
