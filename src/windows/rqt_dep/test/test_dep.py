"""Packages and their dependencies."""

import pytest
from rqt_dep.packages import BOTH, DEPENDS, DEPENDS_ON, Options, generate_dot, read_packages, select
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until

PACKAGES = {"app": {"lib", "base", "boost"}, "lib": {"base"}, "base": set(), "other": {"lib"}, "loop_a": {"loop_b"}, "loop_b": {"loop_a"}}


@pytest.mark.parametrize(
    "options, shown",
    [
        (Options("app"), {"app", "lib", "base"}),
        (Options("app", depth=1), {"app", "lib", "base"}),
        (Options("other", depth=1), {"other", "lib"}),
        (Options("lib", DEPENDS_ON), {"lib", "app", "other"}),
        (Options("lib", BOTH), {"lib", "base", "app", "other"}),
        (Options("app,-lib"), {"app", "lib", "base"}),
        (Options("loop_a", depth=0), {"loop_a", "loop_b"}),
        (Options(""), set()),
        (Options("("), set()),
        (Options("app", system=True), {"app", "lib", "base", "boost"}),
        (Options("/"), set(PACKAGES)),
    ],
)
def test_what_is_shown(options, shown):
    assert select(PACKAGES, options)[0] == shown


def test_edges_that_a_longer_way_replaces():
    assert select(PACKAGES, Options("app"))[1] == {("app", "lib"), ("lib", "base")}
    assert select(PACKAGES, Options("app", hide_transitive=False))[1] == {("app", "lib"), ("lib", "base"), ("app", "base")}
    assert select(PACKAGES, Options("loop_a"))[1] == {("loop_a", "loop_b"), ("loop_b", "loop_a")}


def test_text():
    dot = generate_dot(PACKAGES, Options("app", DEPENDS, system=True))
    assert '"app" [label="app" shape=box color=red];' in dot and '"boost" [label="boost" shape=box color=gray];' in dot


def test_this_workspace_in_the_window():
    rospy_without_master()
    assert "rqt_graph" in read_packages()["rqt_dep"]
    with open_plugin("rqt_dep") as gui:
        names = lambda: {item.text() for item in gui.plugin.pane.nodes.values()}  # noqa: E731
        wait_until(lambda: names() == {"Type the name of a package above"})
        find(gui, "filter_line_edit").setText("rqt_dep")
        wait_until(lambda: {"rqt_dep", "rqt_graph", "qt_dotgraph"} <= names())
    assert errors == []
