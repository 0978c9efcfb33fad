"""Images in rqt_bag."""

from rqt_bag.plugins.plugin import Plugin

from rqt_bag_plugins.image_timeline_renderer import ImageTimelineRenderer
from rqt_bag_plugins.image_view import ImageView


class ImagePlugin(Plugin):
    """Raw and compressed images."""

    def get_view_class(self):
        return ImageView

    def get_renderer_class(self):
        return ImageTimelineRenderer

    def get_message_types(self):
        return ["sensor_msgs/Image", "sensor_msgs/CompressedImage"]
