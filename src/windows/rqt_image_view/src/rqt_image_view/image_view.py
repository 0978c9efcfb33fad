"""The plugin Image View of rqt."""

from __future__ import annotations

import argparse

import rosgraph
import rosgraph.names
import rospy
from geometry_msgs.msg import Point
from python_qt_binding.QtCore import QTimer, Signal, qWarning
from python_qt_binding.QtWidgets import QFileDialog
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background

from rqt_image_view.canvas import to_qimage
from rqt_image_view.pictures import DepthView
from rqt_image_view.source import ImageSource, image_topics
from rqt_image_view.widget import ImageViewWidget

_LOOK = 2000  # ms between two looks for a topic
_EMPTY = ("nobody publishes images: start a camera or a simulation", "choose a topic in the list above")


class ImageView(Plugin):
    """Pictures of one topic."""

    _arrived = Signal(object, object)  # picture, its source
    _failed = Signal(str, object)

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("ImageView")
        self._source: ImageSource | None = None
        self._background = Background(self)
        self._publisher = None
        self._told = ""
        self._argument = self._parse_args(context.argv()).topic
        self._widget = widget = ImageViewWidget()
        number = context.serial_number()
        widget.setWindowTitle("Image View" + (f" ({number})" if number > 1 else ""))
        context.add_widget(widget)
        self._arrived.connect(self._show)
        self._failed.connect(self._complain)
        widget.canvas.shown.connect(lambda: self._source and self._source.taken())
        widget.canvas.clicked.connect(self._publish_click)
        widget.refresh_button.clicked.connect(lambda: self.update_topics())
        widget.topics.currentTextChanged.connect(self._select)
        widget.depth_changed.connect(self._depth_changed)
        widget.save_button.clicked.connect(lambda: self._save())
        widget.publish_click.toggled.connect(lambda _on: self._advertise())
        widget.click_topic.editingFinished.connect(self._advertise)
        self._select("")
        self.update_topics()
        if self._argument:
            self.select_topic(self._argument)
        self._looking = QTimer(self)  # for a first topic, until one is shown
        self._looking.timeout.connect(self._look_for_the_only_one)
        self._looking.start(_LOOK)
        QTimer.singleShot(0, self._look_for_the_only_one)  # when the settings are there

    def _parse_args(self, argv):
        parser = argparse.ArgumentParser(prog="rqt_image_view", add_help=False)
        ImageView.add_arguments(parser)
        args = parser.parse_args(argv)
        if args.topic:
            args.topic = rosgraph.names.script_resolve_name("rqt_image_view", args.topic)
        return args

    @staticmethod
    def add_arguments(parser) -> None:
        group = parser.add_argument_group("Options for rqt_image_view plugin")
        group.add_argument("topic", nargs="?", default="", help="image topic to show; it need not exist yet")

    # Topics

    def update_topics(self) -> None:
        """List the image topics that there are now; the selected one stays."""
        try:
            names = image_topics()
        except (rosgraph.MasterException, OSError) as error:
            qWarning(f"rqt_image_view: the master does not answer: {error}")
            names = []
        self._widget.list_topics(names)

    def _look_for_the_only_one(self) -> None:
        """With one camera on the graph there is nothing to choose."""
        if self._source is not None:
            self._looking.stop()
        else:
            self._background.run("topics", image_topics, self._choose_the_only_one)

    def _choose_the_only_one(self, names) -> None:
        if self._source is not None:
            return
        self._widget.list_topics(names)
        cameras = [name for name in names if not any(name.startswith(other + "/") for other in names)]
        if len(cameras) == 1:
            self.select_topic(cameras[0])
        else:
            self._widget.canvas.set_picture(None, _EMPTY[bool(names)])

    def select_topic(self, topic: str) -> None:
        """Show a topic, listed or not."""
        self._widget.select_topic(topic)

    def _select(self, topic: str) -> None:
        if self._source is not None:
            self._source.close()
            self._source = None
        self._told = ""
        self._widget.canvas.set_picture(None, f"waiting for {topic}" if topic else _EMPTY[self._widget.topics.count() > 1])
        if topic:
            self._source = source = ImageSource(
                topic, lambda picture: self._arrived.emit(picture, source), lambda text: self._failed.emit(text, source)
            )
            source.depth = self._widget.depth_view()
        if self._widget.suggest_click_topic(topic):
            self._advertise()

    def _show(self, picture, source) -> None:
        if source is self._source:  # else it was on its way when the user chose another topic
            self._widget.canvas.set_picture(picture)

    def _complain(self, text: str, source) -> None:
        if source is self._source:
            self._widget.canvas.set_picture(None, text)
            if text != self._told:
                self._told = text
                qWarning(f"rqt_image_view: {text}")

    def _depth_changed(self, view: DepthView) -> None:
        if self._source is not None:
            self._source.depth = view
            self._source.again()

    # Clicks and files

    def _advertise(self) -> None:
        topic = self._widget.click_topic.text() if self._widget.publish_click.isChecked() else ""
        if self._publisher is not None and self._publisher.name != topic:
            self._publisher.unregister()
            self._publisher = None
        if topic and self._publisher is None:
            try:
                self._publisher = rospy.Publisher(rospy.resolve_name(topic), Point, queue_size=1000)
            except (ValueError, rospy.ROSException) as error:
                qWarning(f"rqt_image_view: clicks cannot be published on '{topic[:60]}': {error}")

    def _publish_click(self, x: int, y: int) -> None:
        if self._publisher is not None:
            self._publisher.publish(Point(float(x), float(y), 0.0))

    def _save(self) -> None:
        picture = self._widget.canvas.final_picture()
        if picture is None:
            return
        name, _ = QFileDialog.getSaveFileName(self._widget, "Save as image", "image.png", "Image (*.bmp *.jpg *.png *.tiff)")
        if name:
            self.save_picture(name)

    def save_picture(self, name: str) -> bool:
        """Write the picture with all its pixels; the end of the name says in which format."""
        picture = self._widget.canvas.final_picture()
        saved = picture is not None and to_qimage(picture).save(name)
        if not saved:
            qWarning(
                f"rqt_image_view: cannot write {name}: use a name that ends with .png, .jpg, .bmp or .tiff, in a folder that may be written"
            )
        return saved

    # Settings

    def save_settings(self, plugin_settings, instance_settings) -> None:
        for key, value in self._widget.settings().items():
            instance_settings.set_value(key, value)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self._widget.restore({key: instance_settings.value(key) for key in self._widget.settings() if instance_settings.contains(key)})
        topic = self._argument or instance_settings.value("topic", "")
        if topic and not self._argument:
            self.select_topic(topic)
        self._advertise()

    def shutdown_plugin(self) -> None:
        self._looking.stop()
        self._background.close()
        if self._source is not None:
            self._source.close()
            self._source = None
        if self._publisher is not None:
            self._publisher.unregister()
