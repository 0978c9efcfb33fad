"""``rosrun noetic_environment vscode [WORKSPACE]``: files with which Visual Studio Code builds, runs and debugs a workspace."""

from __future__ import annotations

import argparse
import json
import os
import platform
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import rospkg

FOLDER = ".vscode"
ENVIRONMENT = "ros.env"
PORT = 5678  # on which debugpy waits where nobody says otherwise
CARRIED = ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PATH", "PKG_CONFIG_PATH", "PYTHONPATH")  # and all of ROS and Gazebo
LIBRARIES = ("eigen3", "opencv4", "pcl-*")
BASH = {"executable": "/bin/bash", "args": ["-c"]}
COMPILER = {
    "owner": "cpp",
    "fileLocation": ["autoDetect", "${workspaceFolder}"],
    "pattern": {
        "regexp": r"^(.*?):(\d+):(\d+):\s+(?:fatal\s+)?(warning|error):\s+(.*)$",
        "file": 1,
        "line": 2,
        "column": 3,
        "severity": 4,
        "message": 5,
    },
}
SETTINGS = {
    "files.associations": {f"*.{end}": "xml" for end in ("launch", "sdf", "srdf", "test", "urdf", "world", "xacro")} | {"*.rviz": "yaml"},
    "files.watcherExclude": {f"**/{name}/**": True for name in ("build", "devel", "install", "logs")},
    "search.exclude": {f"**/{name}": True for name in ("build", "devel", "install", "logs")},
}
EXTENSIONS = {"recommendations": ["ms-python.python", "ms-python.debugpy", "ms-vscode.cpptools"]}


class EditorError(Exception):
    """What cannot be done, in one line."""


def workspace_of(folder: Path) -> Path:
    """The nearest folder from ``folder`` upwards that has packages in ``src``.

    :raises EditorError: there is none
    """
    for place in (folder, *folder.parents):
        if any((place / name).exists() for name in (".catkin_tools", ".catkin_workspace", "src/CMakeLists.txt")) or (
            any((place / "src").glob("*/package.xml")) or any((place / "src").glob("*/*/package.xml"))
        ):
            return place
    raise EditorError(f"{folder} is in no catkin workspace (a folder with packages in src); rosrun noetic_environment vscode WORKSPACE")


def environment_of(workspace: Path, present: Mapping[str, str]) -> dict[str, str]:
    """The environment of a shell that has sourced the workspace; the present one where it is not built yet.

    :raises EditorError: its setup file fails
    """
    setup = workspace / "devel/setup.bash"
    if not setup.is_file():
        return dict(present)
    ended = subprocess.run(
        ["/bin/bash", "-c", f"source {shlex.quote(str(setup))} > /dev/null && env -0"], capture_output=True, text=True, env={**present}
    )
    if ended.returncode:
        raise EditorError(f"{setup} cannot be sourced: {' '.join(ended.stderr.split())[-200:]}")
    return dict(line.split("=", 1) for line in ended.stdout.split("\0") if "=" in line)


def sourcing(workspace: Path, environment: Mapping[str, str]) -> str:
    """The beginning of a task's command: the setup file of ``workspace``, or where that is not built yet the one that it is built on, by
    ``environment``.
    """
    below = [
        prefix
        for prefix in environment.get("CMAKE_PREFIX_PATH", "").split(":")
        if prefix and workspace not in Path(prefix).parents and Path(prefix, "setup.bash").is_file()
    ]
    first = f"source {shlex.quote(below[0] + '/setup.bash')}; " if below else ""
    return f"{first}[ ! -f devel/setup.bash ] || source devel/setup.bash; "


def uses_catkin_make(workspace: Path) -> bool:
    return not (workspace / ".catkin_tools").exists() and (
        (workspace / ".catkin_workspace").exists() or (workspace / "build/CMakeCache.txt").is_file()
    )


# ---------------------------------------------------------------------------------------------- the files


