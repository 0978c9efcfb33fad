"""The menu of the time line, and the windows that it opens."""

from __future__ import annotations

from python_qt_binding.QtCore import QSize
from python_qt_binding.QtWidgets import QMenu, QVBoxLayout, QWidget


class TopicPopupWidget(QWidget):
    """A dock with one view of one topic."""

    def __init__(self, name: str, timeline, viewer_type, topic: str):
        super().__init__()
        self.setObjectName(name)
        self.setWindowTitle(f"{topic} [{viewer_type.name}]")
        self.setLayout(QVBoxLayout())
        self._timeline, self._topic = timeline, topic
        self.viewer = viewer_type(timeline, self, topic)
        self._listening = False

    def sizeHint(self) -> QSize:
        return QSize(440, 320)

    def showEvent(self, event) -> None:
        super().showEvent(event)
        if not self._listening:
            self._listening = True
            self._timeline.add_listener(self._topic, self.viewer)

    def hideEvent(self, event) -> None:
        super().hideEvent(event)
        if self._listening:
            self._listening = False
            self._timeline.remove_listener(self._topic, self.viewer)


class TimelinePopupMenu(QMenu):
    """What can be done with a topic, or with all.

    :param popups: windows that are open: name -> TopicPopupWidget; filled here.
    """

    def __init__(self, timeline, topic: str | None, popups: dict, parent=None):
        super().__init__(parent)
        self.timeline, self._frame, self._popups = timeline, timeline._timeline_frame, popups
        self._add(self, "Reset Timeline", self._frame.reset_timeline)
        self._add(self, "Play All Messages", lambda: setattr(timeline, "play_all", not timeline.play_all), timeline.play_all)
        self._add_thumbnails(topic)
        self._add_views(topic)
        self._add_publishing(topic)

    @staticmethod
    def _add(menu: QMenu, text: str, action, checked: bool | None = None) -> None:
        made = menu.addAction(text)
        if checked is not None:
            made.setCheckable(True)
            made.setChecked(checked)
        made.triggered.connect(lambda _checked=False: action())

    def _add_thumbnails(self, topic: str | None) -> None:
        topics = [name for name, _ in self._frame.get_renderers()]
        toggle = lambda name: lambda: self._frame.set_renderer_active(name, not self._frame.is_renderer_active(name))  # noqa: E731
        if topic is None and topics:
            menu = self.addMenu("Thumbnails...")
            self._add(menu, "Show All", lambda: self._frame.set_renderers_active(True))
            self._add(menu, "Hide All", lambda: self._frame.set_renderers_active(False))
            menu.addSeparator()
            for name in topics:
                self._add(menu, name, toggle(name), self._frame.is_renderer_active(name))
        elif topic in topics:
            self._add(self, "Thumbnail", toggle(topic), self._frame.is_renderer_active(topic))

    def _add_views(self, topic: str | None) -> None:
        if topic is not None:
            self._add_viewers(self.addMenu("View"), topic)
            return
        by_topic, by_type = self.addMenu("View (by Topic)"), self.addMenu("View (by Type)")
        for name in self.timeline.topics:
            self._add_viewers(by_topic.addMenu(name), name)
        for datatype, topics in sorted(self.timeline.topics_by_datatype.items()):
            menu = by_type.addMenu(datatype)
            for name in topics:
                self._add_viewers(menu.addMenu(name), name)

    def _add_viewers(self, menu: QMenu, topic: str) -> None:
        for viewer_type in self._frame.get_viewer_types(self.timeline.get_datatype(topic)):
            self._add(menu, viewer_type.name, lambda viewer_type=viewer_type: self.view(topic, viewer_type))

    def view(self, topic: str, viewer_type) -> None:
        """Open a view of ``topic``, or bring it back.

        :param viewer_type: a class derived from MessageView
        """
        name = f"{topic}__{viewer_type.name}"
        if name not in self._popups:
            try:
                popup = TopicPopupWidget(name, self.timeline, viewer_type, topic)
            except Exception as error:  # views of others
                self.timeline.problem.emit(f"the view {viewer_type.name} of {topic} does not open: {type(error).__name__}: {error}")
                return
            self._popups[name] = popup
            self.timeline.get_context().add_widget(popup)
        popup = self._popups[name]
        (popup.parentWidget() or popup).show()
        popup.show()

    def _add_publishing(self, topic: str | None) -> None:
        def toggle(name: str):
            change = self.timeline.stop_publishing if self.timeline.is_publishing(name) else self.timeline.start_publishing
            return lambda: (change(name), self._frame.update())

        if topic is not None:
            self._add(self, "Publish", toggle(topic), self.timeline.is_publishing(topic))
            return
        menu = self.addMenu("Publish...")
        self._add(menu, "Publish All", lambda: (self.timeline.set_publishing_state(True), self._frame.update()))
        self._add(menu, "Publish None", lambda: (self.timeline.set_publishing_state(False), self._frame.update()))
        menu.addSeparator()
        for name in self.timeline.topics:
            self._add(menu, name, toggle(name), self.timeline.is_publishing(name))
