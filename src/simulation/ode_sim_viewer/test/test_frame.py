"""What stands round the page, in a real browser: the tools, the keys, the state, what is shown while it loads, at three sizes."""

import pathlib
import sys
import threading

import numpy as np
import pytest
from ode_sim import World

pytest.importorskip("viser")
sys.path.append(str(pathlib.Path(__file__).parents[3] / "windows" / "gzclient" / "test"))
from browser import Browser, missing, pixels, wait  # noqa: E402
from ode_sim_viewer import LocalSimulation, Page  # noqa: E402

pytestmark = [pytest.mark.slow, pytest.mark.skipif(bool(missing()), reason=f"not installed: {missing()}")]

BALL = """<sdf version="1.6"><model name="ball"><pose>0 0 1 0 0 0</pose><link name="link"><gravity>false</gravity>
<inertial><mass>1</mass></inertial><collision name="c"><geometry><sphere><radius>0.3</radius></sphere></geometry></collision>
<visual name="v"><geometry><sphere><radius>0.3</radius></sphere></geometry></visual></link></model></sdf>"""
ENTRIES, ENTRY = ".menu:not([hidden]) button", "[e.innerText, e.getAttribute('aria-checked')]"
SIZES = ((1400, 900), (900, 700), (500, 800))  # the last one: a phone's width, the least that Chromium's window has
UPPER = ".mantine-Tabs-root:has(~ .mantine-Tabs-root)"  # CSS: the tree with its tabs, the lists with theirs
TREE, LIST = f"#root {UPPER}", "#root .mantine-Tabs-root ~ .mantine-Tabs-root"
CHOOSE = """const title = [...document.querySelectorAll("#menus button")].find(e => e.textContent === arguments[0]); title.click();
[...document.querySelectorAll(".menu:not([hidden]) button")].find(e => e.firstElementChild.textContent === arguments[1]).click();"""
WATCH = """window.__seen = new Set();
setInterval(() => { for (const word of ["Dev Settings", "Save Canvas", "WorldAxes", "Software WebGL"]) {
  const splash = document.getElementById("splash");
  if (!splash && document.body && document.body.innerText.includes(word)) window.__seen.add(word);
} }, 20);"""


@pytest.fixture(scope="module")
def world():
    world = World()
    world.spawn_sdf(BALL)
    with Page(LocalSimulation(world), port=0) as page:
        thread = threading.Thread(target=page.run, daemon=True)
        thread.start()
        yield world, page
    thread.join()


@pytest.fixture(scope="module", params=SIZES, ids=lambda size: f"{size[0]}x{size[1]}")
def window(request, world):
    with Browser(world[1].address, size=request.param) as browser:
        browser.see("Sim time")
        wait(lambda: not browser.driver.execute_script("return document.getElementById('splash')"), "the page behind the splash")
        yield browser


def tool(browser, name):
    """The tool of that name, pressed as a hand does."""
    from selenium.webdriver.common.by import By

    browser.driver.find_element(By.CSS_SELECTOR, f"button.tool[aria-label='{name}']").click()


def keys(browser, *pressed):
    from selenium.webdriver.common.action_chains import ActionChains

    actions = ActionChains(browser.driver)
    *held, last = pressed
    for key in held:
        actions = actions.key_down(key)
    actions = actions.send_keys(last)
    for key in held:
        actions = actions.key_up(key)
    actions.perform()


def boxes(browser, *selectors):
    """left, top, right, bottom of each, CSS pixels."""
    return [
        browser.driver.execute_script(
            "const r = document.querySelector(arguments[0]).getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]", one
        )
        for one in selectors
    ]


def shown_tabs(browser, group):
    return [tab.strip() for tab in seen(browser, f"{group} [role=tab]", "e.textContent")]


def seen(browser, selector, what):
    """JavaScript's ``what`` of each element ``e`` that is on the page."""
    script = "return [...document.querySelectorAll(arguments[0])].filter(e => e.checkVisibility()).map(e => %s)" % what
    return browser.driver.execute_script(script, selector)


def paused(page):
    frame = page.simulation.frame()
    return frame is not None and frame.paused


