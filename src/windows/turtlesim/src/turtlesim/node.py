"""The node turtlesim: topics and services of the turtles, and the loop that moves them."""

import queue
import random
import sys
import time
from collections.abc import Callable
from concurrent.futures import Future

import node_signals
import rosgraph
import rospy
from geometry_msgs.msg import Twist
from node_signals.display import missing_display
from node_signals.parameters import is_number
from std_srvs.srv import Empty, EmptyResponse

from .msg import Color, Pose
from .srv import (
    Kill,
    KillResponse,
    SetPen,
    SetPenResponse,
    Spawn,
    SpawnResponse,
    TeleportAbsolute,
    TeleportAbsoluteResponse,
    TeleportRelative,
    TeleportRelativeResponse,
)
from .world import SIZE, Turtle, World, WorldError

PERIOD = 16  # ms, of the timer and of the turtles' time
BACKGROUND = {"background_r": 0x45, "background_g": 0x56, "background_b": 0xFF}


class TurtleFace:
    """Topics and services of one turtle name. The turtle may be exchanged: subscribers do not notice a reset."""

    def __init__(self, turtle: Turtle, run, draw):
        """:param run: runs a function in the window's thread and returns its result
        :param draw: takes lines
        """
        name = turtle.name
        self.turtle = turtle
        self._run, self._draw = run, draw
        self._pose = rospy.Publisher(f"{name}/pose", Pose, queue_size=1)
        self._color = rospy.Publisher(f"{name}/color_sensor", Color, queue_size=1)
        self._services = [
            rospy.Service(f"{name}/set_pen", SetPen, self._set_pen),
            rospy.Service(f"{name}/teleport_relative", TeleportRelative, self._teleport_relative),
            rospy.Service(f"{name}/teleport_absolute", TeleportAbsolute, self._teleport_absolute),
        ]
        self._velocity = rospy.Subscriber(f"{name}/cmd_vel", Twist, self._drive, queue_size=1)

    def close(self) -> None:
        for service in self._services:
            service.shutdown("the turtle is gone")
        for end in (self._velocity, self._pose, self._color):
            end.unregister()

    def publish(self, color) -> None:
        turtle = self.turtle
        try:
            self._pose.publish(Pose(turtle.x, turtle.y, turtle.theta, turtle.speed, turtle.command[2]))
            self._color.publish(Color(*color))
        except rospy.ROSException:  # the node is being shut down
            pass

    def _drive(self, twist: Twist) -> None:
        try:
            self.turtle.drive(twist.linear.x, twist.linear.y, twist.angular.z, time.monotonic())
        except WorldError as error:
            rospy.logwarn_throttle(10, str(error))

    def _set_pen(self, request):
        self._run(lambda: self.turtle.set_pen((request.r, request.g, request.b), request.width, bool(request.off)))
        return SetPenResponse()

    def _teleport_absolute(self, request):
        self._run(lambda: self._draw(self.turtle.teleport(request.x, request.y, request.theta)))
        return TeleportAbsoluteResponse()

    def _teleport_relative(self, request):
        self._run(lambda: self._draw(self.turtle.teleport_relative(request.linear, request.angular)))
        return TeleportRelativeResponse()


