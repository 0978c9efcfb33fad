"""The bags, the playhead and who watches it: what views and renderers know as the time line."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING

import genpy
from python_qt_binding.QtCore import QElapsedTimer, QObject, QTimer, Signal

from rqt_bag.bags import BagError, Bags, copy_region, open_bag
from rqt_bag.player import Player
from rqt_bag.recorder import Recorder

if TYPE_CHECKING:
    from rqt_bag.timeline_frame import TimelineFrame

_TICK = 40  # ms
SLOWEST, FASTEST = 1 / 1024, 1024.0


class BagTimeline(QObject):
    """Bags, playback, publishing, recording.

    Its ``_timeline_frame`` has the playhead and the play region; the names that views of others use are upstream's.

    :param context: of the plugin: views become docks of it. :param publish_clock: publish the playhead's time on /clock.
    """

    _timeline_frame: TimelineFrame  # set by the frame itself

    status_bar_changed_signal = Signal()
    selected_region_changed = Signal(object, object)
    messages_changed = Signal()  #: bags or messages were added
    play_state_changed = Signal()
    recording_changed = Signal()
    problem = Signal(str)
    progress = Signal(str, float)  #: what is going on in the background, and 0..1; empty when it has ended
    _bag_opened = Signal(object)
    _viewed = Signal(str, object, object)
    _recorded = Signal(str)
    _redraw = Signal()

    def __init__(self, context, publish_clock: bool = False):
        super().__init__()
        self._context = context
        self._bags = Bags()
        self._bag_lock = self._bags.lock
        self._player = Player(self._bags, publish_clock, self.problem.emit)
        self._recorder: Recorder | None = None
        self._listeners: dict[str, list] = {}
        self._shown: dict[str, object] = {}
        self._play_speed = 0.0
        self.last_speed = 1.0
        self.play_all = False
        self._clock = QElapsedTimer()
        self._timer = QTimer(self)
        self._timer.timeout.connect(self._tick)
        self._over = threading.Event()
        self._wish: genpy.Time | None = None
        self._wished = threading.Condition()
        self._loader = threading.Thread(target=self._load_views, daemon=True)
        self._loader.start()
        self._background: threading.Thread | None = None
        self._live: dict[str, list[float]] = {}
        self._bag_opened.connect(self.add_bag)
        self._viewed.connect(self._show)
        self._recorded.connect(self._message_recorded)
        self._redraw.connect(lambda: self._timeline_frame and self._timeline_frame.update())

    # Bags

    def load_bag(self, name: str) -> None:
        """Open a bag in another thread and add it; what is wrong is told."""

        def work() -> None:
            self.progress.emit(f"opening {name}", 0.0)
            try:
                self._bag_opened.emit(open_bag(name))
            except BagError as error:
                self.problem.emit(str(error))
            self.progress.emit("", 1.0)

        threading.Thread(target=work, daemon=True).start()

    def add_bag(self, bag) -> None:
        """Add an open bag."""
        self._bags.add(bag)
        self._bags_changed()

    def _bags_changed(self) -> None:
        self._timeline_frame.bags_changed()
        for listener in self._all_listeners():
            listener.timeline_changed()
        self.messages_changed.emit()

    def get_context(self):
        return self._context

    def file_size(self) -> int:
        return self._bags.file_size

    def _get_topics(self) -> list[str]:
        return sorted(set(self._bags.topics) | set(self._live))

    topics = property(_get_topics)

    def get_datatype(self, topic: str) -> str | None:
        return self._bags.datatype(topic)

    @property
    def topics_by_datatype(self) -> dict[str, list[str]]:
        found: dict[str, list[str]] = {}
        for topic in self._bags.topics:
            found.setdefault(self.get_datatype(topic) or "", []).append(topic)
        return found

    def _get_start_stamp(self) -> genpy.Time | None:
        span = self._bags.span()
        return span[0] if span else None

    def _get_end_stamp(self) -> genpy.Time | None:
        span = self._bags.span()
        return span[1] if span else None

    def stamps(self, topic: str):
        """(n,) s of the messages of a topic, those just recorded included."""
        return self._live[topic] if topic in self._live else self._bags.stamps(topic)

    def get_entries(self, topics, start_stamp, end_stamp):
        """Index entries of ``topics``, one or several, from ``start_stamp`` to ``end_stamp`` (Times), in the order of their stamps."""
        return (entry for _, entry in self._bags.entries(topics, start_stamp, end_stamp))

    def get_entries_with_bags(self, topic, start_stamp, end_stamp):
        """(bag, entry) of ``topic`` from ``start_stamp`` to ``end_stamp`` (Times), in the order of their stamps."""
        return self._bags.entries(topic, start_stamp, end_stamp)

    def get_entry(self, t, topic):
        """(bag, entry) of the topic's last message at or before ``t``."""
        return self._bags.entry(t, topic)

    def get_entry_before(self, t):
        """(bag, entry) of the last message of all before ``t``."""
        return self._bags.entry(t - genpy.Duration(0, 1)) if t.to_nsec() > 0 else (None, None)

    def get_entry_after(self, t):
        """(bag, entry) of the first message of all after ``t``."""
        return self._bags.entry_after(t)

    def read_message(self, bag, position):
        """(topic, message, stamp) at ``position``, that of an index entry of ``bag``."""
        return self._bags.read(bag, position)

    def neighbour(self, topic, direction: int):
        """The entry of ``topic`` (None: of all) before (``direction`` -1) or after (1) the playhead."""
        playhead = self._timeline_frame.playhead
        if playhead is None:
            return None
        if direction > 0:
            return self._bags.entry_after(playhead, topic)[1]
        return self._bags.entry(playhead - genpy.Duration(0, 1), topic)[1] if playhead.to_nsec() > 0 else None

    def update(self) -> None:
        """Draw the time line again; from any thread."""
        self._redraw.emit()

    # Playback

    @property
    def play_speed(self) -> float:
        """Seconds of the bag per second; negative runs back, 0 stands."""
        return self._play_speed

    @play_speed.setter
    def play_speed(self, speed: float) -> None:
        size = min(max(abs(speed), SLOWEST), FASTEST)
        self._play_speed = 0.0 if speed == 0 else size if speed > 0 else -size
        if self._play_speed:
            self.last_speed = self._play_speed
            self._clock.start()
            self._timer.start(_TICK)
        else:
            self._timer.stop()
        self.play_state_changed.emit()

    def toggle_play(self) -> None:
        self.play_speed = 0.0 if self.play_speed else self.last_speed

    def navigate_rewind(self) -> None:
        """Slower, or back and faster back."""
        speed = self.play_speed
        self.play_speed = -1.0 if speed in (0.0, SLOWEST) else speed * 2 if speed < 0 else speed / 2

    def navigate_fastforward(self) -> None:
        """Faster, or less fast back."""
        speed = self.play_speed
        self.play_speed = 1.0 if speed in (0.0, -SLOWEST) else speed / 2 if speed < 0 else speed * 2

    def navigate_start(self) -> None:
        self._timeline_frame.playhead = self._timeline_frame.play_region[0]

    def navigate_end(self) -> None:
        self._timeline_frame.playhead = self._timeline_frame.play_region[1]

    def navigate_previous(self) -> None:
        self._go(self.neighbour(None, -1))

    def navigate_next(self) -> None:
        self._go(self.neighbour(None, 1))

    def _go(self, entry) -> None:
        self.play_speed = 0.0
        if entry is not None:
            self._timeline_frame.playhead = entry.time

    def _tick(self) -> None:
        elapsed = self._clock.restart() / 1000
        if self.play_all and self._player.busy:
            return  # no message is to be lost: wait until those passed are out
        self.step(elapsed)

    def step(self, elapsed: float) -> None:
        """Move the playhead by so many seconds of real time; at the end of the region it begins again."""
        frame = self._timeline_frame
        begin, end = frame.play_region
        if begin is None or end is None or frame.playhead is None:
            return
        target = frame.playhead.to_sec() + elapsed * self.play_speed
        if target > end.to_sec():
            frame.move_playhead(end, True)
            frame.move_playhead(begin, False)
        elif target < begin.to_sec():
            frame.move_playhead(end, False)
        else:
            frame.move_playhead(genpy.Time.from_sec(max(0.0, target)), self.play_speed > 0)

    def playhead_moved(self, begin, end, playing: bool) -> None:
        """The frame tells that the playhead is elsewhere.

        :param begin: where it was, a Time; None: nowhere, or nothing was passed
        :param end: where it is, a Time
        :param playing: all that it passed is published
        """
        self._player.passed(begin if begin is not None else end, end, playing)
        with self._wished:
            self._wish = end
            self._wished.notify()
        self.status_bar_changed_signal.emit()

    # Publishing

    def is_publishing(self, topic: str) -> bool:
        return topic in self._player.topics

    def start_publishing(self, topic: str) -> None:
        self._player.start_publishing(topic)

    def stop_publishing(self, topic: str) -> None:
        self._player.stop_publishing(topic)

    def set_publishing_state(self, start_publishing: bool) -> None:
        """Publish all topics, or none."""
        for topic in self._bags.topics:
            self.start_publishing(topic) if start_publishing else self.stop_publishing(topic)

    # Views

    def add_listener(self, topic: str, listener) -> None:
        """Let ``listener``, a MessageView, follow the playhead through the messages of ``topic``."""
        self._listeners.setdefault(topic, []).append(listener)
        self._shown.pop(topic, None)
        if self._timeline_frame.playhead is not None:
            self.playhead_moved(None, self._timeline_frame.playhead, False)

    def remove_listener(self, topic: str, listener) -> None:
        """``listener`` follows the messages of ``topic`` no longer; nothing happens if it did not."""
        if listener in self._listeners.get(topic, ()):
            self._listeners[topic].remove(listener)

    def has_listeners(self, topic: str) -> bool:
        return bool(self._listeners.get(topic))

    def _all_listeners(self) -> list:
        return [listener for listeners in self._listeners.values() for listener in listeners]

    def _load_views(self) -> None:
        """Reads, in a thread, the messages at the playhead for the views; only the newest wish counts."""
        while True:
            with self._wished:
                self._wished.wait_for(lambda: self._wish is not None or self._over.is_set())
                if self._over.is_set():
                    return
                stamp, self._wish = self._wish, None
            for topic in [topic for topic, listeners in list(self._listeners.items()) if listeners]:
                bag, entry = self._bags.entry(stamp, topic)
                if topic in self._shown and self._shown[topic] is entry:
                    continue
                self._shown[topic] = entry
                try:
                    self._viewed.emit(topic, bag, self._bags.read(bag, entry.position) if entry is not None else None)
                except BagError as error:
                    self.problem.emit(str(error))

    def _show(self, topic: str, bag, details) -> None:
        for listener in list(self._listeners.get(topic, ())):
            if details is None:
                listener.message_cleared()
            else:
                listener.message_viewed(bag, tuple(details)[:3])

    # Files

    def copy_region_to_bag(self, name: str) -> None:
        """Save the messages of the play region, in another thread."""
        start, end = self._timeline_frame.play_region
        if start is None or end is None or self._background is not None and self._background.is_alive():
            return

        def work() -> None:
            try:
                count = copy_region(self._bags, name, start, end, self._report(f"saving {name}"))
                self.problem.emit(f"{name}: {count} messages saved")
            except BagError as error:
                self.problem.emit(str(error))
            self.progress.emit("", 1.0)

        self._background = threading.Thread(target=work, daemon=True)
        self._background.start()

    def _report(self, text: str):
        def report(share: float) -> bool:
            self.progress.emit(text, share)
            return not self._over.is_set()

        return report

    @property
    def recording(self) -> bool:
        return self._recorder is not None

    def record_bag(self, name: str, all: bool = True, topics: tuple[str, ...] = ()) -> None:
        """Record into the file ``name``; it is shown as it grows. What is wrong is told.

        :param all: all topics
        :param topics: those to record if not ``all``
        """
        try:
            self._recorder = Recorder(name, None if all else list(topics), lambda topic, _raw, stamp: self._note(topic, stamp))
        except BagError as error:
            self.problem.emit(str(error))
        self.recording_changed.emit()

    def _note(self, topic: str, stamp) -> None:
        stamps = self._live.get(topic)
        if stamps is None:
            self._live[topic] = list(self._bags.stamps(topic)) + [stamp.to_sec()]
        else:
            stamps.append(stamp.to_sec())
        self._recorded.emit(topic)

    def _message_recorded(self, _topic: str) -> None:
        if self._recorder is not None:
            if self._recorder.problem:
                self.problem.emit(self._recorder.problem)
                self._recorder.problem = ""
            self._timeline_frame.recording_grew()

    def stop_recording(self) -> None:
        """Close the file that is recorded, and show it as any other."""
        recorder, self._recorder = self._recorder, None
        if recorder is None:
            return
        recorder.stop()
        self._live.clear()
        if recorder.counts:
            try:
                self.add_bag(open_bag(recorder.name))
            except BagError as error:
                self.problem.emit(str(error))
        else:
            self.problem.emit(f"{recorder.name} is empty: no message came while it was recorded")
        self._timeline_frame.bags_changed()
        self.recording_changed.emit()

    def handle_close(self) -> None:
        """Stop everything and close the bags."""
        self.play_speed = 0.0
        self._over.set()
        with self._wished:
            self._wished.notify()
        self.stop_recording()
        for listener in self._all_listeners():
            listener.close()
        self._listeners.clear()
        self._player.close()
        if self._background is not None:
            self._background.join(10)
        self._loader.join(5)
        self._timeline_frame.handle_close()
        self._bags.close()
