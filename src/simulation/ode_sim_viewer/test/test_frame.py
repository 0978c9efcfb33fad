"""What stands round the page, in a real browser: the tools, the keys, the state, what is shown while it loads, at three sizes."""

import pathlib
import sys
import threading

import pytest
from ode_sim import World

pytest.importorskip("viser")
sys.path.append(str(pathlib.Path(__file__).parents[3] / "windows" / "gzclient" / "test"))
from browser import Browser, missing, wait  # noqa: E402
from ode_sim_viewer import LocalSimulation, Page  # noqa: E402

pytestmark = [pytest.mark.slow, pytest.mark.skipif(bool(missing()), reason=f"not installed: {missing()}")]

BALL = """<sdf version="1.6"><model name="ball"><pose>0 0 1 0 0 0</pose><link name="link"><gravity>false</gravity>
<inertial><mass>1</mass></inertial><collision name="c"><geometry><sphere><radius>0.3</radius></sphere></geometry></collision>
<visual name="v"><geometry><sphere><radius>0.3</radius></sphere></geometry></visual></link></model></sdf>"""
SIZES = ((1400, 900), (900, 700), (500, 800))  # the last one: a phone's width, the least that Chromium's window has
WATCH = """window.__seen = new Set();
setInterval(() => { for (const word of ["Dev Settings", "Save Canvas", "WorldAxes"]) {
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

    browser.driver.find_element(By.CSS_SELECTOR, f"#tools button[aria-label='{name}']").click()


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


def paused(page):
    frame = page.simulation.frame()
    return frame is not None and frame.paused


def test_nothing_covers_the_scene_and_every_tool_can_be_reached(window):
    tools, state, canvas = boxes(window, "#tools", "#state_bar", "#root canvas")
    size = window.driver.execute_script("return [innerWidth, innerHeight]")
    assert tools[:3:2] == state[:3:2] == [0, size[0]] and tools[1] == 0 and state[3] == size[1]
    assert tools[3] <= canvas[1] + 0.5 and canvas[3] <= state[1] + 0.5 and canvas[3] - canvas[1] > 0.3 * size[1]
    named = window.driver.execute_script(
        "return [...document.querySelectorAll('#tools button')].map(b => [b.getAttribute('aria-label'), b.title, b.tabIndex])"
    )
    assert len(named) > 15 and all(name and title.startswith(name) and index == 0 for name, title, index in named)
    from selenium.webdriver.common.by import By

    for button in window.driver.find_elements(By.CSS_SELECTOR, "#tools button"):
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
    tool(window, "Look from the top")
    wait(lambda: window.scene() != before, "another view")
    pressed = "return document.querySelector(\"#tools button[aria-label='Move and rotate by hand']\").getAttribute('aria-pressed')"
    assert window.driver.execute_script(pressed) == "false"
    tool(window, "Move and rotate by hand")
    wait(lambda: window.driver.execute_script(pressed) == "true", "it stays pressed")
    tool(window, "Move and rotate by hand")
    wait(lambda: window.driver.execute_script(pressed) == "false", "and is let go")
    tool(window, "Insert a model or a shape")
    wait(
        lambda: window.driver.execute_script("return document.querySelector('[role=tab][aria-selected=true]').textContent") == "Insert",
        "the tab",
    )


def test_what_is_seen_while_it_loads(world):
    """The splash, then the page: never what viser shows to who makes viser, nor a notice that the processor draws."""
    with Browser("about:blank") as browser:
        browser.driver.execute_cdp_cmd("Page.addScriptToEvaluateOnNewDocument", {"source": WATCH})
        browser.driver.get(world[1].address)
        browser.see("Models and lights")
        wait(lambda: not browser.driver.execute_script("return document.getElementById('splash')"), "the page behind the splash")
        browser.see("drawn by the processor")
        assert browser.driver.execute_script("return [...window.__seen]") == []
        wait(lambda: browser.driver.execute_script("return performance.now()") > 8000.0, "the time at which viser gives its notice")
        wait(lambda: "Software WebGL" not in browser.text(), "a page without it", 5.0)
