"""Writes a configuration package: what would be written is known first, and a folder is never left half written."""

from __future__ import annotations

import os
import shutil
import string
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

import rospkg

from moveit_setup_assistant import documents
from moveit_setup_assistant.configuration import MARKER, Configuration
from moveit_setup_assistant.errors import AssistantError, files_told

HAND_MADE_AFTER = 10  # s after the package was written: a file changed later than this was changed by hand

# (path below the package, what it is for). @{robot} is the robot's name.
_LAUNCH_FILES = (
    ("move_group.launch", "starts move_group, the node that plans and moves"),
    ("planning_context.launch", "robot description, groups, limits and solvers for the parameter server"),
    ("moveit_rviz.launch", "opens RViz"),
    ("moveit.rviz", "what RViz shows"),
    ("ompl_planning_pipeline.launch.xml", "planning with OMPL"),
    ("pilz_industrial_motion_planner_planning_pipeline.launch.xml", "industrial motions"),
    ("chomp_planning_pipeline.launch.xml", "planning with CHOMP"),
    ("stomp_planning_pipeline.launch.xml", "planning with STOMP"),
    ("ompl-chomp_planning_pipeline.launch.xml", "CHOMP after OMPL"),
    ("planning_pipeline.launch.xml", "one of the above"),
    ("trajectory_execution.launch.xml", "how motions are executed"),
    ("@{robot}_moveit_controller_manager.launch.xml", "what executes motions, unless another is chosen"),
    ("simple_moveit_controller_manager.launch.xml", "controllers that run already"),
    ("ros_control_moveit_controller_manager.launch.xml", "controllers of ros_control"),
    ("fake_moveit_controller_manager.launch.xml", "pretended controllers"),
    ("sensor_manager.launch.xml", "the octomap"),
    ("@{robot}_moveit_sensor_manager.launch.xml", "sensors that can be pointed"),
    ("demo.launch", "planning without a robot"),
    ("demo_gazebo.launch", "planning for the simulated robot"),
    ("gazebo.launch", "the simulated robot"),
    ("ros_controllers.launch", "starts controllers"),
    ("joystick_control.launch", "a joystick for the goal marker"),
    ("setup_assistant.launch", "edits this package"),
    ("warehouse.launch", "database of scenes"),
    ("warehouse_settings.launch.xml", "where it listens"),
    ("default_warehouse_db.launch", "the database at its usual place"),
    ("run_benchmark_ompl.launch", "compares planners"),
    ("gdb_settings.gdb", "for a debugger"),
)
_DOCUMENTS: dict[str, tuple] = {
    "joint_limits.yaml": (documents.joint_limits, "limits of joints, for planning"),
    "cartesian_limits.yaml": (documents.cartesian_limits, "limits of straight motions"),
    "kinematics.yaml": (documents.kinematics, "which solver finds joint values for a pose"),
    "ompl_planning.yaml": (documents.ompl_planning, "planners"),
    "chomp_planning.yaml": (documents.chomp_planning, "parameters of CHOMP"),
    "stomp_planning.yaml": (documents.stomp_planning, "parameters of STOMP"),
    "fake_controllers.yaml": (documents.fake_controllers, "pretended controllers"),
    "simple_moveit_controllers.yaml": (documents.simple_controllers, "actions that execute motions"),
    "ros_controllers.yaml": (documents.ros_controllers, "controllers of ros_control"),
    "gazebo_controllers.yaml": (documents.gazebo_controllers, "what publishes joint states in simulation"),
    "sensors_3d.yaml": (documents.sensors_3d, "sensors of the surroundings"),
}


class State(Enum):
    """How a file to be written stands to the one on disk."""

    NEW = "new"
    SAME = "unchanged"
    CHANGED = "changed"
    HAND_MADE = "changed by hand"


@dataclass
class PlannedFile:
    """One file of the package: ``path`` below it, its text, what it is for, and whether it is to be written."""

    path: str
    text: str
    purpose: str
    state: State
    write: bool


