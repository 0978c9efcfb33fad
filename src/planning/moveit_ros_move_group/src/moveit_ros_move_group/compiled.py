"""Compiled capabilities: they live in a process beside move_group, which is started and ended here.

That process has a scene of its own. Every change of move_group's scene is told to it, and it tells move_group what a capability has
changed in its own (``core/shared_scene.hpp``).
"""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Sequence

import roslib.packages
import rospy
from moveit_msgs.msg import PlanningScene
from moveit_msgs.srv import ApplyPlanningScene
from moveit_ros_planning.compiled import exported
from moveit_ros_planning.scene_monitor import GEOMETRY, SCENE, SceneMonitor
from node_signals.children import end_with_parent

from .capability import Capability, serve
from .context import Context

_PROGRAM = "move_group_capabilities"
_PATIENCE = 5.0  # s that the process gets to end
#: What is published below the node's own name: everybody looks for it below move_group's.
_TOPICS = ("display_planned_path", "display_contacts", "motion_plan_request", "fake_controller_joint_states")


class CompiledCapability(Capability):
    """A line of the list of capabilities."""

    def __init__(self, context: Context, title: str):
        super().__init__(context)
        self.title = title


class SceneFeed:
    """Publishes the whole scene after every change, as soon as possible; the newest alone if they come too fast.

    The process numbers its changes, and each scene says which of them was the last that it holds: in a header that nobody else fills in.
    """

    def __init__(self, monitor: SceneMonitor, node: str):
        self._monitor = monitor
        self._publisher = rospy.Publisher(f"{node}/planning_scene", PlanningScene, queue_size=1, latch=True)
        self._service = serve(f"{node}/apply_planning_scene", ApplyPlanningScene, self._apply)
        self._changed, self._over = threading.Event(), False
        self._holds = 0
        monitor.on_change(self._on_change)
        self._changed.set()
        threading.Thread(target=self._run, name="scene of compiled capabilities", daemon=True).start()

    def _apply(self, request, response) -> None:
        header = request.scene.robot_state.joint_state.header
        number, header.seq = header.seq, 0
        response.success = self._monitor.apply(request.scene)
        self._holds = number
        self._changed.set()  # what was published meanwhile had the number before

    def _on_change(self, kinds: int) -> None:
        if kinds & (GEOMETRY | SCENE):
            self._changed.set()

    def _run(self) -> None:
        while self._changed.wait() and not self._over:
            self._changed.clear()
            holds = self._holds
            scene = self._monitor.message()
            scene.robot_state.joint_state.header.seq = holds
            with contextlib.suppress(rospy.ROSException):  # shutting down
                self._publisher.publish(scene)

    def shutdown(self) -> None:
        self._monitor.off_change(self._on_change)
        self._over = True
        self._changed.set()


class CompiledCapabilities:
    """The process, and what it could load.

    :param names: classes as ``~capabilities`` names them; each is loaded, or an error of the log says why not
    """

    def __init__(self, context: Context, names: Sequence[str]):
        self.capabilities: list[CompiledCapability] = []
        self._ending = False
        name = rospy.get_name() + "_capabilities"
        self._feed = SceneFeed(context.monitor, name)
        rospy.set_param(name, rospy.get_param(rospy.get_name(), {}))  # plugins read their parameters below their node's own name
        reading, writing = os.pipe()
        command = [_program(), *_arguments(context, writing, names), *_remappings(name)]
        # In a session of its own: Ctrl-C is for move_group, which ends it.
        self._process = subprocess.Popen(command, pass_fds=(writing,), start_new_session=True, preexec_fn=end_with_parent)
        os.close(writing)
        self._read(context, reading, set(names))
        threading.Thread(target=self._watch, name="compiled capabilities", daemon=True).start()

    def _read(self, context: Context, reading: int, missing: set[str]) -> None:
        with os.fdopen(reading, encoding="utf-8", errors="replace") as report:
            for line in report:
                name, _, text = line[1:].rstrip("\n").partition("\t")
                missing.discard(name)
                if line[0] == "+":
                    self.capabilities.append(CompiledCapability(context, text))
                else:
                    _complain(name, text)
        for name in sorted(missing):
            _complain(name, "its process has ended before it was loaded")

    def _watch(self) -> None:
        code = self._process.wait()
        if not self._ending and not rospy.is_shutdown() and self.capabilities:
            titles = ", ".join(capability.title for capability in self.capabilities)
            how = f"by {signal.Signals(-code).name}" if code < 0 else f"with exit code {code}"
            rospy.logerr("the process of the compiled capabilities has ended %s: gone are %s. Start move_group again", how, titles)

    def shutdown(self) -> None:
        """End the process."""
        self._ending = True
        self._feed.shutdown()
        self._process.terminate()
        try:
            self._process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


def _program() -> str:
    found = roslib.packages.find_node("moveit_ros_move_group", _PROGRAM)
    if not found:
        raise RuntimeError(f"the program {_PROGRAM} is not built: catkin build moveit_ros_move_group")
    return found[0]


def _arguments(context: Context, report: int, names: Sequence[str]) -> list[str]:
    arguments = ["--move-group", rospy.get_name(), "--report", str(report), "--default", context.pipelines.default]
    planners = exported("planner")  # those of Python alone are left out
    for name, pipeline in context.pipelines.pipelines.items():
        if pipeline.plugin in planners:
            arguments += ["--pipeline", name]
    if context.execution is not None:
        arguments.append("--execute")
    if context.debug:
        arguments.append("--debug")
    return [*arguments, *names]


def _remappings(name: str) -> list[str]:
    """Those of move_group, and its name for what others listen to."""
    given = [word for word in sys.argv[1:] if ":=" in word and not word.startswith("__")]
    topics = [f"~{topic}:={rospy.get_name()}/{topic}" for topic in _TOPICS]
    return [*given, *topics, f"__ns:={rospy.get_namespace()}", f"__name:={name.rpartition('/')[2]}"]


def _complain(name: str, text: str) -> None:
    rospy.logerr("Exception while loading move_group capability '%s': %s", name, text)