class TurtleNode:
    """Owns world and window. Everything happens in :meth:`tick`, in the window's thread: services hand it their work."""

    def __init__(self, window_of):
        """:param window_of: makes the window of a World"""
        self._jobs: queue.SimpleQueue[Callable[[], None]] = queue.SimpleQueue()
        self._faces = {}
        self._world = World()
        self.window = window_of(self._world)
        for name, value in BACKGROUND.items():
            if not rospy.has_param("~" + name):
                rospy.set_param("~" + name, value)
        self._paint_background()
        rospy.loginfo("Starting turtlesim with node name %s", rospy.get_name())
        self._spawn("", SIZE / 2, SIZE / 2, 0.0)
        for name, kind, work in (
            ("clear", Empty, self._on_clear),
            ("reset", Empty, self._on_reset),
            ("spawn", Spawn, self._on_spawn),
            ("kill", Kill, self._on_kill),
        ):
            rospy.Service(name, kind, lambda request, work=work: self._run(lambda: work(request)))

    def tick(self) -> None:
        """Requests first, then one step of every turtle."""
        while not self._jobs.empty():
            self._jobs.get()()
        now = time.monotonic()
        for face in self._faces.values():
            turtle = face.turtle
            heading = turtle.theta
            lines, beyond = turtle.step(PERIOD / 1000, now)
            if beyond:  # counted from the top, as it has always been printed
                rospy.logwarn("Oh no! I hit the wall! (Clamping from [x=%f, y=%f])", beyond[0], SIZE - beyond[1])
            face.publish(self.window.color_at((turtle.x, turtle.y)))
            if lines:
                self.window.draw(lines)
            elif turtle.theta != heading or turtle.speed:
                self.window.update()

    def _run(self, work):
        """Runs work() in the next tick and returns what it returns; for the threads of services."""
        done: Future = Future()

        def job():
            try:
                done.set_result(work())
            except BaseException as error:  # whoever waits gets it
                done.set_exception(error)

        self._jobs.put(job)
        try:
            return done.result()
        except WorldError as error:
            rospy.logerr(str(error))
            raise rospy.ServiceException(str(error)) from error

    def _spawn(self, name: str, x: float, y: float, theta: float) -> str:
        if name and (name.startswith("~") or not rosgraph.names.is_legal_name(name)):
            raise WorldError(f"[{name}] is no name for a turtle: letters, digits and _ only, a letter first")
        turtle = self._world.spawn(name, x, y, theta, random.randrange(self.window.picture_count))
        if turtle.name in self._faces:
            self._faces[turtle.name].turtle = turtle
        else:
            self._faces[turtle.name] = TurtleFace(turtle, self._run, self.window.draw)
        self.window.update()
        rospy.loginfo("Spawning turtle [%s] at x=[%f], y=[%f], theta=[%f]", turtle.name, x, y, theta)
        return turtle.name

    def _paint_background(self) -> None:
        def number(name):
            try:
                value = rospy.get_param("~" + name, BACKGROUND[name])
            except (OSError, rosgraph.MasterException):  # the master is gone; the turtles stay
                value = None
            return int(value) if is_number(value) and abs(value) < 2**31 else BACKGROUND[name]

        self.window.clear(*map(number, BACKGROUND))

    def _on_spawn(self, request):
        return SpawnResponse(self._spawn(request.name, request.x, request.y, request.theta))

    def _on_kill(self, request):
        self._world.kill(request.name)
        self._faces.pop(request.name).close()
        self.window.update()
        return KillResponse()

    def _on_clear(self, _request):
        rospy.loginfo("Clearing turtlesim.")
        self._paint_background()
        return EmptyResponse()

    def _on_reset(self, _request):
        rospy.loginfo("Resetting turtlesim.")
        self._world.reset()
        first = self._spawn("", SIZE / 2, SIZE / 2, 0.0)
        for name in [name for name in self._faces if name != first]:
            self._faces.pop(name).close()
        self._paint_background()
        return EmptyResponse()


def main() -> int:
    problem = missing_display()
    if problem:
        print(f"turtlesim_node: {problem}; to run without a window: QT_QPA_PLATFORM=offscreen", file=sys.stderr)
        return 1
    from python_qt_binding.QtCore import Qt, QTimer
    from python_qt_binding.QtWidgets import QApplication

    from .window import TurtleWindow

    application = QApplication(sys.argv[:1])
    node_signals.init_node("turtlesim")
    node = TurtleNode(TurtleWindow)
    timer = QTimer()
    timer.setTimerType(Qt.TimerType.PreciseTimer)

    def tick():
        if rospy.is_shutdown():
            application.quit()
        else:
            node.tick()

    timer.timeout.connect(tick)
    timer.start(PERIOD)
    node.window.show()
    application.exec_() if hasattr(application, "exec_") else application.exec()
    timer.stop()
    return 0
