"""Thumbnails of images on the time line."""

from __future__ import annotations

import cv2
import genpy
from python_qt_binding.QtCore import QRectF, Qt
from python_qt_binding.QtGui import QColor
from rqt_bag import TimelineCache, TimelineRenderer
from rqt_bag.bags import BagError
from rqt_image_view.canvas import to_qimage
from rqt_image_view.pictures import PictureError

from rqt_bag_plugins.image_helper import picture

_GAP = 6  # px, below the pictures
_NEAR = 20.0  # px: a picture this far away will do while the right one is loaded


class ImageTimelineRenderer(TimelineRenderer):
    """Draws small pictures side by side; they are loaded in another thread."""

    def __init__(self, timeline, thumbnail_height=160):
        super().__init__(timeline, msg_combine_px=40.0)
        self.thumbnail_height = thumbnail_height
        self.thumbnail_cache = TimelineCache(self._load, lambda topic, stamp, image: self.timeline.scene().update())

    def get_segment_height(self, topic):
        return self.thumbnail_height

    def draw_timeline_segment(self, painter, topic, stamp_start, stamp_end, x, y, width, height):
        frame, top, tall = self.timeline, y + 1, height - 2 - _GAP
        painter.fillRect(QRectF(x, y, width, height - _GAP), QColor("white"))
        threshold = max(0.1, frame.map_dx_to_dstamp(_NEAR))
        at, wide = x + 1, tall
        while at == x + 1 or at < x + width - 8:
            stamp = frame.map_x_to_stamp(at, clamp_to_visible=False)
            image = self.thumbnail_cache.get_item(topic, stamp, threshold)
            if image is None:
                self.thumbnail_cache.enqueue((topic, stamp, threshold, (tall,)))
            else:
                wide = image.width()
                shown = min(wide, max(8, x + width - at)) if width > 1 else wide
                painter.drawImage(QRectF(at, top, shown, tall), image, QRectF(0, 0, shown, image.height()))
            at += max(8, wide)
        painter.setPen(QColor("black"))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(QRectF(x, y, width if width > 1 else at - x, height - _GAP - 1))
        return True

    def close(self):
        self.thumbnail_cache.stop()
        self.thumbnail_cache.join(5)

    def _load(self, topic, stamp, details):
        """(stamp, QImage) of the message at ``stamp`` (s)."""
        timeline = self.timeline.scene()
        bag, entry = timeline.get_entry(genpy.Time.from_sec(max(0.0, stamp)), topic)
        if entry is None:
            return None, None
        try:
            _, message, t = timeline.read_message(bag, entry.position)[:3]
            pixels = picture(message)
        except (BagError, PictureError) as error:
            timeline.problem.emit(f"no thumbnails of {topic}: {error}")
            self.timeline.set_renderer_active(topic, False)
            return None, None
        tall = details[0]
        wide = max(8, min(8 * tall, round(tall * pixels.shape[1] / pixels.shape[0])))
        # By the stamp that was asked for: at that place it is drawn, and must be found again.
        return genpy.Time.from_sec(max(0.0, stamp)), to_qimage(cv2.resize(pixels, (wide, tall), interpolation=cv2.INTER_AREA))
