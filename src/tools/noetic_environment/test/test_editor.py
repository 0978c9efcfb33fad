"""What ``rosrun noetic_environment vscode`` writes, against what Visual Studio Code's documentation says, and run as it would run it."""

import importlib.machinery
import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path

import jsonschema
import pytest
from noetic_environment import editor
from test_support.network import free_port

EXAMPLES = Path(__file__).resolve().parents[4] / "docs/examples"
TEXT, TEXTS, TRUTH = {"type": "string"}, {"type": "array", "items": {"type": "string"}}, {"type": "boolean"}


def closed(properties, *required):
    return {"type": "object", "additionalProperties": False, "properties": properties, "required": list(required)}


#: "Schema for tasks.json" and "Variables reference" of the documentation
INPUTS = {
    "type": "array",
    "items": closed(
        {"id": TEXT, "type": {"enum": ["promptString", "pickString", "command"]}, "description": TEXT, "default": TEXT},
        "id",
        "type",
        "description",
    ),
}
PATTERN = closed(
    {"regexp": TEXT, **{name: {"type": "integer", "minimum": 0} for name in ("file", "line", "column", "severity", "message")}}, "regexp"
)
MATCHER = closed(
    {
        "owner": TEXT,
        "fileLocation": {"anyOf": [TEXT, TEXTS]},
        "pattern": PATTERN,
        "background": closed({"activeOnStart": TRUTH, "beginsPattern": TEXT, "endsPattern": TEXT}),
    },
    "pattern",
)
TASK = closed(
    {
        "label": TEXT,
        "type": {"enum": ["shell", "process"]},
        "command": TEXT,
        "args": TEXTS,
        "isBackground": TRUTH,
        "group": {"anyOf": [{"enum": ["build", "test", "none"]}, closed({"kind": {"enum": ["build", "test"]}, "isDefault": TRUTH})]},
        "options": closed({"cwd": TEXT, "shell": closed({"executable": TEXT, "args": TEXTS}, "executable")}),
        "problemMatcher": MATCHER,
    },
    "label",
    "type",
    "command",
)
TASKS = closed({"version": {"const": "2.0.0"}, "tasks": {"type": "array", "items": TASK}, "inputs": INPUTS}, "version", "tasks")
#: of launch.json: what the extensions Python Debugger and C/C++ say in their package.json
COMMON = {"name": TEXT, "preLaunchTask": TEXT, "envFile": TEXT, "cwd": TEXT, "program": TEXT}
PICKED = {"const": "${command:pickProcess}"}
KINDS = [
    closed(
        {
            **COMMON,
            "type": {"const": "debugpy"},
            "request": {"const": "launch"},
            "args": {"anyOf": [TEXT, TEXTS]},
            "subProcess": TRUTH,
            "console": {"enum": ["internalConsole", "integratedTerminal", "externalTerminal"]},
        },
        "name",
        "type",
        "request",
        "program",
    ),
    closed(
        {
            "name": TEXT,
            "type": {"const": "debugpy"},
            "request": {"const": "attach"},
            "processId": PICKED,
            "connect": closed({"host": TEXT, "port": {"type": "integer"}}, "port"),
        },
        "name",
        "type",
        "request",
    ),
    closed(
        {
            **COMMON,
            "type": {"const": "cppdbg"},
            "request": {"enum": ["launch", "attach"]},
            "processId": PICKED,
            "args": TEXTS,
            "MIMode": {"enum": ["gdb", "lldb"]},
            "setupCommands": {"type": "array", "items": closed({"description": TEXT, "text": TEXT, "ignoreFailures": TRUTH}, "text")},
        },
        "name",
        "type",
        "request",
        "program",
    ),
]
LAUNCH = closed(
    {"version": {"const": "0.2.0"}, "configurations": {"type": "array", "items": {"oneOf": KINDS}}, "inputs": INPUTS},
    "version",
    "configurations",
)
PROPERTIES = closed(
    {
        "version": {"const": 4},
        "configurations": {
            "type": "array",
            "items": closed(
                {
                    "name": TEXT,
                    "compilerPath": TEXT,
                    "cppStandard": {"enum": ["c++14", "c++17", "c++20"]},
                    "includePath": TEXTS,
                    "intelliSenseMode": {"enum": ["linux-gcc-x64", "linux-gcc-arm64", "linux-gcc-arm"]},
                },
                "name",
            ),
        },
    },
    "version",
    "configurations",
)


@pytest.fixture
def workspace(tmp_path):
    """One that is not built yet, with a space in its name."""
    place = tmp_path / "my ws"
    (place / "src").mkdir(parents=True)
    shutil.copytree(EXAMPLES / "my_cpp_controllers", place / "src/my_cpp_controllers")
    return place


def command(*words, cwd):
    program = "import sys; from noetic_environment.editor import main; sys.exit(main())"
    return subprocess.run([sys.executable, "-c", program, *map(str, words)], cwd=cwd, capture_output=True, text=True, timeout=60)