def test_nothing_covers_the_scene_and_every_tool_can_be_reached(window):
    menus, tools, state, canvas = boxes(window, "#menus", "#tools", "#state_bar", "#root canvas")
    size = window.driver.execute_script("return [innerWidth, innerHeight]")
    assert menus[:3:2] == tools[:3:2] == state[:3:2] == [0, size[0]] and menus[1] == 0 and menus[3] == tools[1] and state[3] == size[1]
    assert tools[3] <= canvas[1] + 0.5 and canvas[3] <= state[1] + 0.5 and canvas[3] - canvas[1] > 0.5 * size[1]
    tree, listed = boxes(window, TREE, LIST)
    assert tree[2] <= canvas[0] + 0.5 and canvas[2] == size[0] and canvas[2] - canvas[0] > 0.5 * size[0]
    named = window.driver.execute_script(
        "return [...document.querySelectorAll('.tool')].map(b => [b.getAttribute('aria-label'), b.title, b.tabIndex])"
    )
    assert len(named) > 20 and all(name and title.startswith(name) and index == 0 for name, title, index in named)
    from selenium.webdriver.common.by import By

    for button in window.driver.find_elements(By.CSS_SELECTOR, ".tool"):
        window.driver.execute_script("arguments[0].scrollIntoView({inline: 'center'})", button)
        assert button.is_displayed()
    assert not window.complaints()


def test_play_pause_and_step(world, window):
    _, page = world
    page.simulation.pause(False)
    wait(lambda: not paused(page), "time passes")
    window.see("real-time factor")
    tool(window, "Pause")
    wait(lambda: paused(page), "the tool pauses")
    wait(lambda: window.driver.execute_script("return document.getElementById('bar_run').textContent") == "paused", "the foot says so")
    before = page.simulation.frame().iterations
    tool(window, "Step")
    wait(lambda: page.simulation.frame().iterations == before + 1, "one step")
    tool(window, "Play")
    wait(lambda: not paused(page), "the tool plays")
    keys(window, " ")
    wait(lambda: paused(page), "the space bar pauses")
    keys(window, " ")
    wait(lambda: not paused(page), "and plays")


def test_keys_delete_and_undo_but_not_while_one_types(world, window):
    from selenium.webdriver.common.keys import Keys

    simulation = world[1].simulation

    def models():
        return [model.name for model in simulation.describe().models]

    window.click("ball")
    window.see("Mass")
    window.fill("Search", "b")
    keys(window, Keys.DELETE)
    keys(window, " ")
    assert not paused(world[1]) and models() == ["ball"], "what is typed into a field is no command"
    window.fill("Search", "")
    window.driver.execute_script("document.activeElement.blur()")
    keys(window, Keys.DELETE)
    wait(lambda: models() == [], "deleted")
    keys(window, Keys.CONTROL, "z")
    wait(lambda: models() == ["ball"], "and back")


def test_views_and_tools_that_stay_pressed(window):
    before = window.scene()
    tool(window, "Top")
    wait(lambda: window.scene() != before, "another view")
    pressed = "return document.querySelector(\"button.tool[aria-label='Move and rotate by hand']\").getAttribute('aria-pressed')"
    assert window.driver.execute_script(pressed) == "false"
    tool(window, "Move and rotate by hand")
    wait(lambda: window.driver.execute_script(pressed) == "true", "it stays pressed")
    tool(window, "Move and rotate by hand")
    wait(lambda: window.driver.execute_script(pressed) == "false", "and is let go")
    tool(window, "Move and rotate by hand")
    tool(window, "Resize by hand")
    wait(lambda: window.driver.execute_script(pressed) == "false", "one hand at a time")
    tool(window, "Select")
    wait(lambda: window.driver.execute_script(pressed.replace("Move and rotate", "Resize")) == "false", "and none")


def test_the_tree_is_at_the_left_and_below_it_the_properties_of_what_is_picked_in_it(window):
    tree, listed, root = boxes(window, TREE, LIST, "#root")
    assert tree[0] == listed[0] == 0 and tree[1] == root[1] and abs(tree[3] - listed[1]) <= 1.0 and listed[3] <= root[3] + 0.5
    assert tree[2] - tree[0] >= 150 and tree[3] - tree[1] >= 140 and listed[3] - listed[1] >= 200
    assert shown_tabs(window, TREE) == ["World", "Insert"] and shown_tabs(window, LIST)[:2] == ["Properties", "Joints"]
    window.click("ball")
    window.see("Mass (kg)")
    (row,) = boxes(window, f"{TREE} button[style*='blue']")
    assert row[0] >= 0 and row[2] <= tree[2] and tree[1] <= row[1] and row[3] <= tree[3]
    fields = seen(window, f"{LIST} input", "[e.getBoundingClientRect().left, e.getBoundingClientRect().right]")
    assert len(fields) > 15 and all(0 <= left < right - 10 < listed[2] for left, right in fields)


