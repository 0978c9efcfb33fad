"""TF frames of the scene's objects, attached bodies and their subframes."""

from __future__ import annotations

import threading

import rospy
import tf2_ros
from geometry_msgs.msg import TransformStamped
from moveit_core import convert
from node_signals.parameters import number_or

from ..capability import Capability

_RATE, _USUAL = "~planning_scene_frame_publishing_rate", 10.0  # Hz


class TfPublisher(Capability):
    """Publishes at ``~planning_scene_frame_publishing_rate`` (Hz), names prefixed by ``~planning_scene_tf_prefix``, which is
    the node's own name unless it is given."""

    title = "TfPublisher"

    def __init__(self, context):
        super().__init__(context)
        self._rate = number_or(_RATE, rospy.get_param(_RATE, _USUAL), _USUAL)
        if self._rate <= 0:
            rospy.logerr("parameter %s is %g, where a rate above 0 is expected: %g is used", rospy.resolve_name(_RATE), self._rate, _USUAL)
            self._rate = _USUAL
        self._prefix = str(rospy.get_param("~planning_scene_tf_prefix", rospy.get_name())).strip("/")
        self._prefix += "/" if self._prefix else ""
        self._broadcaster = tf2_ros.TransformBroadcaster()
        self._end = threading.Event()
        threading.Thread(target=self._run, name="scene frames", daemon=True).start()

    def shutdown(self) -> None:
        self._end.set()

    def _run(self) -> None:
        while not self._end.wait(1.0 / self._rate) and not rospy.is_shutdown():
            frames = self._frames()
            if frames:
                self._broadcaster.sendTransform(frames)

    def _frames(self) -> list[TransformStamped]:
        scene, now, result = self.context.monitor.copy(), rospy.Time.now(), []
        for name in scene.objects:
            if not name.startswith("<"):
                item = scene.object(name)
                result += self._with_subframes(name, scene.frame, item.pose, item.subframes, now)
        for body in scene.state.attached:
            result += self._with_subframes(body.id, body.link, body.pose, body.subframes, now)
        return result

    def _with_subframes(self, name: str, parent: str, pose, subframes, now) -> list[TransformStamped]:
        frames = [self._frame(parent, self._prefix + name, pose, now)]
        frames += [self._frame(self._prefix + name, f"{self._prefix}{name}/{sub}", where, now) for sub, where in subframes.items()]
        return frames

    @staticmethod
    def _frame(parent: str, child: str, pose, now) -> TransformStamped:
        message = TransformStamped(child_frame_id=child, transform=convert.transform_message(pose))
        message.header.frame_id, message.header.stamp = parent, now
        return message
