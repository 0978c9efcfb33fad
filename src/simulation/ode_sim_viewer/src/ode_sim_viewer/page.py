"""The page: draws the world, follows it, and joins the panels."""

from __future__ import annotations

import logging
import queue
import threading
import time
from collections.abc import Callable, Sequence
from typing import Any

from ode_sim.description.model import one_line

from ode_sim_viewer.drawing import Drawing
from ode_sim_viewer.eye import Eyes, view_from, view_of
from ode_sim_viewer.overlays import Overlays
from ode_sim_viewer.panels import STANDARD
from ode_sim_viewer.panels.base import Panel
from ode_sim_viewer.placing import Placing
from ode_sim_viewer.pulling import Pull
from ode_sim_viewer.resizing import Resizing
from ode_sim_viewer.selection import Selection
from ode_sim_viewer.simulation import Frame, Refused, Simulation, WorldRecord
from ode_sim_viewer.website import DEFAULT_PORT, Website

_PERIOD = 1.0 / 30.0  # wall s between two looks at the simulation
_IDLE_PERIOD = 0.25  # the same while no browser shows it
_TEXT_PERIOD = 0.2  # wall s between two updates of numbers
_SETTLING = 20.0  # wall s in which the eye follows a world that is still being put together
_PATIENCE = 15.0  # wall s that somebody who knocked may take to come in
_CATCH_UP = 2.0  # wall s that a button waits for the thread that draws
FIRST_LOOK = 1.0  # wall s for the browser of the first who came in, before it gets more tabs to make
_log = logging.getLogger("viewer")