def test_scene_and_physics_are_rows_of_the_tree_and_give_way_to_what_is_picked(window):
    window.click("Physics")
    window.see("Gravity (m/s²)")
    assert shown_tabs(window, LIST) == ["Properties", "Joints", "Physics"]
    window.click("Scene")
    window.see("Arrow for 1 N (m)")
    window.click("link" if "link" in window.text().split() else "ball")
    window.see("Mass (kg)")
    wait(lambda: shown_tabs(window, LIST) == ["Properties", "Joints"], "the list of what is picked")


def test_menus_reach_every_list_and_show_what_is_on(window):
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys

    def entries():
        return seen(window, ENTRIES, ENTRY)

    titles = window.driver.find_elements(By.CSS_SELECTOR, "#menus button")
    assert [title.text for title in titles] == ["File", "Edit", "Camera", "View", "Window"]
    titles[4].click()
    names = [name for name, _ in entries()]
    assert names == ["Properties", "Joints", "Physics", "Scene", "Timeline", "Record"]
    left, top, right, bottom = boxes(window, ".menu:not([hidden])")[0]
    assert left >= 0 and right <= window.driver.execute_script("return innerWidth")
    keys(window, Keys.ARROW_LEFT)
    wait(lambda: ["Grid", "true"] in entries() and ["Collisions", "false"] in entries(), "what is on")
    keys(window, Keys.ESCAPE)
    assert not entries()
    for name in names[2:]:
        window.click(name)
        wait(lambda name=name: shown_tabs(window, LIST) == ["Properties", "Joints", name], f"the list {name}")
    window.click("Properties")


def test_menus_and_their_entries_are_what_a_reader_of_the_screen_takes_them_for(window):
    """WAI-ARIA: a menubar owns menuitems, a menu menuitems, also such as are checked, and separators."""
    assert set(seen(window, "#menus > *", "e.getAttribute('role')")) == {"menuitem"}
    for title in window.driver.find_elements("css selector", "#menus > *"):
        title.click()
        roles = seen(window, ".menu:not([hidden]) > *", "e.getAttribute('role') ?? e.tagName")
        assert roles and set(roles) <= {"menuitem", "menuitemcheckbox", "HR"}, title.text
        title.click()


def test_a_menu_switches_what_it_shows_though_its_list_is_not_open(world, window):
    from selenium.webdriver.common.by import By

    page = world[1]
    view = window.driver.find_elements(By.CSS_SELECTOR, "#menus button")[3]
    for state in ("true", "false", "true", "false"):
        for label in ("Labels", "Joints", "Wireframe"):  # one at once after the other
            window.driver.execute_script(CHOOSE, "View", label)
        view.click()
        try:
            rows = [[label, state] for label in ("Labels", "Joints", "Wireframe")]
            wait(lambda rows=rows: all(row in seen(window, ENTRIES, ENTRY) for row in rows), f"the menu: {rows}")
            wait(lambda on=state == "true": page.drawing.wireframe == on, "the scene")
        finally:
            view.click()


def test_what_is_chosen_before_the_choice_before_was_told_is_not_lost(world, window):
    """The simulator has switched the labels on, and is slow to say so; meanwhile they are switched off again."""
    scene = next(panel for panel in world[1].panels if type(panel).__name__ == "ViewPanel")
    labels, joints = (scene._switches[name][0] for name in ("Labels", "Joints"))
    with scene._telling:
        window.driver.execute_script(CHOOSE, "View", "Labels")
        wait(lambda: labels.value, "the labels")
        window.driver.execute_script(CHOOSE, "View", "Labels")
        window.driver.execute_async_script("setTimeout(arguments[0], 500)")  # the frame has looked
        window.driver.execute_script(CHOOSE, "View", "Joints")
    wait(lambda: joints.value and not labels.value, "joints without labels")
    window.driver.execute_script(CHOOSE, "View", "Joints")
    wait(lambda: not joints.value, "no joints")


