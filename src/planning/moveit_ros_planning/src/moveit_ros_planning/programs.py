"""The small programs of upstream's planning_components_tools: each a function that returns the exit code."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from pathlib import Path

import motion
import node_signals
import rospy
from moveit_core import states
from moveit_core.scene_messages import OCTOMAP, SceneEditor
from moveit_msgs.msg import PlanningScene, PlanningSceneComponents, PlanningSceneWorld
from moveit_msgs.srv import GetPlanningScene
from plugin_loader import find_plugins

from . import robot_model, scene_text
from .compiled import exported
from .model_text import model_text

_SERVICE = "get_planning_scene"
_ATTEMPTS = 100  # random states that are tried for one that is wanted


def _program(name: str, run: Callable[[list[str]], int], anonymous: bool = False) -> int:
    """``run`` with the arguments of the command line, as the node ``name``; what goes wrong is one line, and the exit code 1."""
    node_signals.init_node(name, anonymous=anonymous)
    try:
        return run(rospy.myargv()[1:])
    except (robot_model.DescriptionError, motion.MotionError, ValueError, OSError, rospy.ROSException, rospy.ServiceException) as error:
        rospy.logfatal("%s", " ".join(str(error).split()))
        return 1


def _scene_of_move_group(patience: float) -> PlanningScene:
    """All of the scene.

    :param patience: s that the service is waited for.
    :raises ValueError: it is not there.
    """
    try:
        rospy.wait_for_service(_SERVICE, patience)
    except rospy.ROSException:
        raise ValueError(f"nobody offers the service {rospy.resolve_name(_SERVICE)}: have you launched move_group?") from None
    everything = sum(getattr(PlanningSceneComponents, name) for name in dir(PlanningSceneComponents) if name.isupper())
    return rospy.ServiceProxy(_SERVICE, GetPlanningScene)(PlanningSceneComponents(everything)).scene


# --- moveit_print_planning_model_info, moveit_print_planning_scene_info ---


def print_model() -> int:
    """Print the robot of the parameter robot_description."""

    def run(_arguments: list[str]) -> int:
        description = robot_model.load()
        print(model_text(description.model, description.kinematics), flush=True)
        return 0

    return _program("print_model_info_to_console", run, anonymous=True)


def print_scene() -> int:
    """Print what is in move_group's scene."""

    def run(_arguments: list[str]) -> int:
        rospy.loginfo("Getting planning scene info to print")
        print(known_objects(_scene_of_move_group(5.0)), flush=True)
        return 0

    return _program("print_scene_info_to_console", run, anonymous=True)


def known_objects(scene: PlanningScene) -> str:
    """The names of all objects of ``scene``, in the layout of upstream's ``PlanningScene::printKnownObjects``."""
    world = [item.id for item in scene.world.collision_objects] + [OCTOMAP] * bool(scene.world.octomap.octomap.data)
    attached = [body.object.id for body in scene.robot_state.attached_collision_objects]
    bar = "-----------------------------------------"
    lines = [bar, "PlanningScene Known Objects:", "  - Collision World Objects:"]
    lines += [f"\t- {name}" for name in sorted(world)]
    lines += ["  - Attached Bodies:", *(f"\t- {name}" for name in sorted(attached)), bar]
    return "\n".join(lines)


# --- moveit_publish_scene_from_text ---


def publish_scene() -> int:
    """Publish the objects of a ``.scene`` file, with ``--scene`` as a change of the scene, else as its world."""

    def run(arguments: list[str]) -> int:
        whole = len(arguments) > 1 and arguments[0].startswith("--scene")
        file = arguments[1 if whole else 0] if arguments else ""
        if not file or file.startswith("-"):
            raise ValueError("a file name was expected: rosrun moveit_ros_planning moveit_publish_scene_from_text [--scene] FILE.scene")
        model = robot_model.load(meshes=False).model
        try:
            scene = scene_text.read(Path(file).read_text(encoding="utf-8", errors="replace"), model.frame)
        except ValueError as error:
            raise ValueError(f"{file}: {error}") from error
        scene.robot_model_name = model.name
        rospy.loginfo("Publishing geometry from '%s' ...", file)
        if whole:
            return _publish("planning_scene", scene)
        return _publish("planning_scene_world", scene.world)

    return _program("publish_planning_scene", run, anonymous=True)


