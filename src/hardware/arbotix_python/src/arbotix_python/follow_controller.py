"""A chain of joints that follows trajectories: action and topic."""

import actionlib
import rospy
from control_msgs.msg import FollowJointTrajectoryAction
from trajectory_msgs.msg import JointTrajectory

from .controllers import Controller, status
from .parameters import ParameterError, names, number, usable

SUCCEEDED, PREEMPTED = "succeeded", "preempted"


class FollowController(Controller):
    def __init__(self, device, name):
        super().__init__(device, name)
        prefix = "~controllers/%s/" % name
        self._rate = number(prefix + "rate", 50.0, above=0)
        self._joints = names(prefix + "joints")
        for joint in self._joints:
            if joint not in device.joints:
                raise ParameterError(
                    "joint %s of %s is not among the joints %s" % (joint, rospy.resolve_name(prefix + "joints"), sorted(device.joints))
                )
            device.joints[joint].controller = self
        self._executing = False
        self._server = actionlib.SimpleActionServer(
            rospy.get_param(prefix + "action_name", "follow_joint_trajectory"),
            FollowJointTrajectoryAction,
            execute_cb=self._goal,
            auto_start=False,
        )
        rospy.Subscriber(name + "/command", JointTrajectory, self._command)
        rospy.loginfo(
            "Started FollowController (%s). Joints: %s on C%s",
            name,
            self._joints,
            rospy.get_param(prefix + "index", len(device.controllers)),
        )

    def startup(self):
        self._server.start()

    def active(self):
        return self._server.is_active() or self._executing

    def diagnostics(self):
        return status(self.name, State="Active" if self.active() else "Not Active")

    def _problem(self, trajectory):
        """What is wrong with a trajectory, or ""."""
        missing = [joint for joint in self._joints if joint not in trajectory.joint_names]
        if missing:
            return "the trajectory lacks the joints %s" % missing
        if not trajectory.points:
            return "the trajectory has no points"
        if any(len(point.positions) != len(trajectory.joint_names) for point in trajectory.points):
            return "a point of the trajectory does not have one position per joint"
        if not all(usable(*point.positions) for point in trajectory.points):
            return "a position of the trajectory is no number"
        times = [rospy.Duration(), *(point.time_from_start for point in trajectory.points)]
        if any(later < earlier for earlier, later in zip(times, times[1:])):
            return "the points of the trajectory are not in the order of their times"
        return ""

    def _goal(self, goal):
        problem = self._problem(goal.trajectory)
        if problem:
            rospy.logerr("%s: %s.", self.name, problem)
            self._server.set_aborted(text=problem)
            return
        extra = sorted(set(goal.trajectory.joint_names) - set(self._joints))
        if extra:
            rospy.logwarn("%s: joints that are not mine are ignored: %s", self.name, extra)
        if self._follow(goal.trajectory) == SUCCEEDED:
            self._server.set_succeeded()
        else:
            self._server.set_preempted(text="Goal canceled.")

    def _command(self, trajectory):
        problem = "an action is being executed" if self._server.is_active() else self._problem(trajectory)
        if problem:
            rospy.logwarn("%s: trajectory dropped, %s.", self.name, problem)
            return
        self._executing = True
        try:
            self._follow(trajectory)
        finally:
            self._executing = False

    def _follow(self, trajectory):
        """Straight lines from point to point, from where the joints are. Returns SUCCEEDED or PREEMPTED."""
        start = trajectory.header.stamp if trajectory.header.stamp else rospy.Time.now()
        servos = [self.device.joints[joint] for joint in self._joints]
        places = [trajectory.joint_names.index(joint) for joint in self._joints]
        rate = rospy.Rate(self._rate)
        begin, last = start, [servo.position for servo in servos]
        for point in trajectory.points:
            end, goal = start + point.time_from_start, [point.positions[place] for place in places]
            arrived = False
            while not arrived:
                if self._server.is_preempt_requested() or rospy.is_shutdown():
                    return PREEMPTED
                now = rospy.Time.now()
                arrived = now >= end
                if now >= begin or arrived:
                    share = 1.0 if arrived else (now - begin).to_sec() / (end - begin).to_sec()
                    for servo, origin, target in zip(servos, last, goal):
                        servo.go_to(origin + share * (target - origin))
                if not arrived:
                    rate.sleep()
            begin, last = end, goal
        return SUCCEEDED
