"""What the menu *View* asks for and is told. viser calls back from several threads at once."""

import json
import re
import threading

import ode_sim_viewer.panels.view as view
from viewer_page import Client, page, panel, use  # noqa: F401

PATIENCE = 1.0  # s that the first thread lingers, longer than the second needs


def told(scene, name="switches"):
    return re.search(f"<b id='{name}'>(.*?)</b>", scene._told.content, re.DOTALL)[1].split("\n")


def side_by_side(first, second, lingers):
    """``first`` in a thread until it ``lingers`` (an event), then ``second`` to its end, then the rest of ``first``."""
    threads = [threading.Thread(target=first), threading.Thread(target=second)]
    threads[0].start()
    assert lingers.wait(10.0)
    threads[1].start()
    for thread in threads:
        thread.join(10.0)


def test_what_is_told_last_is_what_is_so(page, monkeypatch):  # noqa: F811
    """The first thread has looked, and tells when the second has been."""
    scene, lingers, gone_on = panel(page, "ViewPanel"), threading.Event(), threading.Event()
    usual = view.escaped

    def slow(label):
        if threading.current_thread().name == "first" and not lingers.is_set():
            lingers.set()
            gone_on.wait(PATIENCE)
        return usual(label)

    monkeypatch.setattr(view, "escaped", slow)

    def first():
        threading.current_thread().name = "first"
        use(scene._asked, Client(), json.dumps(["a 1", {"Labels": True}]))

    def second():
        use(scene._asked, Client(), json.dumps(["a 2", {"Labels": True, "Joints": True}]))
        gone_on.set()

    side_by_side(first, second, lingers)
    assert {"Labels", "Joints"} <= set(told(scene))


def test_what_is_asked_last_is_what_is_done(page, monkeypatch):  # noqa: F811
    """The first thread has read what is asked, and does it when the second has been."""
    scene, lingers, gone_on = panel(page, "ViewPanel"), threading.Event(), threading.Event()
    usual = json.loads

    def slow(text):
        read = usual(text)
        if threading.current_thread().name == "first" and not lingers.is_set():
            lingers.set()
            gone_on.wait(PATIENCE)
        return read

    monkeypatch.setattr(view.json, "loads", slow)

    def first():
        threading.current_thread().name = "first"
        use(scene._asked, Client(), json.dumps(["a 1", {"Wireframe": True}]))

    def second():
        use(scene._asked, Client(), json.dumps(["a 2", {"Wireframe": False}]))
        gone_on.set()

    side_by_side(first, second, lingers)
    assert "Wireframe" not in told(scene)


def test_who_asks_is_told_that_it_was_heard(page):  # noqa: F811
    """Also where nothing changes by it: two pages may ask for the same."""
    scene = panel(page, "ViewPanel")
    page.server.get_clients = lambda: {1: None, 2: None}
    use(scene._asked, Client(1), json.dumps(["a 1", {"Labels": True}]))
    use(scene._asked, Client(2), json.dumps(["b 1", {"Labels": True}]))
    assert told(scene, "heard") == ["a 1", "b 1"] and "Labels" in told(scene)
    page.server.get_clients = lambda: {2: None}  # the first has been closed
    use(scene._asked, Client(2), json.dumps(["b 2", {"Labels": False}]))
    assert told(scene, "heard") == ["b 2"] and "Labels" not in told(scene)
    use(scene._asked, Client(2), "not JSON")
    assert told(scene, "heard") == ["b 2"]
