"""What is known of a package, or a program of one, that a launch file names and that is not there: one line, not all folders searched."""

from __future__ import annotations

import glob
import os
import re
from pathlib import Path

import rospkg
from catkin.find_in_workspaces import find_in_workspaces

_DEBIAN_RULES = Path("/usr/share/python3-rosdep2/debian.yaml")
_UNKNOWN = "Is it built in your workspace, and that sourced? `rosdep resolve {name}` says whether Debian has it."

#: Programs that packages of Noetic no longer have, and what they are called.
_RENAMED = {("robot_state_publisher", "state_publisher"): "robot_state_publisher"}
_IKFAST = (
    "IKFast's generator is not supplied. A plugin package that it made elsewhere builds and is loaded here; else name "
    "kdl_kinematics_plugin/KDLKinematicsPlugin or a TRAC-IK in kinematics.yaml"
)
_BENCH = "It is not supplied; scripts/bench motion of this workspace measures planning, kinematics and collision checks"
_EXAMPLE = "It is not supplied: it only shows how a class is used"
#: Programs of upstream that are not supplied, and what takes their place.
_IN_PLACE_OF = {
    ("moveit_kinematics", "create_ikfast_moveit_plugin.py"): _IKFAST,
    ("moveit_kinematics", "auto_create_ikfast_moveit_plugin.sh"): _IKFAST,
    ("moveit_kinematics", "round_collada_numbers.py"): _IKFAST,
    ("moveit_planners_ompl", "moveit_generate_state_database"): "It is not supplied: planning with path constraints needs no database here",
    ("moveit_ros_occupancy_map_monitor", "moveit_ros_occupancy_map_server"): (
        "It is not supplied: move_group keeps the octomap of the sensors in sensors_3d.yaml, "
        "and publishes move_group/monitored_planning_scene"
    ),
    ("moveit_ros_planning", "demo_scene"): _EXAMPLE,
    ("moveit_ros_planning", "moveit_compare_collision_checking_speed_fcl_bullet"): "There is one collision detector here, FCL",
    ("moveit_ros_planning", "moveit_evaluate_collision_checking_speed"): _BENCH,
    ("moveit_ros_planning", "moveit_evaluate_state_operations_speed"): _BENCH,
    ("moveit_ros_planning", "moveit_kinematics_speed_and_validity_evaluator"): _BENCH,
    ("moveit_ros_planning", "moveit_visualize_robot_collision_volume"): (
        "It is not supplied: RViz's RobotModel shows the shapes that collide with 'Collision Enabled'"
    ),
}
_MOST_NAMED = 12
#: Files that rosrun is given and that are no programs: what they are, and what takes them.
_NO_PROGRAMS = {
    ".launch": "a launch file: roslaunch {package} {name}",
    ".launch.py": "a launch file of ROS 2; this is ROS 1, whose end with .launch",
    ".test": "a test: rostest {package} {name}",
    ".world": "a world: roslaunch gazebo_ros empty_world.launch world_name:={path}",
    ".rviz": "a configuration of RViz: rviz -d {path}",
    ".urdf": "a robot description: check_urdf {path}; into a simulation: rosrun gazebo_ros spawn_model -urdf -file {path} -model NAME",
    ".xacro": "a robot description: xacro {path} writes it as URDF",
    ".sdf": "a model: rosrun gazebo_ros spawn_model -sdf -file {path} -model NAME",
    ".msg": "a message type: rosmsg show {package}/{stem}",
    ".srv": "a service type: rossrv show {package}/{stem}",
    ".action": "an action type: rosmsg show {package}/{stem}Goal",
    ".bag": "a recording: rosbag play {path}",
    ".yaml": "a file of parameters: rosparam load {path}",
    ".perspective": "a perspective of rqt: rqt --perspective-file {path}",
}


def explanation(name: str) -> str:
    """Who has the package ``name``, or what to look at."""
    found = _debian_packages(name)
    if found:
        return f"Debian has it: sudo apt install {found}"
    return _known_sentence(name) or _UNKNOWN.format(name=name)