def test_a_box_of_the_list_and_its_entry_in_the_menu_are_one(world, window):
    from selenium.webdriver.common.by import By

    def marked(state):
        return ["Grid", state] in seen(window, ENTRIES, ENTRY)

    view = window.driver.find_elements(By.CSS_SELECTOR, "#menus button")[3]
    window.click("Scene")
    window.see("Arrow for 1 N (m)")
    for state in ("false", "true"):
        window.check("Grid")
        view.click()
        wait(lambda state=state: marked(state), f"the entry is {state}")
        view.click()
    for state in (False, True):
        window.driver.execute_script(CHOOSE, "View", "Grid")
        box = window._find(window._input("Grid", "checkbox"), "box Grid")
        wait(lambda state=state, box=box: box.is_selected() == state, f"the box is {state}")
        wait(lambda state=state: world[1].drawing.grid.visible == state, "so is the grid")
    window.click("Properties")


def test_the_panel_is_made_wider_and_put_away(window):
    (before,) = boxes(window, TREE)
    (edge,) = boxes(window, ".edge[data-edge='--left']")
    middle = (edge[0] + 3, (edge[1] + edge[3]) / 2)
    window.mouse(middle, (middle[0] + 40, middle[1]), drag=True)
    after, canvas = boxes(window, TREE, "#root canvas")
    assert after[2] - before[2] == pytest.approx(40, abs=3) and canvas[0] >= after[2]
    window.mouse((middle[0] + 40, middle[1]), middle, drag=True)
    window.check("Panel at the left")
    wait(lambda: boxes(window, "#root canvas")[0][0] == 0, "the whole width for the scene")
    window.check("Panel at the left")
    wait(lambda: boxes(window, "#root canvas")[0][0] > 100, "the panel again")


def test_several_steps_at_once(world, window):
    page = world[1]
    page.simulation.pause(True)
    wait(lambda: paused(page), "a pause")
    before = page.simulation.frame().iterations
    window.driver.execute_script("document.getElementById('steps').value = 7")  # a narrow page leaves the field out
    tool(window, "Step")
    wait(lambda: page.simulation.frame().iterations == before + 7, "seven steps")
    window.driver.execute_script("document.getElementById('steps').value = 1")


def test_what_is_seen_while_it_loads(world):
    """The splash, then the page: never what viser shows to who makes viser, nor a notice that the processor draws."""
    with Browser("about:blank") as browser:
        browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": WATCH})
        browser.driver.get(world[1].address)
        browser.see("Models", "Lights")
        wait(lambda: not browser.driver.execute_script("return document.getElementById('splash')"), "the page behind the splash")
        browser.see("drawn by the processor")
        wait(lambda: browser.driver.execute_script("return performance.now()") > 9000.0, "the time at which viser gives its notice")
        assert browser.driver.execute_script("return [...window.__seen]") == []


def test_a_grey_post_on_a_grey_floor_is_seen_in_a_world_without_a_light():
    """Its left side, its right side and the floor beside it differ by what an eye tells apart: a fiftieth of white and more."""
    grey = "<material><ambient>0.5 0.5 0.5 1</ambient><diffuse>0.5 0.5 0.5 1</diffuse></material>"
    shape = "<visual name='v'><geometry>{}</geometry>" + grey + "</visual>"
    post = shape.format("<cylinder><radius>0.4</radius><length>2</length></cylinder>")
    floor = shape.format("<plane><normal>0 0 1</normal><size>60 60</size></plane>")
    world = World.load(
        "<sdf version='1.6'><world name='w'><scene><grid>0</grid></scene>"
        f"<model name='floor'><static>1</static><link name='l'>{floor}</link></model>"
        f"<model name='post'><static>1</static><pose>0 0 1 0 0 0</pose><link name='l'>{post}</link></model></world></sdf>"
    )
    with Page(LocalSimulation(world, paused=True), port=0) as page:
        thread = threading.Thread(target=page.run, daemon=True)
        thread.start()
        with Browser(page.address) as browser:
            browser.see("post")
            wait(lambda: np.ptp(pixels(browser.scene())[:, :, 0]) > 40, "something that is drawn")
            browser.settled(b"")
            picture = pixels(browser.scene()).mean(axis=2)
    thread.join()
    middle = picture[picture.shape[0] // 2]
    edges = np.flatnonzero(np.abs(np.diff(middle)) > 5.0)
    left, right = edges.min() + 1, edges.max()
    assert 20 < right - left < 0.8 * len(middle)
    sides = middle[left + 5], middle[right - 5]
    assert abs(sides[0] - sides[1]) > 10 and min(abs(side - middle[left - 10]) for side in sides) > 5
