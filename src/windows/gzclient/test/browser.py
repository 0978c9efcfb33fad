"""Debian's Chromium, with real clicks and keys, for tests that look at the page as a user does."""

import contextlib
import io
import math
import os
import shutil
import tempfile
import time

import numpy as np
from PIL import Image

PATIENCE = 60.0  # s, on a machine that does other things too
FRAMES = 3  # a second: the processor draws them, and has more to do


def wait(condition, what, seconds=PATIENCE):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"not in {seconds:g} s: {what}")


def pixels(png):
    """(rows, columns, 3), 0 to 255."""
    return np.asarray(Image.open(io.BytesIO(png)).convert("RGB"), float)


def share(png, colour):
    """Number of pixels of the hue of ``colour``, in light and shade."""
    seen = pixels(png) - pixels(png).mean(axis=2, keepdims=True)
    wanted = np.array(colour) - np.mean(colour)
    strong = np.linalg.norm(seen, axis=2)
    return int(((seen @ wanted > 0.97 * strong * np.linalg.norm(wanted)) & (strong > 25.0)).sum())


def missing():
    """What of the programs is not installed; '' when all are."""
    return " ".join(name for name in ("chromium", "chromedriver") if not shutil.which(name))


def _quoted(text):
    """For XPath."""
    return f'"{text}"' if "'" in text else f"'{text}'"


#: What is on the page, by XPath, and else an entry of its menus, by clicks on title and entry.
_CHOOSE = """
const all = document.evaluate(arguments[1], document, null, XPathResult.ORDERED_NODE_SNAPSHOT_TYPE, null);
for (let i = 0; i < all.snapshotLength; i++) if (all.snapshotItem(i).checkVisibility()) return "seen";
if (document.getElementById("splash")) return "";
for (const title of document.querySelectorAll("#menus button")) {
  title.click();
  for (const entry of document.querySelectorAll(".menu:not([hidden]) button"))
    if (entry.firstElementChild.textContent === arguments[0]) { entry.click(); return "chosen"; }
  title.click();
}
return "";"""


