"""What makes the page come soon: it prepares no light that is not shown, and the world does not wait for every tab."""

import html
import re

import numpy as np
import pytest
from ode_sim import World
from ode_sim.description import model as d

pytest.importorskip("viser")
zstandard = pytest.importorskip("zstandard")

from ode_sim_viewer import LocalSimulation, Page  # noqa: E402
from ode_sim_viewer.panels.base import Panel  # noqa: E402
from ode_sim_viewer.porter import entitled, page_of_viser  # noqa: E402
from ode_sim_viewer.website import Website  # noqa: E402

DIGITS = "!#$%()*+,-./0123456789:;=?@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_abcdefghijklmnopqrstuvwxyz{|}~"


def program(page):
    """What viser's page unpacks: five digits to the base of 88 are four bytes, all of them are packed by zstd."""
    packed = html.unescape(re.search('data-p="([^"]*)"', page).group(1))
    digits = np.frombuffer(packed.encode(), np.uint8)
    values = np.zeros(128, np.uint64)
    values[[ord(digit) for digit in DIGITS]] = range(len(DIGITS))
    digits, rest = digits[: len(digits) // 5 * 5], digits[len(digits) // 5 * 5 :]
    words = values[digits].reshape(-1, 5) @ np.array([88**n for n in (4, 3, 2, 1, 0)], np.uint64)
    last = sum(int(values[digit]) * 88**n for n, digit in enumerate(reversed(rest)))
    return zstandard.decompress(words.astype(">u4").tobytes() + last.to_bytes(max(len(rest) - 1, 0), "big")).decode()


def changed():
    """The program of this viser before and after what the page does to it."""
    page = page_of_viser("Gazebo").decode()
    changes = re.search(r'decode\(heap\.subarray\(up\+ss,up\+sz\)\)((?:\.replace\(/.*?/,"[^"]*"\))+);', page).group(1)
    before = after = program(page)
    for pattern, by in re.findall(r'\.replace\(/(.*?)/,"([^"]*)"\)', changes):
        pattern = pattern.replace("[^]", r"[\s\S]")  # as it is said in Python
        assert len(re.findall(pattern, after)) == 1, pattern
        after = re.sub(pattern, re.sub(r"\$(\d)", r"\\\1", by), after)
    return before, after


@pytest.mark.slow
def test_the_light_by_a_picture_is_taken_out_of_the_program_of_this_viser():
    assert re.search(r"=null\?null:\w+\.hdri_data;if\(", changed()[1])


@pytest.mark.slow
def test_who_draws_is_asked_later_and_of_the_canvas_that_is_there():
    before, after = changed()
    later = re.search(r"setTimeout\(\(\)=>\{let (\w+)=([\w$]+)\(\);console\.log\(`WebGL support.*?\},5e3\)\},\[\]\),null\}", after)
    assert later and later.group(2) + "()" in before
    asks = re.search(r"function " + re.escape(later.group(2)) + r"\(\)\{let \w+=(.*?),", after).group(1)
    assert asks.startswith("document.querySelector('canvas[data-engine]')")
    assert "`data-engine`" in before  # three.js marks its canvas so


@pytest.mark.slow
def test_a_button_does_not_take_the_place_of_a_value_that_waits_to_be_sent():
    before, after = changed()
    sender = re.search(r"let n=!0,r=!1,i=null,a=null;function o\(s\)\{.*?return\{send:o,flush:s,cancel:c\}\}", after).group()
    assert (
        "(r&&i&&(i.type!==s.type||i.uuid!==s.uuid||i.name!==s.name||i!==s&&JSON.stringify(i)===JSON.stringify(s))&&"
        "(c.sendMessage(i),r=!1),i=s,n?(c.sendMessage(s),r=!1,n=!1," in sender
    )
    assert "(i=s,n?(c.sendMessage(s),r=!1,n=!1," in before


@pytest.mark.slow
def test_a_handle_that_is_drawn_through_a_body_is_hit_before_it():
    before, after = changed()
    order = re.search(
        r"\.sort\(\((\w+),(\w+)\)=>\{let grip=(o=>.*?),first=grip\(\2\.object\)-grip\(\1\.object\);"
        r"if\(first\)return first;",
        after,
    )
    assert before.count("raycaster.intersectObject(") == 1 and after.index("raycaster.intersectObject(") < order.start()
    # the parts of a handle that are hit are not drawn, or drawn through everything, in a group that stands where it is put
    assert re.search(r"matrixAutoUpdate:!1,.{1,800}?createElement\(`mesh`,\{visible:!1,position:\[0,", before, re.DOTALL)
    assert re.search(r"lineWidth:\w+\*4,visible:!1,", before)
    assert "!o.visible&&o.parent?.matrixAutoUpdate===!1" in order.group(3)


@pytest.mark.slow
def test_the_field_of_a_colour_takes_nothing_back_that_was_typed():
    before, after = changed()
    field = re.search(r"fixOnBlur:!1,onBlur:\(\)=>\{let (\w)=c\(d\);\1\?l\(\1,t\)\|\|u\(e,\1\):f\(s\(t\)\)\}", after)
    assert field and "fixOnBlur:!1" not in before and "fixOnBlur:!0" in before  # of the library below, which takes back


def test_another_page_is_left_as_it_is_but_for_its_title():
    assert entitled(b"<html>x</html>", "t") == b"<html>x</html>"


def test_panels_that_come_later_know_the_world_that_is_shown():
    told = []

    class Notes(Panel):
        title = "Notes"

        def on_world(self, world):
            told.append([model.name for model in world.models])

    page = Page(
        LocalSimulation(World(d.World(models=(d.Model(name="box", links=(d.Link("l"),)),))), paused=True), port=0, later=lambda: (Notes,)
    )
    try:
        assert not any(isinstance(p, Notes) for p in page.panels)
        page.turn()
        assert isinstance(page.panels[-1], Notes) and told == [["box"]]
        page.turn()
        assert sum(isinstance(p, Notes) for p in page.panels) == 1
    finally:
        page.close()


def test_more_tabs_wait_until_a_browser_that_is_expected_has_shown_the_world(monkeypatch):
    class Notes(Panel):
        title = "Notes"

    page = Page(LocalSimulation(World(d.World()), paused=True), website=Website(0), later=lambda: (Notes,))
    try:
        for look in (60.0, 0.0):
            page.turn()
            page.turn()
            assert not isinstance(page.panels[-1], Notes)
            monkeypatch.setattr("ode_sim_viewer.page.FIRST_LOOK", look)
            page._on_connect(None)
        page.turn()
        assert isinstance(page.panels[-1], Notes)
    finally:
        page.close()


def test_what_a_world_lacks_is_said():
    from ode_sim import World
    from ode_sim_viewer import LocalSimulation, Page

    world = World.load("<sdf version='1.6'><world name='w'><include><uri>model://nowhere</uri></include></world></sdf>")
    said = []
    with Page(LocalSimulation(world, paused=True), port=0, say=said.append):
        assert any("model://nowhere" in line for line in said), said