def tasks(workspace: Path, environment: Mapping[str, str]) -> dict[str, Any]:
    """tasks.json of ``workspace``: build and test, in ``environment``."""
    begin = sourcing(workspace, environment)

    def task(label: str, command: str, **more: Any) -> dict[str, Any]:
        return {
            "label": label,
            "type": "shell",
            "command": begin + command,
            "options": {"cwd": "${workspaceFolder}", "shell": BASH},
            "problemMatcher": COMPILER,
            **more,
        }

    debug = "-DCMAKE_BUILD_TYPE=Debug -DCMAKE_EXPORT_COMPILE_COMMANDS=ON"
    if uses_catkin_make(workspace):
        made = [
            task("build", "catkin_make", group={"kind": "build", "isDefault": True}),
            task("build for the debugger", f"catkin_make {debug}", group="build"),
            task("test", "catkin_make run_tests; catkin_test_results build", group={"kind": "test", "isDefault": True}),
        ]
    else:
        made = [
            task("build", "catkin build --no-status", group={"kind": "build", "isDefault": True}),
            task(
                "build the package of this file",
                '[ -d .catkin_tools ] || catkin init; cd "${fileDirname}" && catkin build --this --no-status',
                group="build",
            ),
            task("build for the debugger", f"catkin build --no-status --cmake-args {debug}", group="build"),
            task("test", "catkin test --no-status", group={"kind": "test", "isDefault": True}),
        ]
    core = {
        "owner": "ros",
        "pattern": {"regexp": "^(.*): (error): (.*)$", "file": 1, "severity": 2, "message": 3},
        "background": {"activeOnStart": True, "beginsPattern": "^auto-starting new master", "endsPattern": "^started core service"},
    }
    launched = {
        **core,
        "background": {"activeOnStart": True, "beginsPattern": "^started roslaunch server", "endsPattern": r"process\[.*started"},
    }
    return {
        "version": "2.0.0",
        "tasks": [
            *made,
            task("roscore", "roscore", isBackground=True, problemMatcher=core),
            task("roslaunch", "roslaunch ${input:launch}", isBackground=True, problemMatcher=launched),
        ],
        "inputs": inputs(("launch", "Package and launch file, with arguments as they stand on the command line")),
    }


def inputs(*asked: tuple[str, str]) -> list[dict[str, str]]:
    return [{"id": name, "type": "promptString", "description": words} for name, words in asked]


def launch() -> dict[str, Any]:
    file = f"${{workspaceFolder}}/{FOLDER}/{ENVIRONMENT}"
    node = "${workspaceFolder}/devel/lib/${input:package}/${input:node}"
    gdb = {
        "type": "cppdbg",
        "program": node,
        "MIMode": "gdb",
        "setupCommands": [{"description": "containers as what is in them", "text": "-enable-pretty-printing", "ignoreFailures": True}],
    }
    python = {"type": "debugpy", "request": "launch", "console": "integratedTerminal", "cwd": "${workspaceFolder}", "envFile": file}
    return {
        "version": "0.2.0",
        "configurations": [
            {"name": "Python: this file as a node", **python, "program": "${file}"},
            {
                "name": "Python: attach to a node by its process",
                "type": "debugpy",
                "request": "attach",
                "processId": "${command:pickProcess}",
            },
            {
                "name": f'Python: attach to a node that waits (launch-prefix="python3 -m debugpy --listen {PORT} --wait-for-client")',
                "type": "debugpy",
                "request": "attach",
                "connect": {"host": "localhost", "port": PORT},
            },
            {
                "name": "C++: a node",
                **gdb,
                "request": "launch",
                "args": [],
                "cwd": "${workspaceFolder}",
                "envFile": file,
                "preLaunchTask": "build for the debugger",
            },
            {"name": "C++: attach to a node", **gdb, "request": "attach", "processId": "${command:pickProcess}"},
        ],
        "inputs": inputs(("package", "Package of the node"), ("node", "Name of the node's program")),
    }


def packages(environment: Mapping[str, str]) -> Iterator[Path]:
    """Folders of all packages in source that the environment has."""
    paths = [path for path in environment.get("ROS_PACKAGE_PATH", "").split(":") if path]
    found = rospkg.RosPack(paths)
    for name in sorted(found.list()):
        place = Path(found.get_path(name))
        if (place / "CMakeLists.txt").is_file():
            yield place


def system_headers() -> list[str]:
    """Folders that packages of Debian add to the compiler's own."""
    system = Path("/usr/include")
    doubled = [
        place
        for place in sorted(system.iterdir())
        if (place / place.name).is_dir() and Path("/usr/share", place.name, "package.xml").is_file()
    ]
    return [str(place) for place in (*doubled, *(place for name in LIBRARIES for place in sorted(system.glob(name))))]


