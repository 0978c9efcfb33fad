"""The node joystick_relay: a joystick's twists in [-1, 1], scaled in steps, let through while the joystick has priority."""

import threading

import actionlib
import node_signals
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Bool
from twist_mux_msgs.msg import JoyPriorityAction, JoyPriorityResult, JoyTurboAction, JoyTurboResult
from visualization_msgs.msg import Marker


class Steps:
    """A speed that grows from ``low`` to ``high`` in ``count`` steps (the first is 1)."""

    def __init__(self, low: float, high: float, count: int):
        if not (low > 0 and high > 0 and count > 0):
            raise ValueError(f"speeds and steps must be above zero, not {low} to {high} in {count}")
        self._low, self._increment = low, (high - low) / (count - 1) if count > 1 else 0.0

    def __call__(self, share: float, step: int) -> float:
        return share * (self._low + self._increment * (step - 1))


class Turbo:
    """Parameters of ``~turbo/``: steps, init_step, and <kind>_min and _max of the four speeds."""

    def __init__(self, parameters: dict):
        self.count = int(parameters.get("steps", 1))

        def steps(kind: str, low: float = 1.0, high: float = 1.0) -> Steps:
            return Steps(float(parameters.get(kind + "_min", low)), float(parameters.get(kind + "_max", high)), self.count)

        self._forward = steps("linear_forward")
        self._backward = steps("linear_backward", parameters.get("linear_forward_min", 1.0), parameters.get("linear_forward_max", 1.0))
        self._lateral, self._angular = steps("linear_lateral"), steps("angular")
        middle = (self.count + 1) // 2
        first = int(parameters.get("init_step", middle))
        if not 1 <= first <= self.count:
            rospy.logwarn("Initial step %d outside range [1, %d]! Falling back to default %d", first, self.count, middle)
            first = middle
        self._first = first
        self.reset()

    def reset(self) -> None:
        self._linear_step = self._angular_step = self._first

    def change(self, by: int) -> None:
        """``by`` steps faster or, below 0, slower."""
        self._linear_step = min(max(self._linear_step + by, 1), self.count)
        self.change_angular(by)

    def change_angular(self, by: int) -> None:
        """``by`` steps faster or, below 0, slower in turning."""
        self._angular_step = min(max(self._angular_step + by, 1), self.count)

    def scale(self, twist: Twist) -> Twist:
        """In m/s and rad/s; zero if the joystick's twist is none of a base, or leaves [-1, 1]."""
        scaled = Twist()
        x, y, yaw = twist.linear.x, twist.linear.y, twist.angular.z
        if twist.linear.z or twist.angular.x or twist.angular.y:
            rospy.logerr("Joystick provided invalid values, only linear.x, linear.y and angular.z may be non-zero.")
        elif not max(abs(x), abs(y), abs(yaw)) <= 1.0:
            rospy.logerr("Joystick provided invalid values (%g, %g, %g), not in [-1, 1] range.", x, y, yaw)
        else:
            scaled.linear.x = (self._forward if x >= 0 else self._backward)(x, self._linear_step)
            scaled.linear.y = self._lateral(y, self._linear_step)
            scaled.angular.z = self._angular(yaw, self._angular_step)
        return scaled


class Relay:
    def __init__(self, turbo: Turbo):
        self._lock = threading.Lock()
        self._turbo, self._priority = turbo, bool(rospy.get_param("~priority", True))
        self._marker = rospy.Publisher("text_marker", Marker, queue_size=1, latch=True)
        self._out = rospy.Publisher("joy_vel_out", Twist, queue_size=1)
        self._told = rospy.Publisher("joy_priority", Bool, queue_size=1, latch=True)
        self._tell()
        rospy.Subscriber("joy_vel_in", Twist, self._take, queue_size=1)
        self._servers = [
            _serve("joy_priority_action", JoyPriorityAction, JoyPriorityResult, self._toggle),
            *(
                _serve("joy_turbo_" + name, JoyTurboAction, JoyTurboResult, change)
                for name, change in (
                    ("increase", lambda: turbo.change(1)),
                    ("decrease", lambda: turbo.change(-1)),
                    ("angular_increase", lambda: turbo.change_angular(1)),
                    ("angular_decrease", lambda: turbo.change_angular(-1)),
                    ("reset", turbo.reset),
                )
            ),
        ]

    def _take(self, twist: Twist) -> None:
        with self._lock:
            if self._priority:
                self._out.publish(self._turbo.scale(twist))

    def _toggle(self) -> None:
        with self._lock:
            self._priority = not self._priority
            rospy.loginfo("Toggled joy_priority, current status is: %s", self._priority)
            self._tell()
            if self._priority:
                self._out.publish(Twist())  # nothing goes on from before

    def _tell(self) -> None:
        self._told.publish(self._priority)
        marker = Marker(type=Marker.TEXT_VIEW_FACING, action=Marker.ADD, text="Manual" if self._priority else "Autonomous")
        marker.header.frame_id = "base_footprint"
        marker.pose.position.z, marker.pose.orientation.w, marker.scale.z = 2.0, 1.0, 0.5
        marker.color.r = marker.color.g = marker.color.b = marker.color.a = 1.0
        self._marker.publish(marker)


def _serve(name: str, action, result, change):
    def done(_goal) -> None:
        change()
        server.set_succeeded(result())

    server = actionlib.SimpleActionServer(name, action, done, auto_start=False)
    server.start()
    return server


def main() -> int:
    node_signals.init_node("joystick_relay")
    try:
        turbo = Turbo(rospy.get_param("~turbo", {}))
    except (AttributeError, TypeError, ValueError) as error:
        rospy.logfatal("parameter %s: %s", rospy.resolve_name("~turbo"), error)
        return 1
    relay = Relay(turbo)  # noqa: F841  its callbacks need it
    node_signals.spin()
    return 0