def _debian_packages(name: str) -> str:
    """Names for apt, by the rules that Debian ships for rosdep."""
    if not _DEBIAN_RULES.is_file():
        return ""
    found = re.search(rf"^{re.escape(name)}:\n  debian:\n((?:  - .+\n)+)", _DEBIAN_RULES.read_text(), re.MULTILINE)
    return " ".join(found[1].split()).replace("- ", "") if found else ""


def _known_sentence(name: str) -> str:
    """What find_package says of it, from the list of noetic_compatibility."""
    try:
        listed = Path(rospkg.RosPack().get_path("noetic_compatibility"), "cmake", "absent_packages.cmake").read_text()
    except (rospkg.ResourceNotFound, OSError):
        return ""
    for sentence, names in re.findall(r'^_noetic_absent\("([^"]*)"([^)]*)\)', listed, re.MULTILINE):
        if name in names.split():
            variables = dict(re.findall(r'^set\((\w+) "([^"]*)"\)', listed, re.MULTILINE))
            return re.sub(r"\$\{(\w+)\}", lambda used: variables[used[1]], sentence).replace("\\\n", "")
    return ""


def in_one_line(error: rospkg.ResourceNotFound) -> str:
    """For rospkg.ResourceNotFound.__str__: what ``error`` says."""
    what = str(error.args[0]) if error.args else ""
    return f"the package '{what}' is not here. {explanation(what)}" if re.fullmatch(r"[A-Za-z][\w-]*", what) else what


def no_program(path: Path, package: str) -> str:
    """What the file ``path`` of ``package`` is that nobody can run, and what takes it; "" for others."""
    kind = ".launch.py" if path.name.endswith(".launch.py") else path.suffix
    if kind not in _NO_PROGRAMS:
        return ""
    return "That is " + _NO_PROGRAMS[kind].format(package=package, name=path.name, stem=path.stem, path=path)


def of_program(package: str, name: str) -> str:
    """Why a package that is there has no program of that name, as far as its files tell; "" if they tell nothing."""
    renamed = _RENAMED.get((package, name))
    if renamed:
        return f"Noetic calls it {renamed}"
    if (package, name) in _IN_PLACE_OF:
        return _IN_PLACE_OF[package, name]
    try:
        folder = Path(rospkg.RosPack().get_path(package))
    except rospkg.ResourceNotFound:
        return ""
    files = [path for path in sorted(folder.rglob("*")) if name in (path.name, str(path.relative_to(folder))) and path.is_file()]
    if files and no_program(files[0], package):
        return no_program(files[0], package)
    if files:
        return f"Such a file is there and is not executable: chmod +x {files[0]}"
    cmake = folder / "CMakeLists.txt"
    if cmake.is_file() and re.search(rf"^[ \t]*add_executable\(\s*{re.escape(name)}\b", cmake.read_text(errors="replace"), re.MULTILINE):
        return f"The package makes it of C++ and is not built: catkin build {package}"
    launch = folder.rglob(glob.escape(name) + ".launch") if name and "/" not in name else ()
    for path in sorted(launch):
        return no_program(path, package)
    there = _programs(package, folder)
    others = f" and {len(there) - _MOST_NAMED} more" if len(there) > _MOST_NAMED else ""
    return f"The package has {', '.join(there[:_MOST_NAMED])}{others}" if there else "The package has no programs at all"


def _programs(package: str, folder: Path) -> list[str]:
    """What rosrun finds in a package, without the files of its own making."""
    built = [Path(place) for place in find_in_workspaces(["libexec"], project=package, first_matching_workspace_only=True)]
    sources = [path for path in (folder / "scripts", folder / "nodes", folder / "src", folder / "bin") if path.is_dir()]
    return sorted(
        {
            path.name
            for place in built + sources
            for path in place.rglob("*")
            if path.is_file() and os.access(path, os.X_OK) and path.suffix in ("", ".py", ".sh")
        }
    )
