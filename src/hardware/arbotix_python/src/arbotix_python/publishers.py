"""What the driver publishes of its joints and controllers. update() is called often; each has a rate of its own."""

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import JointState

from .parameters import every, number


class DiagnosticsPublisher:
    """diagnostics, at ~diagnostic_rate."""

    def __init__(self):
        self._publisher = rospy.Publisher("diagnostics", DiagnosticArray, queue_size=5)
        self._every = every(number("~diagnostic_rate", 1.0, above=0))

    def update(self, joints, controllers):
        """Publish what `controllers` and `joints` report, if it is time."""
        now = rospy.Time.now()
        if not self._every.due(now.to_nsec()):
            return
        reports = [part.getDiagnostics() for part in [*controllers, *joints]]
        message = DiagnosticArray(status=[report for report in reports if report])
        message.header.stamp = now
        self._publisher.publish(message)


class JointStatePublisher:
    """joint_states, at ~read_rate."""

    def __init__(self):
        self._publisher = rospy.Publisher("joint_states", JointState, queue_size=5)
        self._every = every(number("~read_rate", 10.0, above=0))

    def update(self, joints, controllers):
        """Publish where `joints`, and those of `controllers` that are no servos, are, if it is time."""
        now = rospy.Time.now()
        if not self._every.due(now.to_nsec()):
            return
        message = JointState()
        message.header.stamp = now
        for joint in joints:
            message.name.append(joint.name)
            message.position.append(joint.position)
            message.velocity.append(joint.velocity)
        for controller in controllers:
            message.name += controller.joint_names
            message.position += controller.joint_positions
            message.velocity += controller.joint_velocities
        self._publisher.publish(message)