def properties(workspace: Path, environment: Mapping[str, str]) -> dict[str, Any]:
    """c_cpp_properties.json of ``workspace``: where the headers are, in ``environment``."""
    headers = [str(Path(prefix, "include")) for prefix in environment.get("CMAKE_PREFIX_PATH", "").split(":") if prefix]
    headers += [str(place / "include") for place in packages(environment)]
    machine = {"x86_64": "x64", "aarch64": "arm64", "armv7l": "arm"}.get(platform.machine(), "x64")
    return {
        "version": 4,
        "configurations": [
            {
                "name": "Linux",
                "compilerPath": shutil.which("g++") or "/usr/bin/g++",
                "cppStandard": "c++17",
                "intelliSenseMode": f"linux-gcc-{machine}",
                "includePath": [
                    "${workspaceFolder}/src/**",
                    "${workspaceFolder}/devel/include",
                    *(path for path in headers + system_headers() if Path(path).is_dir() and workspace not in Path(path).parents),
                ],
            }
        ],
    }


def settings(environment: Mapping[str, str]) -> dict[str, Any]:
    """Python's modules lie in source folders, to which the devel space only points."""
    modules = [str(place / "src") for place in packages(environment) if (place / "setup.py").is_file() and (place / "src").is_dir()]
    modules += [path for path in environment.get("PYTHONPATH", "").split(":") if path]
    return {
        **SETTINGS,
        "python.analysis.extraPaths": modules,
        "python.envFile": f"${{workspaceFolder}}/{FOLDER}/{ENVIRONMENT}",
        "python.defaultInterpreterPath": shutil.which("python3", path=environment.get("PATH")) or "/usr/bin/python3",
    }


def variables(environment: Mapping[str, str]) -> str:
    """Of a shell that has sourced the workspace, for programs that are started without one."""
    return "".join(
        f"{name}={value}\n"
        for name, value in sorted(environment.items())
        if (name in CARRIED or name.startswith(("ROS", "GAZEBO"))) and "\n" not in value
    )


def files(workspace: Path, environment: Mapping[str, str]) -> dict[str, str]:
    """Name -> text of all files for ``workspace``, in ``environment``."""
    made = {
        "tasks.json": tasks(workspace, environment),
        "launch.json": launch(),
        "settings.json": settings(environment),
        "c_cpp_properties.json": properties(workspace, environment),
        "extensions.json": EXTENSIONS,
    }
    return {**{name: json.dumps(content, indent=4) + "\n" for name, content in made.items()}, ENVIRONMENT: variables(environment)}


# ---------------------------------------------------------------------------------------------- writing them


def write(folder: Path, texts: Mapping[str, str], force: bool) -> list[tuple[str, str | None]]:
    """Write ``texts`` by their names into ``folder``.

    :param force: write what is there anew, too; the old one is kept beside it with the ending ``.bak``
    :return: name of each file, and what happened to it; None: it is what it should be
    """
    said: list[tuple[str, str | None]] = []
    folder.mkdir(exist_ok=True)
    for name, text in texts.items():
        path = folder / name
        before = path.read_text(errors="replace") if path.exists() else None
        if before == text:
            said.append((name, None))
        elif before is not None and not force and name != ENVIRONMENT:  # nobody writes that one by hand
            said.append((name, f"kept: it is there already and differs; --force writes it anew and keeps the old one as {name}.bak"))
        else:
            if before is not None and name != ENVIRONMENT:
                path.rename(path.with_name(name + ".bak"))
            path.write_text(text)
            said.append((name, "written" if before is None or name == ENVIRONMENT else f"written; the old one is {name}.bak"))
    return said


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="rosrun noetic_environment vscode",
        description="Writes .vscode/ of a catkin workspace: tasks "
        "that build and test it, configurations that run nodes under a debugger or attach to them, and where "
        "headers and modules are.",
    )
    parser.add_argument("workspace", nargs="?", default=".", help="the workspace, or a folder in it; the present one")
    parser.add_argument("--force", action="store_true", help="write files anew that are there and differ; the old ones become FILE.bak")
    options = parser.parse_args()
    try:
        given = Path(options.workspace).resolve()
        if not given.is_dir():
            raise EditorError(f"there is no folder {given}")
        workspace = workspace_of(given)
        environment = environment_of(workspace, os.environ)
        for name, what in write(workspace / FOLDER, files(workspace, environment), options.force):
            print(f"{FOLDER}/{name}: {what or 'as it is'}")
    except (EditorError, OSError) as error:
        where = f"{error.filename}: {error.strerror}" if isinstance(error, OSError) else str(error)
        print(f"vscode: {where}", file=sys.stderr)
        return 1
    if not (workspace / "devel/setup.bash").is_file():
        print("The workspace is not built yet: build it, and call this again, so that its own packages are found.")
    print(f"code {shlex.quote(str(workspace))}")
    return 0
