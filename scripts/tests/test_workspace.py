"""The house rules that a machine can check: import directions, launch arguments, node script sizes, manifests."""

import ast
import builtins
import importlib.util
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
#: what stands in a test/ folder is some student's or stranger's package, and made to be as they are
PACKAGES = {
    path.parent.name: path.parent for path in sorted((ROOT / "src").rglob("package.xml")) if "test" not in path.relative_to(ROOT).parts
}
ROS_MODULES = {"rospy", "roslib", "rosgraph", "rospkg", "tf", "tf2_ros", "genpy", "catkin"}


def tracked(pattern):
    """Files that git knows below src/, so that build products and caches do not count."""
    out = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--", pattern],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    return [ROOT / name for name in out.split("\0") if name and (ROOT / name).is_file()]


@pytest.mark.parametrize(
    "arguments, said",
    [
        (["--oot"], "unrecognized arguments: --oot"),
        (["--out", "/dev/null/demo"], "cannot write into --out /dev/null/demo: Not a directory"),
        (["--out", "/proc/demo"], "cannot write into --out /proc/demo"),
        (["1", "1", "1"], "expected four joint positions"),
        (["1", "1", "1", "nan"], "expected four joint positions"),
    ],
)
def test_demo_judges_its_options_before_it_sets_anything_up(tmp_path, arguments, said):
    ended = subprocess.run([ROOT / "scripts/demo", *arguments], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 2 and said in ended.stderr.splitlines()[-1]
    assert "[setup]" not in ended.stdout + ended.stderr


def imports(path):
    """Top-level module names imported anywhere in a Python file."""
    names = set()
    for node in ast.walk(ast.parse(path.read_text(), str(path))):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0 and node.module:
            names.add(node.module.split(".")[0])
    return names


def python_files(package):
    return [p for p in tracked(f"{PACKAGES[package].relative_to(ROOT)}/src/*.py")]


def room(package):
    return PACKAGES[package].relative_to(ROOT / "src").parts[0]


def test_the_simulator_without_ros_imports_none_and_points_one_way():
    below = {"ode_sim", "lenient_xml"}
    for package, allowed in (
        ("lenient_xml", {"lenient_xml"}),
        ("ode_sim", below),
        ("ode_sim_rendering", {*below, "ode_sim_rendering"}),
        ("ode_sim_viewer", {*below, "ode_sim_rendering", "ode_sim_viewer"}),
        ("ode_sim_gym", {*below, "ode_sim_rendering", "ode_sim_gym"}),
    ):
        for path in python_files(package):
            assert not imports(path) & (ROS_MODULES | (set(PACKAGES) - allowed)), path


@pytest.mark.parametrize("package", sorted(PACKAGES))
def test_imports_point_one_way(package):
    """Control knows neither the simulator nor hardware; tools know none of them; nobody imports a lab."""
    forbidden = {
        "control": {"simulation", "hardware", "labs"},
        "tools": {"simulation", "control", "hardware", "labs"},
        "simulation": {"hardware", "labs"},
        "hardware": {"simulation", "labs"},
        "labs": set(),
    }
    own = room(package)
    for path in python_files(package):
        for name in imports(path) & set(PACKAGES):
            assert room(name) not in forbidden.get(own, set()), f"{path} imports {name}"
            assert own == "labs" or room(name) != "labs", f"{path} imports {name}"


@pytest.mark.parametrize("package", sorted(PACKAGES))
def test_manifest_is_complete(package):
    root = ET.parse(PACKAGES[package] / "package.xml").getroot()
    assert root.get("format") in ("2", "3") and root.findtext("name") == package
    assert len(root.findtext("description").strip()) > 15 and "TODO" not in ET.tostring(root, "unicode")
    assert root.findtext("license") == "BSD-3-Clause"


#: Roots of the trees of errors (ode_sim.errors, hardware_interface.errors, moveit_core.errors, qt_gui.errors ... draw them), and
#: packages small enough to have one error of their own.
ROOTS = {
    "ode_sim": "SimulationError",
    "hardware_interface": "ControlError",
    "node_signals": "ParameterError",
    "plugin_loader": "PluginError",
    "moveit_core": "MoveItError",
    "qt_gui": "WindowError",
    "lab_check": "LabError",
    "launch_gallery": "GalleryError",
    "rviz_offscreen": "OffscreenError",
    "rosmon_core": "RosmonError",
    "arbotix_python": "ArbotiXException",
    "srdfdom": "ParseError",
    "qt_dotgraph": "LayoutError",
    "turtlesim": "WorldError",
    "moveit_setup_assistant": "AssistantError",
    "laser_filters": "FilterError",
    "topic_tools": "ExpressionError",
    "robot_localization": "FrameMissing",
    "turtle_actionlib": "PolygonError",
    "xacro": "PackageNotFoundError",
    "web_video_server": "VideoError",
    "image_pixels": "ImageError",
    "bag_tools": "BagError",
    "rosbridge_library": "RosbridgeError",
    "arbotix_controllers": "OutOfReach",
    "noetic_environment": "EditorError",
    "foxglove_bridge": "BridgeError",
    "ros1_bridge": "BridgeError",
    "lenient_xml": "XmlError",
    "urdfdom_py": "ParseError",
}


@pytest.mark.parametrize("package", sorted(PACKAGES))
def test_errors_grow_on_one_tree(package):
    """Who catches a root catches all that a wing can say to a student. Names with an underscore are the steering of one module."""
    builtin = {name for name, kind in vars(builtins).items() if isinstance(kind, type) and issubclass(kind, BaseException)}
    for path in python_files(package):
        for node in ast.walk(ast.parse(path.read_text(), str(path))):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_") and node.bases:
                alone = all(isinstance(base, ast.Name) and base.id in builtin for base in node.bases)
                assert not alone or ROOTS.get(package) == node.name, f"{path}:{node.lineno}: {node.name} hangs on no tree of errors"


def _modules():
    """Dotted name -> file of each Python module in a package's src/."""
    return {
        ".".join(path.relative_to(home / "src").with_suffix("").parts).removesuffix(".__init__"): path
        for home in PACKAGES.values()
        if (home / "src").is_dir()
        for path in tracked(f"{home.relative_to(ROOT)}/src/*.py")
    }


def _imported_at_once(path, name):
    """Dotted names that a module imports while it is imported itself: not in functions, not for type checkers alone."""
    home = name if path.name == "__init__.py" else name.rpartition(".")[0]
    todo = list(ast.parse(path.read_text(), str(path)).body)
    while todo:
        node = todo.pop()
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            above = home.split(".")[: len(home.split(".")) - node.level + 1] if node.level else []
            base = ".".join([*above, *filter(None, [node.module])])
            yield from (f"{base}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Try) or isinstance(node, ast.If) and "TYPE_CHECKING" not in ast.dump(node.test):
            todo += node.body


def test_no_import_goes_round_in_a_circle():
    """A module that is imported before what it needs works by luck, and only in one order."""
    modules = _modules()
    needs = {}
    for name, path in modules.items():
        found = set()
        for wanted in _imported_at_once(path, name):
            while wanted and wanted not in modules:
                wanted = wanted.rpartition(".")[0]
            found.add(wanted)
        needs[name] = {wanted for wanted in found if wanted and wanted != name and not name.startswith(wanted + ".")}
    left = dict(needs)
    while free := [name for name, wanted in left.items() if not wanted & left.keys()]:
        for name in free:
            del left[name]
    assert not left, "these import each other, or what does: " + ", ".join(sorted(left))


def test_node_scripts_are_short():
    for path in tracked("src/*/scripts/*"):
        first, _, _ = path.read_bytes().partition(b"\n")
        if first.startswith(b"#!") and b"python" in first and "test" not in path.relative_to(ROOT).parts:
            assert len(path.read_text().splitlines()) <= 20, path


def test_launch_arguments_are_documented():
    for path in tracked("src/*.launch"):
        if "/test/" in str(path):
            continue
        for arg in ET.parse(path).getroot().findall("arg"):
            assert arg.get("value") is not None or (arg.get("default") is not None and arg.get("doc")), (
                f"{path}: argument {arg.get('name')} needs a default and a doc"
            )


@pytest.mark.parametrize("package", sorted(PACKAGES))
def test_every_python_package_is_installed(package):
    """A module that setup.py forgets is found in the devel space and missing from the installed platform."""
    setup = PACKAGES[package] / "setup.py"
    for path in python_files(package):
        if path.name == "__init__.py":
            name = ".".join(path.relative_to(PACKAGES[package] / "src").parts[:-1])
            said = setup.read_text() if setup.is_file() else ""
            assert "find_packages" in said or f'"{name}"' in said or f"'{name}'" in said, f"{setup} does not name {name}"


@pytest.mark.parametrize("path", [path for path in tracked("scripts/*.py") if path.parent.name == "scripts"], ids=lambda path: path.name)
def test_what_scripts_import_of_packages_is_there(path):
    """The commands of scripts/ use packages that others change; most of their imports only run after minutes of set-up."""
    for node in ast.walk(ast.parse(path.read_text(), str(path))):
        if isinstance(node, ast.ImportFrom) and node.level == 0 and node.module.split(".")[0] in PACKAGES:
            module = importlib.import_module(node.module)
            missing = [
                alias.name
                for alias in node.names
                if not hasattr(module, alias.name) and importlib.util.find_spec(f"{node.module}.{alias.name}") is None
            ]
            assert not missing, f"line {node.lineno}: {node.module} has no {', '.join(missing)}"


def test_build_folders_of_moved_packages_are_forgotten(tmp_path):
    for name, there in (("stays", True), ("moved", False)):
        home = tmp_path / "src" / name
        (tmp_path / "build" / name).mkdir(parents=True)
        (tmp_path / "build" / name / "CMakeCache.txt").write_text(f"A:STRING=1\nCMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
        if there:
            home.mkdir(parents=True)
            (home / "CMakeLists.txt").touch()
    command = ["python3", ROOT / "scripts/forget_moved.py", tmp_path / "build"]
    out = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert [path.name for path in (tmp_path / "build").iterdir()] == ["stays"] and "moved" in out