class _Template(string.Template):
    delimiter = "@"  # launch files are full of $
    pattern = r"""(?P<escaped>@@)|@\{(?P<braced>[a-z_]+)\}|(?P<named>(?!))|(?P<invalid>(?!))"""  # type: ignore[assignment]  # compiled at once


def templates_folder() -> Path:
    """Where the templates are: beside this source tree, or in the installed package."""
    beside = Path(__file__).resolve().parents[2] / "templates"
    return beside if beside.is_dir() else Path(rospkg.RosPack().get_path("moveit_setup_assistant")) / "templates"


@files_told()
def plan(config: Configuration, package: Path) -> list[PlannedFile]:
    """All files of the package that ``config`` makes, compared with those that the folder ``package`` holds now.

    Files that somebody changed by hand are not marked to be written: set ``write`` to overwrite them.

    :raises AssistantError: the folder holds something that no assistant made, or the configuration does not fit the robot.
    """
    package = Path(package)
    refuse_foreign(package)
    texts = _texts(config, package.name)
    return [_compare(package, path, text, purpose, config.generated_timestamp) for path, (text, purpose) in texts.items()]


def write(
    config: Configuration, package: Path, files: list[PlannedFile] | None = None, progress: Callable[[str], None] | None = None
) -> list[str]:
    """Write the package of ``config`` into the folder ``package``; the paths that were written, below it.

    :param files: of :func:`plan`, with ``write`` as wanted; by default all that nobody changed by hand.
    :param progress: called with the path of each file before it is written
    :raises AssistantError: nothing was written, and why.
    """
    package = Path(package)
    problems = config.problems()
    if problems:
        raise AssistantError("; ".join(problems))
    chosen = [file for file in (files if files is not None else plan(config, package)) if file.write]
    timestamp = int(time.time())
    chosen.append(PlannedFile(MARKER, documents.marker(config, timestamp), "", State.NEW, True))
    try:
        package.parent.mkdir(parents=True, exist_ok=True)
        staged = Path(tempfile.mkdtemp(prefix=f".{package.name}.", dir=package.parent))
    except OSError as error:
        raise AssistantError(f"'{package.parent}' cannot be written: {error.strerror}") from error
    try:
        for file in chosen:
            if progress:
                progress(file.path)
            target = staged / file.path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(file.text, encoding="utf-8")
        _move(staged, package, [file.path for file in chosen])
    except OSError as error:
        raise AssistantError(f"'{error.filename or package}' cannot be written: {error.strerror}; the package is as it was") from error
    finally:
        shutil.rmtree(staged, ignore_errors=True)
    config.generated_timestamp = timestamp
    return [file.path for file in chosen]


def _move(staged: Path, package: Path, paths: list[str]) -> None:
    """Put the staged files into place: the whole folder at once if it is new, else file by file, each at once."""
    if not package.exists() or not any(package.iterdir()):
        staged.chmod(0o755)
        if package.exists():
            package.rmdir()
        staged.rename(package)
        return
    for folder in {(package / path).parent for path in paths}:
        folder.mkdir(parents=True, exist_ok=True)
        if not os.access(folder, os.W_OK):
            raise PermissionError(13, "no permission to write", str(folder))
    for path in paths:
        os.replace(staged / path, package / path)


@files_told()
def refuse_foreign(package: Path) -> None:
    """:raises AssistantError: ``package`` cannot become, or is not, a package of an assistant's."""
    if package.exists() and not package.is_dir():
        raise AssistantError(f"'{package}' is a file; name a folder for the package")
    if package.is_dir() and any(package.iterdir()) and not (package / MARKER).is_file():
        raise AssistantError(
            f"'{package}' is not empty and no setup assistant made it; choose another folder, so that nothing in it is overwritten"
        )
    if not package.name.replace("_", "").replace("-", "").isalnum() or not package.name[0].isalpha():
        raise AssistantError(f"'{package.name}' cannot be the name of a package; use letters, digits and _, a letter first")