class Page:
    """Shows a simulation until :meth:`close`; a context manager.

    :param website: a port that is held already; it is opened, ``port`` and ``listen`` are not used
    :param panels: classes of more :class:`~ode_sim_viewer.panels.base.Panel`, behind the standard ones
    :param later: gives still more of them when the world has been shown, so that nobody waits for them with it; if ``website`` is
        given, somebody is expected, who is shown the world before
    :param say: where lines for the user go who started it
    :param shadows: drawn from the beginning; the tab View changes it
    :raises ode_sim_viewer.website.Unavailable: no page can be served
    """

    def __init__(
        self,
        simulation: Simulation,
        port: int = DEFAULT_PORT,
        listen: bool = False,
        title: str = "Gazebo",
        panels: Sequence[type] = (),
        say: Callable[[str], None] = _log.warning,
        website: Website | None = None,
        later: Callable[[], Sequence[type]] = tuple,
        shadows: bool = True,
    ):
        self.simulation = simulation
        self.website = website or Website(port, listen, title)
        self.server = self.website.open()
        self.world = WorldRecord()
        self.frame: Frame | None = None
        self._say = say
        for line in simulation.problems:
            say(line)
        self._jobs: queue.SimpleQueue = queue.SimpleQueue()
        self._ended = threading.Event()
        self._wake = threading.Event()  # there are jobs
        self._drawer: threading.Thread | None = None  # in run()
        self._holder: int | None = None  # the page that holds the controls
        self.on_let_go: Callable[[], None] = lambda: None  # the page that held them has gone
        self._pages = 0
        self._counting = threading.Lock()
        self._next_text = 0.0
        self._absent = False
        self._expected = website is not None
        self._came: float | None = None  # when the first browser was there
        self._begun = time.monotonic()
        self._settled = self._begun + _SETTLING
        self.server.gui.configure_theme(control_width="medium", show_logo=False, show_share_button=False)
        self.server.gui.set_panel_label(title)
        self.eyes = Eyes(self.server)
        self.pull = Pull(self)
        self.placing = Placing(self)
        self.drawing = Drawing(self.server, self._picked, self.pull.attach)
        self.drawing.shadows = shadows
        self.overlays = Overlays(self)
        self.selection = Selection(self)
        self.resizing = Resizing(self)
        self.panels: list[Panel] = []
        self.commands: Any = None  # the folder of controls that are not seen
        self._later: Callable[[], Sequence[type]] | None = later
        self._build([*STANDARD, *panels])
        self.server.on_client_connect(self._on_connect)
        self.server.on_client_disconnect(self._on_disconnect)

    def __enter__(self) -> Page:
        return self

    def __exit__(self, *_: Any) -> None:
        self.close()

    @property
    def address(self) -> str:
        """What to type into a browser."""
        return self.website.address

    @property
    def pages(self) -> int:
        """How many browsers show it."""
        return self._pages

    def close(self) -> None:
        """End :meth:`run` and the web server. Any thread, more than once."""
        if not self._ended.is_set():
            self._ended.set()
            self._wake.set()
            self.simulation.close()
            self.website.close()

    # ------------------------------------------------------------------------------------------ what panels use

    def later(self, f: Callable[[], None]) -> None:
        """Call ``f()`` in the thread that draws. Any thread."""
        self._jobs.put(f)
        self._wake.set()

    def catch_up(self) -> bool:
        """Return when what was asked of the thread that draws is done: a pick before the deletion that follows it. Other threads.

        :returns: whether there is such a thread, and it has not been too busy
        """
        if self._drawer is None or self._drawer is threading.current_thread():
            return False
        done = threading.Event()
        self.later(done.set)
        return done.wait(_CATCH_UP)

    def attempt(self, event: Any, f: Callable[[], Any]) -> Any:
        """Do what a page asked for: ``f()``, unless another page holds the controls; a refusal is shown on that page.

        :param event: viser's; one without a client was made by the program and is not acted upon
        :returns: what ``f`` returns; None when it was refused
        """
        who = getattr(event, "client_id", None)
        if who is None:
            return None
        if self._holder not in (None, who):
            self.tell(event, "Another page holds the controls; take them there, or wait until it lets go.")
            return None
        try:
            return f()
        except Refused as error:
            self.tell(event, str(error))
        except Exception as error:  # a page may send anything; the others go on
            _log.debug("a request of a page failed", exc_info=True)
            self.tell(event, f"{type(error).__name__}: {error}")
        return None

    def tell(self, event: Any, text: str) -> None:
        """A line, ``text``, on the page that ``event`` came from."""
        client = getattr(event, "client", None)
        if client is not None:
            client.add_notification("", one_line(text, 400), auto_close_seconds=8.0, color="red")

    def hold(self, event: Any, on: bool) -> bool:
        """Take (``on``) or let go of the controls, for the page that ``event`` came from; whether it was done."""
        who = getattr(event, "client_id", None)
        if who is None or self._holder not in (None, who):
            self.tell(event, "Another page holds the controls already.")
            return False
        self._holder = who if on else None
        return True

    # ------------------------------------------------------------------------------------------ the loop

    def run(self, ended: Callable[[], bool] = lambda: False) -> None:
        """Draw until :meth:`close`, or until ``ended()``."""
        self._drawer = threading.current_thread()
        while not self._ended.is_set() and not ended():
            begin = time.monotonic()
            self._guarded(self.turn)
            spent = time.monotonic() - begin
            rest = begin + spent + max((_PERIOD if self._pages else _IDLE_PERIOD) - spent, spent)  # half a core at most
            while (left := rest - time.monotonic()) > 0.0 and not self._ended.is_set():
                if self._wake.wait(left):  # what a hand does is done at once
                    self._guarded(self._do_jobs)
        self._drawer = None

    def _guarded(self, f: Callable[[], None]) -> None:
        try:
            f()
        except Exception as error:  # a bug in one part must not end the window
            _log.debug("the page stumbled", exc_info=True)
            self._say(f"{type(error).__name__}: {one_line(error, 200)}")
            self._ended.wait(1.0)

    def turn(self) -> None:
        """One look at the simulation."""
        self._do_jobs()
        if self.frame is not None or self._absent:
            self._complete()
        if self._begun and time.monotonic() > self._begun + _PATIENCE:
            self._begun = 0.0
            self._count()  # if nobody came in; who comes in just now is counted by another thread
        self.eyes.fit()
        frame = self.simulation.frame()
        if frame is None:
            if not self._absent:
                self._absent = True
                self._each(lambda panel: panel.on_absent())
                self._complete()
            return
        if frame is self.frame and not self._absent:
            return
        if frame.revision != self.world.revision or self._absent:
            self._absent = False
            self._take(self.simulation.describe(), frame)
        self.frame = frame
        if frame.revision == self.world.revision:  # else the rows are of another world: the next frame has them
            self.drawing.move(frame)
            self.overlays.move(frame)
            self.pull.move(frame)
            self.resizing.move(frame)
            self._each(lambda panel: panel.on_move(frame))
        now = time.monotonic()
        if now >= self._next_text:
            self._next_text = now + _TEXT_PERIOD
            self.selection.on_frame(frame)
            self._each(lambda panel: panel.on_frame(frame))
            self._complete()

    def models_changed(self) -> None:
        """A model was saved. Any thread."""
        self.later(lambda: self._each(lambda panel: panel.on_models()))

    def redraw(self) -> None:
        """All anew, after a change of how things are drawn. Drawing thread."""
        self.drawing.redraw(self.world)
        self.overlays.update(self.world)
        self._each(lambda panel: panel.on_world(self.world))  # what they hung on the links went with these
        self.frame = None

    def _take(self, world: WorldRecord, frame: Frame) -> None:
        self.world = world
        self.drawing.update(world)
        if frame.revision == world.revision:
            self.drawing.move(frame)
            if time.monotonic() < self._settled:
                corners = self.drawing.corners(frame)
                eye = world.view
                self.eyes.look(lambda aspect: view_of(*corners, aspect) if eye is None else view_from(eye, *corners))
        self.overlays.update(world)
        self.selection.update(world)
        self._each(lambda panel: panel.on_world(world))
        for line in self.drawing.problems:
            self._say(line)
        self.drawing.problems.clear()

    def _do_jobs(self) -> None:
        self._wake.clear()
        while True:
            try:
                job = self._jobs.get_nowait()
            except queue.Empty:
                return
            try:
                job()
            except Refused as error:
                self._say(str(error))
            except Exception as error:  # those behind it are done all the same
                _log.debug("a job stumbled", exc_info=True)
                self._say(f"{type(error).__name__}: {one_line(error, 200)}")

    def _each(self, f: Callable[[Panel], None]) -> None:
        for panel in self.panels:
            f(panel)

    def _build(self, kinds: Sequence[type[Panel]]) -> None:
        """The frame knows the three by their order: what it presses, the tree, the lists."""
        gui = self.server.gui
        self.commands = gui.add_folder("Commands")
        self._upper, self._lower = gui.add_tab_group(), gui.add_tab_group()
        self._add_panels(kinds)

    def _add_panels(self, kinds: Sequence[type[Panel]]) -> None:
        for kind in kinds:
            tabs = self._upper if kind.upper else self._lower
            with tabs.add_tab(kind.title) if kind.title else self.commands:
                self.panels.append(kind(self))

    def _complete(self) -> None:
        """The panels that come later. Drawing thread."""
        if self._later is None or self._busy_with_the_world():
            return
        kinds, self._later = self._later(), None
        count = len(self.panels)
        self._add_panels(kinds)
        for panel in self.panels[count:]:
            if self._absent:
                panel.on_absent()
            else:
                panel.on_world(self.world)

    def _busy_with_the_world(self) -> bool:
        """The browser of the first who looks makes its page just now, or is about to."""
        if self._came is None:
            return self._expected and self._begun > 0.0
        return time.monotonic() < self._came + FIRST_LOOK

    def _picked(self, model: str, link: str, event: Any) -> None:
        if not self.placing.takes(event):
            self.attempt(event, lambda: self.later(lambda: self.selection.select(model, link)))

    def _on_connect(self, client: Any) -> None:
        if self._came is None:
            self._came = time.monotonic()
        self._count()

    def _on_disconnect(self, client: Any) -> None:
        if self._holder == client.client_id:
            self._holder = None
            self.on_let_go()
        self._count()

    def _count(self) -> None:
        """Callbacks come in threads of their own, that of the end of a page even before that of its beginning: what
        counts is who is there."""
        with self._counting:
            self._pages = len(self.server.get_clients())
            self.simulation.look(bool(self._pages))
