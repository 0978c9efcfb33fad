"""What is inserted hangs at the pointer until a click puts it down; a page without a browser."""

import asyncio
import time
import types

import numpy as np
import pytest
from ode_sim.description import model as d
from ode_sim.description.sdf_writer import model_text

pytest.importorskip("viser")

from ode_sim_viewer.pointer import on_plane, ray_of  # noqa: E402
from ode_sim_viewer.shapes import shape_model  # noqa: E402
from viewer_page import Client, page, panel, position, use, wait  # noqa: E402, F401

FROM_ABOVE = types.SimpleNamespace(position=(0.0, 0.0, 10.0), wxyz=(0.0, 1.0, 0.0, 0.0), fov=1.0, aspect=2.0)


class Hand(Client):
    """A page that looks down from 10 m, with a pointer; ``told`` is what its script has noted."""

    def __init__(self, client_id=1):
        super().__init__(client_id)
        self.camera, self.told, self.scripts, self.kept = FROM_ABOVE, [], [], {}
        self.local_storage = self
        self._websock_connection = types.SimpleNamespace(queue_message=self.scripts.append)
        self._viser_server = types.SimpleNamespace(_connected_clients={client_id: self})

    def set_item(self, key, value):
        self.kept[key] = value

    def get_item(self, key, timeout):
        if self._viser_server._connected_clients:
            return self.kept.get(key)
        raise RuntimeError("the client disconnected")

    def remove_item(self, key):
        self.kept.pop(key, None)

    def points_at(self, text):
        for key in self.kept:
            self.kept[key] = text


def click(page, client, x, y, modifier=None):
    event = types.SimpleNamespace(client=client, client_id=client.client_id, ray_origin=(x, y, 10.0), ray_direction=(0.0, 0.0, -1.0))
    for entry in list(page.server.scene._scene_pointer_cb):
        if entry.modifier == modifier:
            asyncio.run(entry.callback(event))


def ghosts(page):
    return sorted(name for name in page.server.scene._handle_from_node_name if name.startswith("/ghost"))


def ghost_at(page):
    return page.server.scene._handle_from_node_name["/ghost"].position


def seen(page, condition):
    for _ in range(500):
        page.turn()
        if condition():
            return
        time.sleep(0.02)
    raise AssertionError("it did not come about")


def test_a_pixel_is_a_ray():
    assert on_plane(ray_of(FROM_ABOVE, 0.5, 0.5)) == pytest.approx((0.0, 0.0))
    assert on_plane(ray_of(FROM_ABOVE, 1.0, 0.5)) == pytest.approx((20.0 * np.tan(0.5), 0.0))
    assert on_plane(ray_of(FROM_ABOVE, 0.5, 1.0)) == pytest.approx((0.0, -10.0 * np.tan(0.5)))
    assert on_plane(((0.0, 0.0, 1.0), (1.0, 0.0, 0.0))) is None and on_plane(((0.0, 0.0, 1.0), (0.0, 0.0, 1.0))) is None


def test_a_box_hangs_at_the_pointer_until_a_click(page):
    hand, insert = Hand(), panel(page, "InsertPanel")
    use(insert._shapes, hand, "Box")
    seen(page, lambda: hand.scripts)
    assert next(iter(hand.kept)) in hand.scripts[0].source
    hand.points_at("0.5 0.5")
    seen(page, lambda: len(ghosts(page)) == 3 and np.allclose(ghost_at(page), (0.0, 0.0, 0.5)))
    hand.points_at("1.0 0.5")
    seen(page, lambda: np.allclose(ghost_at(page), (20.0 * np.tan(0.5), 0.0, 0.5)))
    assert "unit_box at 10.93, 0.00 m" in insert._state.content and page.world.model("unit_box") is None
    click(page, Client(2), 5.0, 5.0)  # another page's
    page.turn()
    assert page.world.model("unit_box") is None and ghosts(page)
    click(page, hand, 2.0, 1.0)
    wait(page, lambda: page.world.model("unit_box") is not None)
    assert position(page, "unit_box") == pytest.approx((2.0, 1.0, 0.5))
    assert not ghosts(page) and not page.server.scene._scene_pointer_cb
    page._picked("box", "link", types.SimpleNamespace(client=hand, client_id=1))  # what the click also fell on
    page.turn()
    assert page.selection.model == ""


def test_ctrl_snaps_and_escape_leaves(page):
    hand, insert = Hand(), panel(page, "InsertPanel")
    use(insert._lights, hand, "Point")
    seen(page, lambda: page.server.scene._scene_pointer_cb)
    click(page, hand, 2.3, -0.6, "cmd/ctrl")
    wait(page, lambda: any(light.name == "user_point_light" for light in page.world.lights))
    assert next(light for light in page.world.lights if light.type == "point").pose.p == (2.0, -1.0, 1.0)
    for end in (lambda: hand.points_at("escape"), hand._viser_server._connected_clients.clear):
        use(insert._shapes, hand, "Sphere")
        seen(page, lambda: hand.kept)
        end()
        seen(page, lambda: not page.server.scene._scene_pointer_cb)
        assert not ghosts(page) and not insert._state.content.count("Sphere")


def test_the_models_of_the_path_are_rows_that_a_search_narrows(page, tmp_path, monkeypatch):
    file = tmp_path / "model.sdf"
    file.write_text(model_text(shape_model("crate", d.Box())))
    paths = {f"chair_{number:02}": str(tmp_path / "gone.sdf") for number in range(60)} | {"crate": str(file)}
    monkeypatch.setattr(page.simulation, "model_names", lambda: paths)
    hand, insert = Hand(), panel(page, "InsertPanel")
    insert.on_models()
    seen(page, lambda: list(insert._rows) == [f"chair_{number:02}" for number in range(40)])
    assert "21 more" in insert._rest.content
    use(insert._search, hand, "cra")
    seen(page, lambda: list(insert._rows) == ["crate"])
    assert not insert._rest.visible
    use(insert._by_hand, hand, False)
    use(insert._rows["crate"], hand)
    wait(page, lambda: page.world.model("crate") is not None)
    use(insert._search, hand, "chair_07")
    seen(page, lambda: list(insert._rows) == ["chair_07"])
    use(insert._rows["chair_07"], hand)
    assert "gone.sdf" in hand.told[-1]
