"""RViz's markers in a page without a browser: every type, changed and taken away; those that nobody can draw."""

import types

import numpy as np
import pytest
import rospy
from geometry_msgs.msg import Point, Quaternion, Vector3
from ode_sim import World
from ode_sim.description import model as d
from ode_sim.math3 import Pose
from ode_sim_viewer import LocalSimulation, Page
from ode_sim_viewer.shapes import shape_model
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

pytest.importorskip("viser")

from gzclient.markers import Markers, Unfit  # noqa: E402
from gzclient.panels import markers as panel_module  # noqa: E402

NAN = float("nan")


def marker(kind=Marker.CUBE, number=0, points=(), **fields):
    usual = {"scale": Vector3(1.0, 2.0, 3.0), "color": ColorRGBA(1.0, 0.0, 0.0, 1.0)}
    made = Marker(type=kind, id=number, ns="test", points=[Point(*point) for point in points], **{**usual, **fields})
    made.header.frame_id = "world"
    return made


LINE = ((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (1.0, 1.0, 0.0))


@pytest.fixture
def page():
    page = Page(
        LocalSimulation(World(d.World(models=(shape_model("box", d.Box()),))), paused=True), port=0, panels=(panel_module.MarkersPanel,)
    )
    while page.frame is None:
        page.turn()
    yield page
    page.close()


@pytest.fixture
def drawn(page):
    return Markers(page.server.scene, "/mk")


def nodes(page, root="/mk"):
    return sorted(name for name in page.server.scene._handle_from_node_name if name.startswith(root))


@pytest.mark.parametrize("kind", range(12))
def test_every_type_is_drawn_and_deleted(page, drawn, kind, tmp_path):
    made = marker(kind, points=LINE if kind not in (0, 1, 2, 3, 9, 10) else (), text="a <b>label</b>")
    if kind == Marker.MESH_RESOURCE:
        made.mesh_resource = "package://p/a.stl"
        (tmp_path / "a.stl").write_text(
            "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n"
        )
        drawn = Markers(page.server.scene, "/mk", lambda uri: str(tmp_path / "a.stl"))
    drawn.take(made, 0.0)
    assert nodes(page)[:2] == ["/mk_f0", "/mk_f0/1"]
    drawn.take(marker(kind, action=Marker.DELETE), 0.0)
    assert nodes(page) == ["/mk_f0"] and not len(drawn)


def test_sizes_are_diameters_and_lines_join_points(page, drawn):
    def node(kind, points=()):
        drawn.take(marker(3, action=3), 0.0)
        drawn.take(marker(kind, points=points), 0.0)
        return next(iter(drawn._kept.values())).node

    assert node(Marker.SPHERE).scale == (0.5, 1.0, 1.5) and node(Marker.CYLINDER).scale == (0.5, 1.0, 3.0)
    assert node(Marker.CUBE).scale == (1.0, 2.0, 3.0)
    np.testing.assert_allclose(node(Marker.LINE_STRIP, LINE).points, [LINE[:2], LINE[1:]])
    assert node(Marker.LINE_LIST, LINE).points.shape == (1, 2, 3)  # the odd one is left over
    np.testing.assert_allclose(node(Marker.ARROW).points, [[(0, 0, 0), (1, 0, 0)]])
    np.testing.assert_allclose(node(Marker.ARROW, LINE[:2]).points, [LINE[:2]])
    np.testing.assert_allclose(node(Marker.SPHERE_LIST, LINE).batched_scales, [(0.5, 1.0, 1.5)] * 3)


def test_what_only_moves_is_not_drawn_anew(page, drawn):
    made = marker()
    drawn.take(made, 0.0)
    node = next(iter(drawn._kept.values())).node
    made.pose.position.x, made.pose.orientation = 4.0, Quaternion(0.0, 0.0, 2.0, 0.0)
    drawn.take(made, 0.0)
    assert next(iter(drawn._kept.values())).node is node
    assert tuple(node.position) == (4.0, 0.0, 0.0) and tuple(node.wxyz) == (0.0, 0.0, 0.0, 1.0)
    made.color.g = 1.0
    drawn.take(made, 0.0)
    assert next(iter(drawn._kept.values())).node is not node and len(nodes(page)) == 2


def test_frames_carry_their_markers_and_lifetimes_end(page, drawn):
    made = marker(lifetime=rospy.Duration(2.0))
    made.header.frame_id = "/hand"
    drawn.take(made, 10.0)
    assert drawn.place({}, 10.0) == ["hand"] and not drawn._frames["hand"].visible
    assert drawn.place({"hand": Pose((1.0, 2.0, 3.0))}, 11.0) == []
    assert drawn._frames["hand"].visible and tuple(drawn._frames["hand"].position) == (1.0, 2.0, 3.0)
    drawn.place({}, 12.0)
    assert not len(drawn)


@pytest.mark.parametrize(
    "wrong, said",
    [
        (marker(99), "no type 99"),
        (marker(action=7), "no action 7"),
        (marker(Marker.LINE_STRIP), "0 points"),
        (marker(points=((NAN, 0.0, 0.0),)), "nan"),
        (marker(scale=Vector3(NAN, 1.0, 1.0)), "nan"),
        (marker(Marker.POINTS, points=LINE, colors=[ColorRGBA()]), "1 colours for 3"),
        (marker(Marker.MESH_RESOURCE, mesh_resource="file:///etc/passwd"), "package://"),
        (marker(Marker.MESH_RESOURCE, mesh_resource="package://nobody/x.stl"), "no mesh"),
    ],
)
def test_what_cannot_be_drawn_says_why_and_leaves_nothing(page, drawn, wrong, said):
    drawn.take(marker(), 0.0)
    with pytest.raises(Unfit, match=said):
        drawn.take(wrong, 0.0)
    assert nodes(page) in (["/mk_f0"], ["/mk_f0", "/mk_f0/1"])


def test_a_file_outside_is_never_asked_for(page):
    asked = []
    drawn = Markers(page.server.scene, "/mk", lambda uri: asked.append(uri))
    for uri in ("file:///etc/passwd", "/etc/passwd", "http://evil/x", "../../x"):
        with pytest.raises(Unfit):
            drawn.take(marker(Marker.MESH_RESOURCE, mesh_resource=uri), 0.0)
    assert not asked


def test_the_tab_shows_topics_that_are_chosen(page, monkeypatch):
    subscribed = {}
    ended = []
    monkeypatch.setattr(
        rospy,
        "Subscriber",
        lambda topic, cls, take, **_: subscribed.update({topic: take}) or (types.SimpleNamespace(unregister=lambda: ended.append(topic))),
    )
    panel = page.panels[-1]
    panel.list({"/many": MarkerArray, "/<b>one": Marker})
    client = types.SimpleNamespace(add_notification=lambda *_, **__: None)

    def check(name, on):
        box = panel._boxes[name]
        box._impl.value = on
        for callback in list(box._impl.update_cb):
            callback(types.SimpleNamespace(client=client, client_id=1, target=box))
        page._do_jobs()

    check("/many", True)
    assert {"/many", "/tf", "/tf_static"} == set(subscribed)
    on_link, lost = marker(number=1), marker(number=2)
    on_link.header.frame_id, lost.header.frame_id = "link", "nowhere"
    subscribed["/many"](MarkerArray([on_link, lost]))
    panel.on_move(page.frame)
    assert len(nodes(page, "/markers1_f")) == 4 and "'nowhere'" in panel._note.content.replace("&#x27;", "'")
    subscribed["/many"](MarkerArray([marker(number=2, action=Marker.DELETE), marker(44, number=3)]))
    panel.on_move(page.frame)
    assert "no type 44" in panel._note.content
    check("/many", False)
    assert not nodes(page, "/markers1") and set(ended) == {"/many", "/tf", "/tf_static"}
