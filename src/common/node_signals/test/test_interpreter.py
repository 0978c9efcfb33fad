"""What `#!/usr/bin/env python` finds in nodes."""

import contextlib
import os
import shutil
import socket
import subprocess

import pytest
from node_signals.interpreter import as_it_can_run, supply_python


def program(folder, name, text="#!/bin/sh\nexit 3\n"):
    folder.mkdir(exist_ok=True)
    (folder / name).write_text(text)
    (folder / name).chmod(0o755)


@pytest.fixture
def debian(tmp_path):
    """A folder with Debian's python3 and no python."""
    folder = tmp_path / "debian"
    folder.mkdir()
    (folder / "python3").symlink_to("/usr/bin/python3")
    return folder


@pytest.mark.parametrize("another", [False, True])
def test_python_is_debians_where_there_is_none_or_another(tmp_path, debian, another):
    if another:
        program(tmp_path / "pyenv", "python")
    environment = {"PATH": f"{tmp_path / 'pyenv'}:{debian}"}
    supply_python(environment)
    node = tmp_path / "node"
    program(tmp_path, "node", "#!/usr/bin/env python\nimport sys, rospy\nprint(sys.argv[1:], sys.version_info[0])\n")
    answer = subprocess.run([node, "a b"], env={**os.environ, **environment}, capture_output=True, text=True)
    assert answer.stdout == "['a b'] 3\n", answer.stderr
    added = environment["PATH"].split(":")[0]
    assert os.listdir(added) == ["python"], "nothing else is displaced"
    assert shutil.which("python2", path=environment["PATH"]).endswith("/python2/python2")
    before = dict(environment)
    supply_python(environment)
    assert environment == before


def test_an_environment_that_knows_python_stays(tmp_path, debian):
    (debian / "python").symlink_to("python3")
    program(debian, "python2", "#!/bin/sh\nexit 0\n")
    for folder in (debian, tmp_path / "conda"):
        program(tmp_path / "conda", "python3")  # a python3 of its own, with or without rospy
        environment = {"PATH": str(folder)}
        supply_python(environment)
        assert environment == {"PATH": str(folder)}


@pytest.mark.parametrize(
    "text, code, out, told",
    [
        ("import sys\nprint('%d %s' % (sys.version_info[0], sys.argv[1]))\n", 0, "3 a b\n", "it runs with Python 3"),
        ("import sys\nprint sys.argv\n", 1, "", "node, line 3: written for Python 2"),
        ("if True:\n\tx = 1\n        print(x)\n", 1, "", "2to3 -w"),
    ],
)
@pytest.mark.parametrize("name", ["python2", "python2.7"])
def test_a_script_for_python_2_runs_if_python_3_reads_it_and_else_one_line_says_what_to_do(tmp_path, debian, name, text, code, out, told):
    program(tmp_path, "node", f"#!/usr/bin/env {name}\n{text}")
    environment = {"PATH": str(debian)}
    supply_python(environment)
    answer = subprocess.run([tmp_path / "node", "a b"], env=environment, capture_output=True, text=True, timeout=60)
    assert (answer.returncode, answer.stdout, answer.stderr.count("\n")) == (code, out, 1)
    assert told in answer.stderr


PLAIN = "import sys\nprint(sys.version_info[0], sys.argv[1:])\n"
FIRST_LINES = [  # what the file begins with, what is told; Debian has none of these interpreters
    (b"#!/usr/bin/python2\n", "it runs with Python 3, where 1/2 is 0.5"),
    (b"#!/usr/bin/python2.7 -u\n", "it runs with Python 3"),
    (b"#!/usr/local/bin/python2\n", "it runs with Python 3"),
    (b"#!/usr/local/bin/python\n", ""),
    (b"#!/opt/nowhere/bin/python3\n", ""),
    (b"#!/usr/bin/env python3.8\n", "asks for python3.8, which is not here; it runs with Python 3"),
    (b"#!/usr/bin/python3.6\n", "asks for python3.6"),
    (b"#!/usr/bin/env python3\r\n", "dos2unix"),
    (b"#!/usr/bin/python\r\n", "dos2unix"),
    (b"#!/usr/bin/env python2\r\n", "dos2unix"),
    (b"\xef\xbb\xbf#!/usr/bin/env python3\n", "mark of UTF-8"),
]


@pytest.mark.parametrize("first, told", FIRST_LINES)
def test_a_first_line_that_names_what_is_not_there(tmp_path, debian, monkeypatch, first, told):
    program(tmp_path, "node", "")
    (tmp_path / "node").write_bytes(first + (PLAIN.replace("\n", "\r\n") if b"\r" in first else PLAIN).encode())
    environment = {"PATH": f"{debian}:/usr/bin:/bin"}
    supply_python(environment)
    monkeypatch.setenv("PATH", environment["PATH"])
    unknown = b"env" not in first or first[:1] == b"\xef"
    with pytest.raises(OSError) if unknown else contextlib.nullcontext():  # as it stands it cannot be started
        assert subprocess.run([tmp_path / "node"], env=environment, capture_output=True).returncode == 127
    words, line = as_it_can_run(str(tmp_path / "node"))
    answer = subprocess.run([*words, "a b"], env=environment, capture_output=True, text=True, timeout=60)
    assert (answer.returncode, answer.stdout) == (0, "3 ['a b']\n"), answer.stderr
    said = line + answer.stderr
    assert told in said and (said.count("it runs") == 1 if told else said == "")


@pytest.mark.parametrize(
    "first",
    [
        b"#!/usr/bin/env python3\n",
        b"#!/bin/sh\n",
        b"#!/usr/bin/python3 -u\n",
        b"\x7fELF\r\n",
        b"import rospy\n",
        b"#!/usr/bin/perl\n",
        b"#!\n",
        b"",
    ],
)
def test_what_can_be_started_is_left_to_the_kernel(tmp_path, first):
    (tmp_path / "node").write_bytes(first)
    assert as_it_can_run(str(tmp_path / "node")) == ([str(tmp_path / "node")], "")