def _compare(package: Path, path: str, text: str, purpose: str, timestamp: int) -> PlannedFile:
    on_disk = package / path
    if not on_disk.is_file():
        return PlannedFile(path, text, purpose, State.NEW, True)
    if on_disk.read_text(encoding="utf-8", errors="replace") == text:
        return PlannedFile(path, text, purpose, State.SAME, False)
    by_hand = on_disk.suffix == ".xacro" or abs(on_disk.stat().st_mtime - timestamp) > HAND_MADE_AFTER  # no assistant writes macros
    return PlannedFile(path, text, purpose, State.HAND_MADE if by_hand else State.CHANGED, not by_hand)


def _texts(config: Configuration, package: str) -> dict[str, tuple]:
    """Path -> (text, purpose) of every file."""
    values = _values(config, package)
    folder = templates_folder()

    def filled(name: str) -> str:
        return _Template((folder / f"{name}.in").read_text(encoding="utf-8")).substitute(values)

    texts = {
        "package.xml": (filled("package.xml"), "name and dependencies"),
        "CMakeLists.txt": (filled("CMakeLists.txt"), "build"),
        config.srdf_file: (config.semantics.to_text(), "groups, poses, end effectors, collisions that need no check"),
    }
    if config.gazebo_urdf:
        texts[f"config/gazebo_{config.robot.name}.urdf"] = (config.gazebo_urdf, "the robot as it is simulated")
    texts.update({f"config/{name}": (document(config), purpose) for name, (document, purpose) in _DOCUMENTS.items()})
    for name, purpose in _LAUNCH_FILES:
        texts[f"launch/{name.replace('@{robot}', config.robot.name)}"] = (filled(f"launch/{name.replace('@{robot}', 'robot')}"), purpose)
    return texts


def _values(config: Configuration, package: str) -> dict[str, str]:
    model, source = config.model(), config.source
    frames = [v for v in config.semantics.virtual_joints if v.child_link == model.root_link]
    return {
        "package": package,
        "robot": config.robot.name,
        "author_name": escape(config.author_name),
        "author_email": escape(config.author_email, {'"': "&quot;"}),
        "srdf_file": config.srdf_file,
        "description_depend": f"  <run_depend>{source.package}</run_depend>\n" if source.package else "",
        "urdf_attribute": _load_attribute(source),
        "gazebo_urdf_attribute": (
            f'textfile="$(find {package})/config/gazebo_{config.robot.name}.urdf"' if config.gazebo_urdf else _load_attribute(source)
        ),
        "planning_frame": frames[0].parent_frame if frames else model.frame,
        "virtual_joints": "".join(
            f'  <node pkg="tf2_ros" type="static_transform_publisher" name="virtual_joint_broadcaster_{index}"\n'
            f'        args="0 0 0 0 0 0 {virtual.parent_frame} {virtual.child_link}"/>\n'
            for index, virtual in enumerate(v for v in config.semantics.virtual_joints if v.parent_frame != v.child_link)
        ),
        "kinematics_files": "".join(
            f'    <rosparam command="load" ns="{name}" file="{entry.parameters_file}"/>\n'
            for name, entry in config.kinematics.items()
            if entry.parameters_file
        ),
        "initial_joints": "".join(f" -J {joint} {value:g}" for joint, value in _initial_joints(config).items()),
        "ros_controllers": " ".join(c.name for c in config.controllers if not c.is_action),
    }


def _load_attribute(source) -> str:
    """The attribute of a launch file's <param> that loads the description."""
    where = f"$(find {source.package})/{source.relative_path}" if source.package else source.relative_path
    if source.is_xacro:
        return "command=" + quoteattr(f"xacro {source.xacro_args + ' ' if source.xacro_args else ''}'{where}'")
    return "textfile=" + quoteattr(where)


def _initial_joints(config: Configuration) -> dict[str, float]:
    """Joint values of the first pose of each group."""
    seen: set[str] = set()
    values: dict[str, float] = {}
    for state in config.semantics.group_states:
        if state.group not in seen:
            seen.add(state.group)
            values.update({joint.name: joint.value[0] for joint in state.joints if joint.value})
    return values
