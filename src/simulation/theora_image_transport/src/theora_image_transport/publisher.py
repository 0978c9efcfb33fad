"""``<image topic>/theora`` with its dynamic_reconfigure parameters."""

from __future__ import annotations

import rospy
from dynamic_parameters import Parameter, Server

from theora_image_transport import encoder
from theora_image_transport.msg import Packet

_BITRATE, _QUALITY = 0, 1
PARAMETERS = (
    Parameter(
        "optimize_for",
        int,
        _QUALITY,
        0,
        1,
        "Aim at a bit rate or at a quality",
        enum={_BITRATE: "Aim at target_bitrate", _QUALITY: "Keep quality"},
    ),
    Parameter("target_bitrate", int, 800000, 0, 99200000, "Bit rate to aim at, bit/s, when optimize_for is 0"),
    Parameter("quality", int, 31, 0, 63, "Quality to keep, 63 is the best, when optimize_for is 1"),
    Parameter("keyframe_frequency", int, 64, 1, 64, "Largest distance of key frames, pictures"),
)
_HEADERS = 4  # places in the queue beside the pictures: a stream without its headers cannot be read


class TheoraPublisher(rospy.SubscribeListener):
    """Encodes while somebody listens. A new subscriber or parameter starts a new stream for all: headers, key frame.

    :param topic: absolute name of the raw image. :param encoding: of sensor_msgs/Image; one that Theora cannot carry
        leaves the topic empty, which is said once, to the first who subscribes.
    :param shape: (height, width), pixels.
    """

    def __init__(self, topic: str, encoding: str, shape: tuple[int, int], queue_size: int):
        self._topic, self._encoding, self._shape = f"{topic}/theora", encoding, shape
        self._settings = encoder.Settings()
        self._encoder: encoder.Encoder | None = None
        self._restart, self._silent, self._said = True, encoding not in encoder.ENCODINGS, False
        self._publisher = rospy.Publisher(self._topic, Packet, queue_size=queue_size + _HEADERS, subscriber_listener=self)
        self._parameters = Server(self._topic, PARAMETERS, self._configure)

    def wanted(self) -> bool:
        """Somebody listens, and there can be a stream."""
        return not self._silent and self._publisher.get_num_connections() > 0

    def publish(self, header, data) -> None:
        """Encode one picture, ``data``, rows without gaps, and publish it with ``header``; always from the same thread."""
        if not self.wanted():
            return
        try:
            if self._restart or self._encoder is None:
                self._restart = False  # first: a wish that comes from now on starts one more stream
                self._encoder = encoder.Encoder(self._shape, self._encoding, self._settings)
                self._send(header, self._encoder.headers)
            self._send(header, self._encoder.encode(data))
        except (ValueError, ImportError) as error:
            self._silent = True
            rospy.logerr("%s stays empty until its parameters change: %s", self._topic, error)

    def shutdown(self) -> None:
        self._publisher.unregister()
        self._parameters.shutdown()

    def peer_subscribe(self, topic_name, topic_publish, peer_publish) -> None:
        """rospy tells of a new subscriber: ``topic_name`` is the topic, ``topic_publish`` and ``peer_publish`` send to all and to it."""
        self._restart = True
        if self._encoding not in encoder.ENCODINGS and not self._said:
            self._said = True
            rospy.logwarn(
                "%s stays empty: it is for %s images, this one is %s; use the raw image",
                topic_name,
                ", ".join(encoder.ENCODINGS),
                self._encoding,
            )

    def _configure(self, config: dict, _level: int) -> None:
        self._settings = encoder.Settings(
            config["target_bitrate"] if config["optimize_for"] == _BITRATE else None, config["quality"], config["keyframe_frequency"]
        )
        self._silent = self._encoding not in encoder.ENCODINGS
        self._restart = True

    def _send(self, header, packets) -> None:
        for packet in packets:
            self._publisher.publish(Packet(header, packet.data, packet.b_o_s, 0, packet.granulepos, packet.packetno))