SHIMS = {  # of version managers, without such a version behind them: what they say, and how they end
    "pyenv": '#!/bin/sh\necho "pyenv: ${0##*/}: command not found" >&2\nexit 127\n',
    "asdf": '#!/bin/sh\necho "No version is set for command ${0##*/}" >&2\nexit 126\n',
    "mise": None,  # a link to a program
}


def shims(folder, manager, name):
    folder.mkdir()
    if SHIMS[manager] is None:
        (folder / name).symlink_to(shutil.which("false"))
    else:
        program(folder, name, SHIMS[manager])
    return folder


@pytest.mark.parametrize("manager", SHIMS)
@pytest.mark.parametrize(
    "asked, told", [("python2.7", "it runs with Python 3, where 1/2 is 0.5"), ("python3.8", "asks for python3.8"), ("python", "")]
)
def test_a_version_managers_shim_with_nothing_behind_it_is_not_there(tmp_path, debian, monkeypatch, manager, asked, told):
    program(tmp_path, "node", f"#!/usr/bin/env {asked}\n{PLAIN}")
    monkeypatch.setenv("PATH", f"{shims(tmp_path / 'shims', manager, asked)}:{debian}:/usr/bin:/bin")
    assert subprocess.run([tmp_path / "node"], capture_output=True).returncode != 0
    words, line = as_it_can_run(str(tmp_path / "node"))
    answer = subprocess.run([*words, "a b"], capture_output=True, text=True, timeout=60)
    assert (answer.returncode, answer.stdout) == (0, "3 ['a b']\n"), answer.stderr
    assert told in line + answer.stderr and (told or line + answer.stderr == "")


def test_what_lies_behind_a_shim_on_path_is_taken(tmp_path, debian, monkeypatch):
    folder = shims(tmp_path / "shims", "pyenv", "python3.8")
    (debian / "python3.8").symlink_to("/usr/bin/python3")
    program(tmp_path, "node", "#!/usr/bin/env python3.8\n")
    monkeypatch.setenv("PATH", f"{folder}:{debian}")
    assert as_it_can_run(str(tmp_path / "node")) == ([str(debian / "python3.8"), str(tmp_path / "node")], "")


def test_python2_is_supplied_where_there_is_a_shim_alone(tmp_path, debian):
    environment = {"PATH": f"{shims(tmp_path / 'shims', 'pyenv', 'python2')}:{debian}:/usr/bin:/bin"}
    supply_python(environment)
    program(tmp_path, "node", f"#!/usr/bin/env python2\n{PLAIN}")
    answer = subprocess.run([tmp_path / "node"], env=environment, capture_output=True, text=True, timeout=60)
    assert answer.stdout == "3 []\n"


def test_a_shell_script_with_windows_line_ends_is_told(tmp_path):
    (tmp_path / "node").write_bytes(b"#!/bin/bash\r\necho a\r\n")
    words, line = as_it_can_run(str(tmp_path / "node"))
    assert words == [str(tmp_path / "node")] and line.endswith(f"dos2unix {tmp_path}/node")


@pytest.mark.parametrize("first", ["#!/usr/bin/python2", "#!/usr/local/bin/python", "#!/usr/bin/env python3.8"])
@pytest.mark.parametrize("command", ["rosrun old_nodes talk", "roslaunch old_nodes talk.launch"])
def test_the_commands_give_them_to_nodes(tmp_path, command, first):
    package = tmp_path / "old_nodes"
    program(package, "talk", f"{first}\nprint('it talks')\n")
    (package / "package.xml").write_text("<package><name>old_nodes</name><version>1.0.0</version></package>")
    (package / "talk.launch").write_text(
        '<launch><node name="talk" pkg="old_nodes" type="talk" output="screen" required="true" launch-prefix="nice -n 1"/></launch>'
    )
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    environment = {
        **os.environ,
        "ROS_HOME": str(tmp_path),
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_PACKAGE_PATH": f"{tmp_path}:{os.environ['ROS_PACKAGE_PATH']}",
        "PATH": f"{shims(tmp_path / 'shims', 'pyenv', first.rpartition('/')[2].split()[-1])}:{os.environ['PATH']}",
    }
    answer = subprocess.run(command.split(), env=environment, capture_output=True, text=True, timeout=120)
    assert "it talks" in answer.stdout, answer.stdout + answer.stderr


@pytest.mark.parametrize("command", ["rosrun old_nodes talk", "roslaunch old_nodes talk.launch"])
def test_the_commands_give_it_to_nodes(tmp_path, debian, command):
    package = tmp_path / "old_nodes"
    program(package, "talk", "#!/usr/bin/env python\nimport rospy\nprint('it talks')\n")
    program(tmp_path / "pyenv", "python")
    (package / "package.xml").write_text("<package><name>old_nodes</name><version>1.0.0</version></package>")
    (package / "talk.launch").write_text('<launch><node name="talk" pkg="old_nodes" type="talk" output="screen" required="true"/></launch>')
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    environment = {
        **os.environ,
        "PATH": f"{tmp_path / 'pyenv'}:{os.environ['PATH']}",
        "ROS_HOME": str(tmp_path),
        "ROS_MASTER_URI": f"http://localhost:{port}",
        "ROS_PACKAGE_PATH": f"{tmp_path}:{os.environ['ROS_PACKAGE_PATH']}",
    }
    answer = subprocess.run(command.split(), env=environment, capture_output=True, text=True, timeout=120)
    assert "it talks" in answer.stdout, answer.stdout + answer.stderr
