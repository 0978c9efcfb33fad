"""The image at the playhead, in a window of its own."""

from __future__ import annotations

from python_qt_binding.QtCore import QSize, Qt
from python_qt_binding.QtGui import QPixmap
from python_qt_binding.QtWidgets import QGraphicsScene, QGraphicsView
from rqt_bag import TopicMessageView
from rqt_image_view.canvas import to_qimage
from rqt_image_view.pictures import PictureError

from rqt_bag_plugins.image_helper import picture


class _View(QGraphicsView):
    """Fits its scene into the window."""

    def __init__(self, parent):
        super().__init__(parent)
        self.setObjectName("bag_image")

    def sizeHint(self) -> QSize:
        return QSize(320, 240)

    def resizeEvent(self, event) -> None:
        super().resizeEvent(event)
        self.fitInView(self.sceneRect(), Qt.AspectRatioMode.KeepAspectRatio)


class ImageView(TopicMessageView):
    """Shows images; of one that cannot be shown it says why."""

    name = "Image"

    def __init__(self, timeline, parent, topic):
        super().__init__(timeline, parent, topic)
        self._image = None
        self._image_topic = topic
        self._image_stamp = None
        self._image_view = _View(parent)
        self._scene = QGraphicsScene()
        self._image_view.setScene(self._scene)
        parent.layout().addWidget(self._image_view)

    def message_viewed(self, bag, msg_details):
        super().message_viewed(bag, msg_details)
        self.set_image(msg_details[1], msg_details[0], msg_details[2])

    def message_cleared(self):
        self.set_image(None, None, None)

    def set_image(self, image_msg, image_topic, image_stamp):
        """Show ``image_msg``; None shows nothing.

        :param image_topic, image_stamp: where and when it was sent
        """
        self._image_topic, self._image_stamp, self._image = image_topic, image_stamp, None
        text = ""
        if image_msg is not None:
            try:
                self._image = to_qimage(picture(image_msg))
            except PictureError as error:
                text = str(error)
        self.put_image_into_scene(text)

    def put_image_into_scene(self, text: str = ""):
        self._scene.clear()
        if self._image is not None:
            self._scene.addPixmap(QPixmap.fromImage(self._image))
            self._scene.setSceneRect(0, 0, self._image.width(), self._image.height())
        else:
            self._scene.setSceneRect(self._scene.addText(text).boundingRect())
        self._image_view.fitInView(self._scene.sceneRect(), Qt.AspectRatioMode.KeepAspectRatio)