class Browser:
    """One window with the page at ``address``; a context manager."""

    def __init__(self, address, size=(900, 700), frames=FRAMES):
        from selenium import webdriver
        from selenium.webdriver.chrome.options import Options
        from selenium.webdriver.chrome.service import Service

        self._folder = tempfile.TemporaryDirectory(prefix="chromium_", ignore_cleanup_errors=True)
        options = Options()
        for word in (
            "--headless=new",
            "--no-first-run",
            "--disable-background-networking",
            "--disable-component-update",
            "--disable-sync",
            "--disable-dev-shm-usage",
            "--use-angle=swiftshader",
            "--disable-quic",
            "--enable-unsafe-swiftshader",
            "--webgl-antialiasing-mode=none",
            f"--window-size={size[0]},{size[1]}",
            f"--user-data-dir={self._folder.name}",
            *(["--no-sandbox"] if os.geteuid() == 0 else []),
        ):
            options.add_argument(word)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
        options.add_experimental_option("prefs", {"download.default_directory": self._folder.name})
        options.binary_location = shutil.which("chromium")
        self.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
        self.driver.set_page_load_timeout(PATIENCE)
        self.driver.set_script_timeout(PATIENCE)
        if frames:
            self.driver.execute_cdp_cmd(
                "Page.addScriptToEvaluateOnNewDocument",
                {
                    "source": f"""
                window.requestAnimationFrame = f => setTimeout(() => f(performance.now()), {1000 // frames});
                window.cancelAnimationFrame = clearTimeout;"""
                },
            )
        self._open = True
        self.address = address
        self.driver.get(address)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def close(self):
        """More than once does nothing."""
        if self._open:
            self._open = False
            self.driver.quit()
        self._folder.cleanup()

    # ------------------------------------------------------------------------------------------ looking

    def text(self):
        return self.driver.execute_script("return document.body.innerText")

    def see(self, *words, seconds=PATIENCE):
        """Wait until all ``words`` are on the page."""
        wait(lambda: all(word in self.text() for word in words), f"{words} on the page", seconds)

    def shot(self, file):
        self.driver.save_screenshot(file)

    def scene(self):
        """The picture of the scene, as PNG."""
        from selenium.webdriver.common.by import By

        return self.driver.find_element(By.CSS_SELECTOR, "canvas").screenshot_as_png

    def settled(self, before):
        """Wait until the scene looks otherwise than in the picture ``before`` and does not change any more."""

        def still():
            first = self.scene()
            time.sleep(2.0 / FRAMES)
            return first == self.scene()

        wait(lambda: self.scene() != before, "a scene that looks otherwise")
        wait(still, "a scene at rest")

    def downloaded(self, ending):
        """The whole content of a file of that ending, once it has come."""

        def whole():
            names = os.listdir(self._folder.name)
            found = [name for name in names if name.endswith(ending)]
            return found and not any(name.endswith(".crdownload") for name in names) and found[0]

        file = os.path.join(self._folder.name, wait(whole, f"a download {ending}"))
        with open(file, "rb") as stream:
            content = stream.read()
        os.remove(file)
        return content

    def complaints(self):
        """Lines of the page's console that are errors."""
        return [
            line["message"] for line in self.driver.get_log("browser") if line["level"] == "SEVERE" and "favicon" not in line["message"]
        ]

    # ------------------------------------------------------------------------------------------ doing

    def _find(self, path, what):
        """The first that is seen, of several; tabs that are not open have their controls, too."""
        from selenium.common.exceptions import StaleElementReferenceException
        from selenium.webdriver.common.by import By

        def found():
            elements = self.driver.find_elements(By.XPATH, path)
            try:
                return next((element for element in elements[:-1] if element.is_displayed()), elements[-1] if elements else None)
            except StaleElementReferenceException:
                return None

        return wait(found, what)

    def _press(self, path, what):
        """Where it is, with the mouse; again when it was drawn anew under the hand."""
        from selenium.common.exceptions import (
            ElementClickInterceptedException,
            ElementNotInteractableException,
            StaleElementReferenceException,
        )

        def pressed():
            element = self._find(path, what)
            try:
                self.driver.execute_script("arguments[0].scrollIntoView({block: 'center'})", element)
                element.click()
                return True
            except (StaleElementReferenceException, ElementClickInterceptedException, ElementNotInteractableException):
                return False

        wait(pressed, f"a click on {what}")

    def click(self, label):
        """A button, tool or tab of that label; what is not on the page is looked for in its menus."""
        seen = f"{self._named(label)}[not(@role='menuitem' or @role='menuitemcheckbox')]"
        if self._there(label, seen) == "seen":
            self._press(seen, f"button {label}")

    def _there(self, label, seen):
        """Wait until it is "seen" (XPath) on the page, or a menu has it, which then was "chosen" from it."""
        return wait(lambda: self.driver.execute_script(_CHOOSE, label, seen), f"{label} on the page or in its menus")

    def link(self, name):
        """The row of a link in the tree; its model may have the same name."""
        self._press(f"{self._named(name)}[.//*[contains(@class, 'icon-tabler-point')]]", f"link {name}")

    @staticmethod
    def _named(label):
        """Of a button; a tool has a picture, and its name for who hears the page."""
        quoted = _quoted(label)
        return f"//button[normalize-space(.)={quoted} or @aria-label={quoted}]"

    def _from_menu(self, label, seen):
        """Choose an entry as a hand does, unless something that ``seen`` (XPath) finds is on the page; whether it was there."""
        return self.driver.execute_script(
            """
            const all = document.evaluate(arguments[1], document, null, XPathResult.ORDERED_NODE_SNAPSHOT_TYPE, null);
            for (let i = 0; i < all.snapshotLength; i++) if (all.snapshotItem(i).checkVisibility()) return false;
            for (const title of document.querySelectorAll("#menus button")) {
              title.click();
              for (const entry of document.querySelectorAll(".menu:not([hidden]) button"))
                if (entry.firstElementChild.textContent === arguments[0]) { entry.click(); return true; }
              title.click();
            }
            return false;""",
            label,
            seen,
        )

    def button(self, label):
        """A button of that label, where a tab has it as well."""
        self._press(f"//button[not(@role)][normalize-space(.)='{label}']", f"button {label}")

    def put_away(self, words):
        """The notice with these words, once it is there; a click on one that still slides in may miss it."""
        from selenium.common.exceptions import WebDriverException
        from selenium.webdriver.common.by import By

        path = f"//*[contains(@class, 'Notification-root')][contains(., {_quoted(words)})]//button"
        self.see(words)

        def away():
            with contextlib.suppress(WebDriverException):
                for button in self.driver.find_elements(By.XPATH, path):
                    button.click()
            return words not in self.text()

        wait(away, f"the notice {words} is gone")

    def check(self, label):
        """The box of that label, also one that a tool or a menu shows."""
        tool = f"{self._named(label)}[@aria-pressed]"
        if self._there(label, f"//label[normalize-space(.)={_quoted(label)}]|{tool}") == "seen":
            self._press(f"{self._input(label, 'checkbox')}|{tool}", f"box {label}")

    def unfold(self, label):
        """A folder of that label."""
        self._press(f"//*[text()='{label}']", f"folder {label}")

    def fill(self, label, value, part=1):
        """A field of that label, by its keys, left by Enter.

        :param part: of a vector, from 1
        """
        from selenium.webdriver.common.keys import Keys

        self._press(self._input(label, part=part), f"field {label}")  # once a folder that unfolds shows it
        element = self._find(self._input(label, part=part), f"field {label}")
        # a field that was entered puts its caret right a turn later: keys that come before, sooner than a hand's, lose their minus to it
        self.driver.execute_async_script("const done = arguments[0]; setTimeout(() => setTimeout(done, 20), 0)")
        element.send_keys(Keys.CONTROL, "a")
        element.send_keys(str(value) or Keys.DELETE, Keys.ENTER)

    def upload(self, label, file):
        """A file through the button of that label, as the dialog of the browser gives it."""
        path = f"//button[normalize-space(.)='{label}']/preceding-sibling::input[@type='file']"
        self._find(path, f"upload {label}").send_keys(file)

    def place(self, label):
        """(x, y) in CSS pixels of the middle of a button, which is scrolled to."""
        return self.driver.execute_script(
            """
            arguments[0].scrollIntoView({block: "center"});
            const r = arguments[0].getBoundingClientRect(); return [r.x + r.width / 2, r.y + r.height / 2];""",
            self._find(self._named(label), f"button {label}"),
        )

    def value(self, label):
        """What a field shows."""
        return self._find(self._input(label), f"field {label}").get_attribute("value")

    def choose(self, label, value):
        """An entry of the list of that label; again when the list was still folding up from an earlier choice."""

        def chosen():
            self._press(self._input(label), f"list {label}")
            self._press(f"//*[@role='option'][normalize-space(.)={_quoted(value)}]", f"entry {value}")
            until = time.monotonic() + 2.0
            while self.value(label) != value and time.monotonic() < until:
                time.sleep(0.05)
            return self.value(label) == value

        wait(chosen, f"{value} as what list {label} shows")

    @staticmethod
    def _input(label, kind="", part=1):
        only = f"[@type='{kind}']" if kind else "[not(@type='hidden')]"  # a slider has one that is not seen
        return f"//label[normalize-space(.)={_quoted(label)}]/following::*[self::input or self::textarea]{only}[{part}]"

    # ------------------------------------------------------------------------------------------ the scene

    def pixel(self, point, eye, target, field):
        """(x, y) in CSS pixels of a place of the world that a camera sees.

        :param field: of view, from the lower to the upper edge, rad
        """
        box = self.driver.execute_script(
            "const r = document.querySelector('canvas').getBoundingClientRect(); return [r.x, r.y, r.width, r.height]"
        )
        ahead = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        away = np.subtract(point, eye)
        scale = 0.5 * box[3] / (math.tan(field / 2) * (away @ ahead))
        return (box[0] + box[2] / 2 + scale * (away @ right), box[1] + box[3] / 2 - scale * (away @ np.cross(right, ahead)))

    def hover(self, point):
        """Move the pointer there (CSS pixels), without a click."""
        from selenium.webdriver.common.action_chains import ActionChains

        actions = ActionChains(self.driver, duration=20)
        actions.w3c_actions.pointer_action.move_to_location(*(int(round(v)) for v in point))
        actions.perform()

    def canvas(self, x, y):
        """(x, y) in CSS pixels of a part of the scene's picture, 0 to 1 from the upper left corner."""
        box = self.driver.execute_script(
            "const r = document.querySelector('canvas').getBoundingClientRect(); return [r.x, r.y, r.width, r.height]"
        )
        return box[0] + x * box[2], box[1] + y * box[3]

    def mouse(self, *points, drag=False, keys=(), hold=0.2):
        """Click at a point (CSS pixels), or drag from the first through all to the last, and stay there for ``hold`` s."""
        from selenium.webdriver.common.action_chains import ActionChains

        for key in keys:  # of their own: the keys' steps and the pointer's would be taken side by side
            ActionChains(self.driver).key_down(key).perform()
        actions = ActionChains(self.driver, duration=20)
        actions.w3c_actions.pointer_action.move_to_location(*(int(round(v)) for v in points[0]))
        if drag:
            actions.w3c_actions.pointer_action.pointer_down()
            for begin, end in zip(points, points[1:]):
                for part in (0.02, 0.3, 0.6, 0.9, 1.0):
                    at = [int(round(a + part * (b - a))) for a, b in zip(begin, end)]
                    actions.w3c_actions.pointer_action.move_to_location(*at)
                    actions.w3c_actions.pointer_action.pause(0.06)
            actions.w3c_actions.pointer_action.pause(hold)
            actions.w3c_actions.pointer_action.pointer_up()
        else:
            actions.w3c_actions.pointer_action.click()
        actions.perform()
        for key in keys:
            ActionChains(self.driver).key_up(key).perform()