def read(workspace, name):
    return json.loads((workspace / ".vscode" / name).read_text())


def variables(workspace):
    return dict(line.split("=", 1) for line in (workspace / ".vscode/ros.env").read_text().splitlines())


def task(workspace, label):
    return next(task for task in read(workspace, "tasks.json")["tasks"] if task["label"] == label)


def run(workspace, label, seconds=300):
    """As the editor runs a task that it was started for without a sourced shell."""
    chosen = task(workspace, label)
    shell = chosen["options"]["shell"]
    words = chosen["command"].replace("${fileDirname}", str(workspace / "src/my_cpp_controllers/src"))
    place = chosen["options"]["cwd"].replace("${workspaceFolder}", str(workspace))
    return subprocess.run(
        [shell["executable"], *shell["args"], words],
        cwd=place,
        capture_output=True,
        text=True,
        timeout=seconds,
        env={"HOME": os.environ.get("HOME", "/"), "PATH": "/usr/bin:/bin"},
    )


def test_it_is_what_the_documentation_says(workspace):
    said = command(cwd=workspace / "src")
    assert said.returncode == 0 and said.stdout.count(": written") == 6, said
    for name, schema in (("tasks.json", TASKS), ("launch.json", LAUNCH), ("c_cpp_properties.json", PROPERTIES)):
        jsonschema.validate(read(workspace, name), schema)
    labels = [task["label"] for task in read(workspace, "tasks.json")["tasks"]]
    assert len(labels) == len(set(labels)) and {"build", "test"} <= set(labels)
    for name in ("tasks.json", "launch.json"):
        text = (workspace / ".vscode" / name).read_text()
        assert set(re.findall(r"\$\{input:(\w+)\}", text)) == {entry["id"] for entry in read(workspace, name)["inputs"]}
        assert set(re.findall(r'"preLaunchTask": "(.*?)"', text)) <= set(labels)
        assert set(re.findall(r"\$\{(\w+)[:}]", text)) <= {"workspaceFolder", "file", "fileDirname", "input", "command"}
    settings = read(workspace, "settings.json")
    assert settings["files.associations"]["*.launch"] == "xml"
    assert Path(settings["python.defaultInterpreterPath"]).exists()


def test_what_is_there_stays(workspace):
    folder = workspace / ".vscode"
    folder.mkdir()
    (folder / "tasks.json").write_text("{} // mine")
    (folder / "settings.json").write_bytes(b"\xff\xfe")
    said = command(workspace, cwd="/").stdout
    assert (folder / "tasks.json").read_text() == "{} // mine" and (folder / "settings.json").read_bytes() == b"\xff\xfe"
    assert "tasks.json: kept: it is there already and differs; --force" in said and "settings.json: kept" in said
    assert "launch.json: written" in said
    again = command(workspace, cwd="/").stdout
    assert "tasks.json: kept" in again and "launch.json: as it is" in again
    forced = command(workspace, "--force", cwd="/").stdout
    assert "tasks.json: written; the old one is tasks.json.bak" in forced and "launch.json: as it is" in forced
    assert (folder / "tasks.json.bak").read_text() == "{} // mine" and (folder / "settings.json.bak").read_bytes() == b"\xff\xfe"
    assert read(workspace, "tasks.json")["version"] == "2.0.0"


def test_where_nothing_can_be_written(workspace, tmp_path):
    (tmp_path / "empty").mkdir()
    (workspace / ".vscode").write_text("a file")
    for words, said in (
        ((tmp_path / "empty",), "is in no catkin workspace"),
        (("/no/such",), "there is no folder"),
        ((workspace,), "File exists"),
    ):
        ended = command(*words, cwd="/")
        assert ended.returncode == 1 and ended.stderr.startswith("vscode: ") and said in ended.stderr and ended.stderr.count("\n") == 1


def test_workspaces_of_catkin_make_are_built_by_it(workspace):
    (workspace / ".catkin_workspace").touch()
    command(cwd=workspace)
    jsonschema.validate(read(workspace, "tasks.json"), TASKS)
    assert " catkin_make" in task(workspace, "build")["command"] and "catkin_make run_tests" in task(workspace, "test")["command"]
    (workspace / ".catkin_tools").mkdir()
    command("--force", cwd=workspace)
    assert "catkin build" in task(workspace, "build")["command"] and "catkin test" in task(workspace, "test")["command"]


def test_modules_are_found_where_they_are_written(workspace):
    command(cwd=workspace)
    found = importlib.machinery.PathFinder.find_spec("noetic_environment", read(workspace, "settings.json")["python.analysis.extraPaths"])
    assert Path(found.origin).samefile(editor.__file__.replace("editor.py", "__init__.py"))


