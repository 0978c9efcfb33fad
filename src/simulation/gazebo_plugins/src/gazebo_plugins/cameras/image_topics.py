"""An image topic as image_transport offers it: the raw image, and compressed ones beside it with their parameters."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import rospy
from dynamic_parameters import Parameter, Server
from ode_sim_rendering import Frame
from sensor_msgs.msg import CompressedImage

from gazebo_plugins.cameras.image_message import Image

if TYPE_CHECKING:
    from theora_image_transport.publisher import TheoraPublisher

COMPRESSED = (
    Parameter(
        "format", str, "jpeg", description="Compression format", enum={"jpeg": "JPEG lossy compression", "png": "PNG lossless compression"}
    ),
    Parameter("jpeg_quality", int, 80, 1, 100, "JPEG quality percentile"),
    Parameter("png_level", int, 9, 1, 9, "PNG compression level"),
)

COMPRESSED_DEPTH = (
    Parameter("depth_max", float, 10.0, 1.0, 100.0, "Maximum depth value (meter)"),
    Parameter("depth_quantization", float, 100.0, 1.0, 150.0, "Depth value at which the sensor accuracy is 1 m"),
    Parameter("png_level", int, 9, 1, 9, "PNG compression level"),
)


class _NotADepth(rospy.SubscribeListener):
    """``compressedDepth`` of a colour image is offered and stays empty, as image_transport's: this says so once."""

    def __init__(self, encoding: str):
        self._encoding = encoding
        self._said = False

    def peer_subscribe(self, topic_name, topic_publish, peer_publish) -> None:
        if not self._said:
            self._said = True
            rospy.logwarn("%s stays empty: it is for depth images, this one is %s; use compressed", topic_name, self._encoding)


@lru_cache(maxsize=1)
def _theora() -> bool:
    """Whether there can be theora topics; says once why not."""
    try:
        from theora_image_transport.encoder import available
    except ImportError:  # scripts/demo builds without it, for it is compiled against much that the demo does not need
        rospy.loginfo("cameras offer no theora topics: theora_image_transport is not built; scripts/setup builds it")
        return False
    if not available():
        rospy.logwarn("cameras offer no theora topics: PyAV is missing; install python3-av")
        return False
    return True


class ImageTopics:
    """Publishers of one image topic.

    :param topic: absolute name. :param source: output of the render process that is the raw image.
    :param compressible: offer ``<topic>/compressed`` and ``<topic>/theora``.
    :param queue_size: messages kept for a slow subscriber.
    :param encoding: of sensor_msgs/Image. :param shape: (height, width), pixels.
    """

    def __init__(
        self, topic: str, encoding: str, shape: tuple[int, int], queue_size: int, source: str = "image", compressible: bool = True
    ):
        self._source, self._encoding, (self._height, self._width) = source, encoding, shape
        self._raw = rospy.Publisher(topic, Image, queue_size=queue_size)
        self._compressed = self._depth = None
        self._theora: TheoraPublisher | None = None
        self._parameters: tuple[Server, ...] = ()
        if compressible:
            self._settings = f"jpeg:{COMPRESSED[1].default}"
            self._compressed = rospy.Publisher(f"{topic}/compressed", CompressedImage, queue_size=queue_size)
            self._depth = rospy.Publisher(
                f"{topic}/compressedDepth", CompressedImage, queue_size=queue_size, subscriber_listener=_NotADepth(encoding)
            )
            self._parameters = (
                Server(f"{topic}/compressed", COMPRESSED, self._configure),
                Server(f"{topic}/compressedDepth", COMPRESSED_DEPTH, lambda config, level: None),
            )
            if _theora():
                from theora_image_transport.publisher import TheoraPublisher

                self._theora = TheoraPublisher(topic, encoding, shape, queue_size)

    def _configure(self, config: dict, _level: int) -> None:
        kind = config["format"] if config["format"] in ("jpeg", "png") else "jpeg"
        self._settings = f"{kind}:{config['jpeg_quality' if kind == 'jpeg' else 'png_level']}"

    def outputs(self) -> tuple[str, ...]:
        """What somebody listens to now."""
        theora = self._theora is not None and self._theora.wanted()
        wanted: tuple[str, ...] = (self._source,) if theora or self._raw.get_num_connections() else ()
        if self._compressed is not None and self._compressed.get_num_connections():
            wanted += (self._settings,)
        return wanted

    def publish(self, header, frame: Frame) -> None:
        """Publish whatever of this topic is in ``frame``, with ``header``."""
        for name, data in frame.data.items():
            kind = name.partition(":")[0]
            if name == self._source:
                self._raw.publish(Image(header, self._height, self._width, self._encoding, 0, len(data) // self._height, data))
                if self._theora is not None:
                    self._theora.publish(header, data)
            elif kind in ("jpeg", "png") and self._compressed is not None:
                colour = "rgb" in self._encoding or "bgr" in self._encoding
                target = ("bgr16" if kind == "png" and self._encoding.endswith("16") else "bgr8") if colour else ""
                self._compressed.publish(CompressedImage(header, f"{self._encoding}; {kind} compressed {target}", bytes(data)))

    def shutdown(self) -> None:
        for publisher in (self._raw, self._compressed, self._depth):
            if publisher is not None:
                publisher.unregister()
        if self._theora is not None:
            self._theora.shutdown()
        for parameters in self._parameters:
            parameters.shutdown()