def _publish(topic: str, message: PlanningScene | PlanningSceneWorld) -> int:
    publisher = rospy.Publisher(topic, type(message), queue_size=1)
    end = time.monotonic() + 50.0
    while publisher.get_num_connections() < 1 and not rospy.is_shutdown():
        if time.monotonic() > end:
            raise ValueError(f"nobody listens to {rospy.resolve_name(topic)}: have you launched move_group?")
        time.sleep(0.05)
    publisher.publish(message)
    time.sleep(1.0)  # what is on its way is lost with the process
    return 0


# --- moveit_display_random_state ---


def display_random_state() -> int:
    """Publish as many random states as a number on the terminal says, one a second."""

    def run(arguments: list[str]) -> int:
        wanted = next((word[2:] for word in arguments if word in ("--valid", "--invalid")), "")
        description = robot_model.load()
        publisher = rospy.Publisher("planning_scene", PlanningScene, queue_size=1)
        while not rospy.is_shutdown():
            print(
                f"Type a number and hit Enter. That number of {wanted + ' ' if wanted else ''}states will be randomly generated at an "
                "interval of one second and published as a planning scene.",
                flush=True,
            )
            line = sys.stdin.readline()
            if not line:
                return 0
            if not line.strip().isdecimal():
                print(f"'{line.strip()[:40]}' is no number of states", flush=True)
                continue
            _show_states(description, publisher, int(line), wanted)
        return 0

    return _program("display_random_state", run)


def _show_states(description: robot_model.RobotDescription, publisher: rospy.Publisher, count: int, wanted: str) -> None:
    scene = robot_model.prepare_scene(description)
    try:
        SceneEditor(scene, rospy.logwarn).planning_scene(_scene_of_move_group(0.5))
    except ValueError:
        rospy.logwarn_once("move_group does not run: the robot is looked at alone")
    for _ in range(count):
        state = random_state(scene, wanted)
        if state is None:
            print(f"Unable to find {wanted} state", flush=True)
            continue
        message = PlanningScene(is_diff=True, robot_model_name=description.model.name)
        message.robot_state = states.robot_state_message(state, attached=False)
        message.robot_state.is_diff = True
        publisher.publish(message)
        print("".join(f"{name}={value:g}\n" for name, value in zip(description.model.variables, state.positions)), flush=True)
        end = time.monotonic() + 1.0
        while time.monotonic() < end and not rospy.is_shutdown():
            time.sleep(0.05)
        if rospy.is_shutdown():
            return


def random_state(scene: motion.PlanningScene, wanted: str = "") -> motion.RobotState | None:
    """A state within the limits.

    :param scene: the robot, and what it may collide with.
    :param wanted: "valid", in collision with nothing; "invalid", in collision; "", either.
    :returns: None where a hundred states were not as wanted.
    """
    state = scene.state
    for _ in range(_ATTEMPTS):
        state.randomize()
        if not wanted or scene.check(state).collision == (wanted == "invalid"):
            return state
    return None


# --- moveit_list_request_adapter_plugins ---


def list_adapters() -> int:
    """Print the request adapters that packages export."""
    _, problems = find_plugins("moveit_core")
    for problem in problems:
        print(problem, file=sys.stderr)
    print("Available planning request adapter plugins:")
    described = {name: plugin.description for name, plugin in exported("adapter").items()}
    described.setdefault("default_planner_request_adapters/AddRuckigTrajectorySmoothing", "Smooths what jerks; of move_group alone.")
    for name, description in sorted(described.items()):
        print(f" \t {name}\n \t\t  {description}\n\n")
    return 0