@pytest.mark.slow
def test_headers_are_found(workspace):
    """The compiler finds everything that the example includes, with the paths that IntelliSense gets."""
    command(cwd=workspace)
    (configuration,) = read(workspace, "c_cpp_properties.json")["configurations"]
    paths = [
        path.replace("${workspaceFolder}", str(workspace)).replace("/src/**", "/src/my_cpp_controllers/include")
        for path in configuration["includePath"]
    ]
    for source in (workspace / "src/my_cpp_controllers/src").glob("*.cpp"):
        ended = subprocess.run(
            [configuration["compilerPath"], f"-std={configuration['cppStandard']}", "-M", *(f"-I{path}" for path in paths), str(source)],
            capture_output=True,
            text=True,
            timeout=120,
        )
        assert ended.returncode == 0, ended.stderr
        assert "controller_interface/controller.h" in ended.stdout


@pytest.mark.slow
def test_the_build_and_its_errors(workspace):
    """Built from a bare environment; the line of a mistake is where the problem matcher looks for it."""
    command(cwd=workspace)
    source = next((workspace / "src/my_cpp_controllers/src").glob("*.cpp"))
    text = source.read_text()
    source.write_text("int wrong = undeclared;\n" + text)
    broken = run(workspace, "build the package of this file")
    matcher = task(workspace, "build")["problemMatcher"]["pattern"]
    lines = re.sub(r"\x1b\[[\d;]*[mK]", "", broken.stdout + broken.stderr).splitlines()
    places = [
        (found[matcher["file"]], found[matcher["line"]], found[matcher["severity"]])
        for found in (re.match(matcher["regexp"], line) for line in lines)
        if found
    ]
    assert broken.returncode and (str(source), "1", "error") in places, broken.stdout + broken.stderr
    source.write_text(text)
    assert run(workspace, "build").returncode == 0
    assert "as it is" in command(cwd=workspace).stdout  # now with its own setup file
    assert f"{workspace}/devel" in variables(workspace)["CMAKE_PREFIX_PATH"]


# ---------------------------------------------------------------------------------------------- the debugger


class Debugger:
    """As the editor speaks to debugpy: the Debug Adapter Protocol."""

    def __init__(self, host, port):
        end = time.monotonic() + 30
        while True:
            try:
                self._socket = socket.create_connection((host, port), 30)
                break
            except OSError:
                assert time.monotonic() < end
                time.sleep(0.05)
        self._file, self._number = self._socket.makefile("rb"), 0

    def tell(self, operation, **arguments):
        self._number += 1
        body = json.dumps({"seq": self._number, "type": "request", "command": operation, "arguments": arguments}).encode()
        self._socket.sendall(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    def wait(self, name):
        """The next event or answer of that name."""
        while True:
            length = 0
            while line := self._file.readline().strip():
                length = int(line.split(b":")[1])
            message = json.loads(self._file.read(length))
            assert message.get("success", True), message
            if name in (message.get("event"), message.get("command")):
                return message

    def ask(self, operation, **arguments):
        self.tell(operation, **arguments)
        return self.wait(operation)["body"]


@pytest.mark.slow
def test_a_node_stops_at_a_breakpoint(workspace):
    """With nothing but the variables that the editor reads, and by the configuration that attaches to a node that waits."""
    pytest.importorskip("debugpy")
    command(cwd=workspace)
    attach = next(entry for entry in read(workspace, "launch.json")["configurations"] if "connect" in entry)
    node = workspace / "node.py"
    node.write_text("import rospy\nfrom std_msgs.msg import String\nsaid = String('here')\nprint(said.data)\n")
    interpreter = read(workspace, "settings.json")["python.defaultInterpreterPath"]
    prefix = re.search(r'launch-prefix="python3 (.*?)"', attach["name"])[1].split()
    prefix[prefix.index(str(attach["connect"]["port"]))] = str(port := free_port())
    attach["connect"]["port"] = port
    process = subprocess.Popen([interpreter, *prefix, str(node)], env=variables(workspace), stdout=subprocess.PIPE, text=True)
    try:
        debugger = Debugger(**attach["connect"])
        debugger.ask("initialize", adapterID=attach["type"], pathFormat="path", linesStartAt1=True, columnsStartAt1=True)
        debugger.tell("attach", **attach)
        debugger.wait("initialized")
        debugger.ask("setBreakpoints", source={"path": str(node)}, breakpoints=[{"line": 4}])
        debugger.tell("configurationDone")
        thread = debugger.wait("stopped")["body"]["threadId"]
        frame = debugger.ask("stackTrace", threadId=thread)["stackFrames"][0]
        assert (frame["source"]["path"], frame["line"]) == (str(node), 4)
        assert debugger.ask("evaluate", expression="said.data", frameId=frame["id"])["result"] == "'here'"
        debugger.tell("continue", threadId=thread)
        assert process.stdout.readline() == "here\n"
        assert process.wait(30) == 0
    finally:
        process.kill()
