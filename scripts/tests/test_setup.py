"""scripts/setup on a copy that needs no packages, with programs of apt and catkin that only play their parts."""

import os
import pty
import re
import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPTS = Path(__file__).resolve().parents[1]
SETUP = SCRIPTS / "setup"
TOOLS = (
    "awk bash cat chmod comm cp cut df dirname env find flock grep head id ls mkdir mktemp mv python3 realpath rm sed seq sleep sort "
    "tail touch true uname wc"
).split()


def copy_of_setup(folder: Path, packages: str = "# none\n") -> Path:
    (folder / "scripts").mkdir(parents=True)
    (folder / "scripts/debian-packages.txt").write_text(packages)
    (folder / "scripts/requirements.txt").write_text("# none\n")
    shutil.copy(SCRIPTS / "setup_steps.sh", folder / "scripts")
    return Path(shutil.copy(SETUP, folder / "scripts"))


@pytest.mark.parametrize("name", ["with blank", "a;b", "a:b", "it's", "a$b", "tab\there", "a[1]"])
def test_a_folder_that_catkin_cannot_take_is_refused_in_one_line_before_anything_is_done(tmp_path, name):
    setup = copy_of_setup(tmp_path / name)
    before = sorted(tmp_path.rglob("*"))
    ended = subprocess.run([setup, "--no-build"], capture_output=True, text=True, timeout=60)
    assert ended.returncode == 1 and ended.stdout == ""
    assert ended.stderr.startswith("[setup] ERROR: the folder '") and ended.stderr.count("\n") == 1 and "move it" in ended.stderr
    assert sorted(tmp_path.rglob("*")) == before


@pytest.mark.parametrize("name", ["plain", "größe", "a+b-c_d.e~1"])
def test_other_folders_are_taken(tmp_path, name):
    ended = subprocess.run([copy_of_setup(tmp_path / name), "--no-build"], capture_output=True, text=True, timeout=120)
    assert ended.returncode == 0 and "ready" in ended.stdout, ended.stderr


def test_a_second_setup_says_that_it_waits_and_goes_on_when_the_first_has_ended(tmp_path):
    setup = copy_of_setup(tmp_path)
    with subprocess.Popen(
        ["flock", str(tmp_path / "scripts"), "sh", "-c", "echo locked; cat"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as first:
        assert first.stdout.readline() == "locked\n"
        with subprocess.Popen([setup, "--no-build"], stdout=subprocess.PIPE, text=True) as second:
            line = second.stdout.readline()
            assert "another scripts/setup is at work" in line and "waiting" in line
            assert second.poll() is None
            first.stdin.close()
            rest = second.communicate(timeout=120)[0]
    assert second.returncode == 0 and "ready" in rest


class Machine:
    """A folder of programs that stand in for a bare machine's; what they are asked is noted in ``events``, in its order."""

    def __init__(self, folder: Path):
        self.folder, self.events = folder, folder / "events"
        self.bin = folder / "bin"
        self.bin.mkdir()
        for tool in TOOLS:
            (self.bin / tool).symlink_to(shutil.which(tool))
        self.play("dpkg-query", f"cat {folder}/installed 2>/dev/null || true")
        self.play("apt-cache", "printf 'g++\\nrviz\\n'")
        # what is installed is there from then on
        self.play(
            "apt-get",
            f"""
            case "$*" in
              *--download-only*) echo download >> {self.events} ;;
              *" install "*) echo install >> {self.events}
                  for name in "$@"; do echo "$name install ok installed" >> {folder}/installed; done ;;
              *update*) echo update >> {self.events} ;;
            esac""",
        )
        self.play("catkin", f"echo 'build begins' >> {self.events}; echo 'build ends' >> {self.events}")
        self.setup = copy_of_setup(folder / "clone", "# section: build\ng++\n# section: demo\nrviz\n")
        (folder / "clone/scripts/needed_packages.py").write_text("print('arm')\n")
        (folder / "clone/scripts/forget_moved.py").write_text("")
        (folder / "clone/.catkin_tools/profiles/default").mkdir(parents=True)
        (folder / "clone/.catkin_tools/profiles/default/config.yaml").write_text("cmake_args:\n- -DX=1\n")
        (folder / "clone/.python").mkdir()  # nothing is asked of PyPI
        stamp = subprocess.run(["/usr/bin/python3", "-V"], capture_output=True, text=True, check=True).stdout.strip()
        (folder / "clone/.python/.made-from").write_text(f"{stamp} # none\n")

    def play(self, name, script):
        path = self.bin / name
        path.unlink(missing_ok=True)
        path.write_text(f"#!/bin/bash\n{script}\n")
        path.chmod(0o755)

    def run(self, *arguments, before=(), **environment):
        return subprocess.run(
            [*before, self.setup, *arguments],
            capture_output=True,
            text=True,
            timeout=60,
            stdin=subprocess.DEVNULL,
            env={"PATH": str(self.bin), "HOME": str(self.folder), **environment},
        )

    def tick(self):
        """Until what is written now is newer than what the last set-up wrote: a fast machine writes both in one tick of the clock."""
        ended = max((path.stat().st_mtime_ns for path in (self.folder / "clone").rglob("built*")), default=0)
        probe = self.folder / "probe"
        probe.touch()
        while probe.stat().st_mtime_ns <= ended:
            probe.touch()

    def builds(self):
        return self.seen().count("build")

    def seen(self):
        return self.events.read_text().splitlines() if self.events.exists() else []


@pytest.fixture
def machine(tmp_path):
    return Machine(tmp_path)


def changes(clone):
    """What a user does that the next build has to see."""
    return {
        "a file written": lambda: (clone / "src/arm/robot.cpp").write_text("int i;"),
        "a file removed": lambda: (clone / "src/arm/more.cpp").unlink(),
        "a package added": lambda: (clone / "src/hand").mkdir(),
        "options of the build": lambda: (clone / ".catkin_tools/profiles/default/config.yaml").write_text("cmake_args: []\n"),
        "catkin clean arm": lambda: (clone / "build/arm").rmdir(),
        "catkin clean": lambda: [(clone / "build/arm").rmdir(), (clone / "build").rmdir()],
    }


@pytest.mark.parametrize("what", ["nothing", "what Python compiles", *changes(Path())])
def test_what_has_not_changed_is_not_built_again(machine, what):
    clone = machine.folder / "clone"
    (clone / "src/arm").mkdir(parents=True)
    (clone / "src/arm/more.cpp").write_text("")
    machine.play(
        "catkin",
        f"""
        echo build >> {machine.events}
        mkdir -p {clone}/devel {clone}/build/arm {clone}/.catkin_tools/profiles/default/packages/arm
        sleep 0.05
        echo arm > {clone}/.catkin_tools/profiles/default/packages/arm/devel_manifest.txt  # catkin's own, in every build
        echo 'cmake_args: []' > {clone}/.catkin_tools/profiles/default/build.yaml""",
    )
    assert machine.run().returncode == 0
    assert machine.run().returncode == 0 and machine.builds() == 1
    (clone / "src/arm/__pycache__").mkdir()  # its folder is looked at once more
    assert machine.run().returncode == 0
    before = machine.builds()
    machine.tick()
    if what == "what Python compiles":
        (clone / "src/arm/__pycache__/robot.pyc").write_text("")
    changes(clone).get(what, lambda: None)()
    ended = machine.run()
    assert ended.returncode == 0, ended.stderr
    assert machine.builds() == before + (what in changes(clone))
    assert ("nothing has changed" in ended.stdout) == (what not in changes(clone))


def test_a_build_that_failed_and_that_of_the_demo_are_no_whole_build(machine):
    clone = machine.folder / "clone"
    for folder in ("src", "build", "devel"):
        (clone / folder).mkdir()
    machine.play("catkin", f"echo build >> {machine.events}; exit 1")
    assert [machine.run().returncode for _ in range(2)] == [1, 1] and machine.builds() == 2
    machine.play("catkin", f"echo build >> {machine.events}")
    machine.run("--demo")
    assert machine.run().returncode == 0 and machine.builds() == 4


@pytest.mark.parametrize("options", ["ON", "OFF"])
def test_what_the_demo_built_without_libraries_is_configured_anew_though_catkin_has_forgotten_its_options(machine, options):
    clone = machine.folder / "clone"
    cache = clone / "build/controller_manager/CMakeCache.txt"
    cache.parent.mkdir(parents=True)
    cache.write_text(f"NOETIC_LABS_COMPILED_PLUGINS:BOOL={options}\n")
    machine.play("catkin", f'echo "$@" > {machine.folder}/words; mkdir -p {clone}/devel')
    assert machine.run().returncode == 0
    assert ("--force-cmake" in (machine.folder / "words").read_text().split()) == (options == "OFF")


def test_the_demo_is_built_with_the_workspaces_options_but_without_compiled_plugins_and_tests(machine):
    own = ["-DX=1", "-DNOETIC_LABS_COMPILED_PLUGINS=ON", "-DCATKIN_ENABLE_TESTING=ON"]
    profile = machine.folder / "clone/.catkin_tools/profiles/default/config.yaml"
    profile.write_text("cmake_args:\n" + "".join(f"- {option}\n" for option in own) + "devel_layout: linked\n")
    machine.play("catkin", f'echo "$@" > {machine.folder}/words')
    machine.run("--demo")
    words = (machine.folder / "words").read_text().split()
    assert words[words.index("--cmake-args") + 1 :] == ["-DX=1", "-DNOETIC_LABS_COMPILED_PLUGINS=OFF", "-DCATKIN_ENABLE_TESTING=OFF"]
    machine.run()  # the whole build has them too, but for the tests
    words = (machine.folder / "words").read_text().split()
    assert words[words.index("--cmake-args") + 1 :] == own[:2] + ["-DCATKIN_ENABLE_TESTING=OFF"]
    machine.run("--tests")  # with tests it has the profile's own
    assert "--cmake-args" not in (machine.folder / "words").read_text()


def test_tests_are_compiled_once_they_are_asked_for_and_from_then_on(machine):
    clone = machine.folder / "clone"
    (clone / "src").mkdir()
    (clone / ".catkin_tools/profiles/default/config.yaml").write_text("cmake_args:\n- -DCATKIN_ENABLE_TESTING=ON\n")
    machine.play(
        "catkin",
        f"""
        echo "$*" >> {machine.events}
        mkdir -p {clone}/devel {clone}/build/arm
        case "$*" in *TESTING=OFF*) value=OFF ;; *) value=ON ;; esac
        echo "CATKIN_ENABLE_TESTING:BOOL=$value" > {clone}/build/arm/CMakeCache.txt
        mkdir -p {clone}/build/catkin_tools_prebuild
        cp -n {clone}/build/arm/CMakeCache.txt {clone}/build/catkin_tools_prebuild""",  # once: catkin does not configure it again
    )
    for options in ((), (), ("--tests",), ("--tests",), ()):
        assert machine.run(*options).returncode == 0
    without, with_tests = (event for event in machine.events.read_text().splitlines() if event.startswith("build"))
    assert without.endswith("-DCATKIN_ENABLE_TESTING=OFF")
    assert "--force-cmake" in with_tests and "OFF" not in with_tests
    (clone / "src/robot.cpp").write_text("int i;")
    machine.tick()
    machine.run()
    assert "OFF" not in machine.events.read_text().splitlines()[-1]


def test_with_a_prefix_the_platform_alone_is_built(machine):
    package = machine.folder / "clone/scripts/package"
    package.write_text(f'#!/bin/bash\necho "package $*" >> {machine.events}\n')
    package.chmod(0o755)
    ended = machine.run("--prefix", "/opt/x")
    assert ended.returncode == 0, ended.stderr
    assert "build" not in machine.seen()
    assert [event for event in machine.seen() if event.startswith("package")] == [
        "package --prefix /opt/x --check",
        "package --prefix=/opt/x",
    ]
    assert ended.stdout.splitlines()[-1].endswith("source /opt/x/setup.bash")
    package.write_text(
        """#!/bin/bash
        case "$*" in
          *--check) ;;
          "--prefix=/opt/x -p 1 -j 1") echo 'Errors     << arm:make '"$HOME/arm.log"; exit 1 ;;
          *) echo 'c++: fatal error: Killed signal terminated program cc1plus'; exit 1 ;;
        esac"""
    )
    (machine.folder / "arm.log").write_text("robot.cpp:1:1: error: what is this\n")
    ended = machine.run("--prefix=/opt/x")
    assert ended.returncode == 1 and "one at a time" in ended.stdout
    told = ended.stderr.splitlines()
    assert len(told) == 4 and "package arm" in told[0] and "what is this" in told[1] and "arm.log" in told[2]


@pytest.mark.parametrize("arguments", [["--demo"], []])
def test_nothing_is_installed_while_the_build_is_at_work(machine, arguments):
    machine.play(
        "catkin",
        f"""
        echo 'build begins' >> {machine.events}
        for _ in $(seq {100 if arguments else 0}); do grep -q download {machine.events} && break; sleep 0.05; done
        sleep 0.2
        echo 'build ends' >> {machine.events}""",
    )
    ended = machine.run(*arguments)
    assert ended.returncode == 0, ended.stderr
    events = machine.seen()
    while_building = events[events.index("build begins") : events.index("build ends")]
    assert "install" not in while_building and "update" not in while_building
    if arguments:
        assert "download" in events and events[-1] == "install"


def test_a_second_run_asks_apt_for_nothing(machine):
    assert machine.run("--demo").returncode == 0
    machine.events.unlink()
    assert machine.run("--demo").returncode == 0
    assert machine.seen() == ["build begins", "build ends"]


NO_NETWORK = (
    "echo 'Err:1 http://deb.debian.org/debian bookworm InRelease'; "
    'echo "W: Failed to fetch http://deb.debian.org/debian/dists/bookworm/InRelease  "; '
    "echo \"W: Temporary failure resolving 'deb.debian.org'\"; "
)


@pytest.mark.parametrize(
    "program, script, said",
    [
        ("apt-get", NO_NETWORK + "exit 100", ["apt-get update", "Temporary failure resolving", "http_proxy is not set"]),
        # apt-get itself is content with lists that it could not renew
        ("apt-get", NO_NETWORK + "exit 0", ["apt-get update", "Temporary failure resolving"]),
        ("apt-cache", "true", ["package lists do not have: g++", "Debian 12 and 13 do", "/etc/os-release says"]),
        ("df", "printf 'Filesystem\\nx 100 90 12 90%% /\\n'", ["has 12 MB free and what has to be installed needs about"]),
        ("id", "echo 1000", ["not root and no sudo", "g++"]),
        (
            "apt-get",
            "case \"$*\" in *install*) echo 'E: Unable to correct problems, you have held broken packages.'; exit 100 ;; esac",
            ["apt-get install", "held broken packages"],
        ),
    ],
)
def test_a_fault_before_the_compiler_is_told_in_at_most_five_lines(machine, program, script, said):
    if program == "apt-get" and script.endswith("exit 0"):
        machine.play("apt-cache", "true")
    machine.play(program, script)
    ended = machine.run("--demo", NOETIC_LABS_AGAIN="scripts/demo")
    assert ended.returncode == 1
    lines = ended.stderr.splitlines()
    assert 1 <= len(lines) <= 5 and "build begins" not in machine.seen()
    for words in said:
        assert words in ended.stderr
    if len(lines) > 1:
        assert "log: " in ended.stderr and lines[-1].endswith("run scripts/demo again: it goes on where it stopped")


def test_sudo_without_a_terminal_to_ask_on(machine):
    machine.play("id", "echo 1000")
    machine.play("sudo", "echo 'sudo: a password is required' >&2; exit 1")
    ended = machine.run("--demo")
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1 and "sudo wants a password" in ended.stderr


@pytest.mark.parametrize("name", ["http_proxy", "https_proxy", "no_proxy"])
def test_proxies_reach_apt_through_sudo(machine, name):
    machine.play("id", "echo 1000")
    machine.play("sudo", f'[ "$1" != -n ] || shift; exec env -i PATH={machine.bin} "$@"')  # sudo drops what it does not know
    machine.play("apt-get", f'echo "${name}" >> {machine.events}')
    assert machine.run("--demo", "--no-build", **{name: "there.example:3128"}).returncode == 0
    assert set(machine.seen()) == {"there.example:3128"}


def test_apt_in_other_hands_is_waited_for(machine):
    machine.play(
        "apt-get",
        f"""
        echo "$*" >> {machine.events}
        if [ "$(wc -l < {machine.events})" = 1 ]; then
          echo 'E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 4711 (unattended-upgr)'
          exit 100
        fi""",
    )
    ended = machine.run("--demo", "--no-build")
    assert ended.returncode == 0 and "held by process 4711 (unattended-upgr); waiting up to 600 s" in ended.stdout
    ended = machine.run("--demo", "--no-build", NOETIC_LABS_LOCK_SECONDS="0")
    assert ended.returncode == 0
    machine.play("apt-get", "echo 'E: Could not get lock /var/lib/apt/lists/lock. It is held by process 4711 (apt)'; exit 100")
    ended = machine.run("--demo", "--no-build", NOETIC_LABS_LOCK_SECONDS="0")
    assert ended.returncode == 1 and "held by process 4711 (apt)" in ended.stderr and len(ended.stderr.splitlines()) <= 5


def test_a_mirror_that_breaks_off_is_tried_once_more(machine):
    machine.play(
        "apt-get",
        f"""
        echo "$*" >> {machine.events}
        if [ "$(wc -l < {machine.events})" = 2 ]; then
          echo 'E: Failed to fetch http://deb.debian.org/debian/pool/g++.deb  Connection reset by peer'
          exit 100
        fi""",
    )
    ended = machine.run("--demo", "--no-build")
    assert ended.returncode == 0 and "Connection reset by peer; trying once more" in ended.stdout


@pytest.mark.skipif(os.geteuid() != 0, reason="mounting read-only needs root; others are refused by the same line")
def test_a_read_only_checkout_is_one_line(machine):
    if subprocess.run(["/usr/bin/unshare", "-m", "/bin/true"], capture_output=True).returncode:
        pytest.skip("nothing can be mounted here")
    clone = machine.setup.parent.parent
    ended = machine.run(
        "--demo",
        before=[
            "/usr/bin/unshare",
            "-m",
            "/bin/sh",
            "-c",
            f'/bin/mount --bind {clone} {clone} && /bin/mount -o remount,ro,bind {clone} && exec "$@"',
            "-",
        ],
    )
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1 and "cannot be written to" in ended.stderr


CMAKE_LOG = """-- Using CATKIN_DEVEL_PREFIX: /x
CMake Error at CMakeLists.txt:12 (find_package):
  The package 'angles' is not here: it is in Debian's libangles-dev.


-- Configuring incomplete, errors occurred!
"""


@pytest.mark.parametrize(
    "log, error",
    [
        (CMAKE_LOG, "The package 'angles' is not here"),
        (
            "/a/b.cpp: In function 'int f()':\n/a/b.cpp:3:5: error: 'x' was not declared\nmake: *** [all] Error 2\n",
            "error: 'x' was not declared",
        ),
        (
            "Traceback (most recent call last):\n  File \"x\"\nAttributeError: module 'numpy' has no attribute 'float32'\n",
            "AttributeError: module",
        ),
        ("/usr/bin/ld: x.o: undefined reference to `f()'\ncollect2: error: ld returned 1\n", "undefined reference to"),
        ("g++: fatal error: cannot write: No space left on device\n", "No space left"),
    ],
)
def test_a_build_that_fails_ends_with_package_error_log_and_what_to_run(machine, log, error):
    own = machine.folder / "build.cmake.000.log"
    own.write_text(log)
    machine.play(
        "catkin",
        f"""
        echo 'Starting     >>> gazebo_ros_control'
        for line in $(seq 300); do echo "Abandoned    <<< package_$line"; done
        echo 'Errors     << gazebo_ros_control:cmake {own}'
        echo 'Failed     << gazebo_ros_control:cmake [ Exited with code 1 ]'
        exit 1""",
    )
    ended = machine.run("--demo", NOETIC_LABS_AGAIN="scripts/demo")
    assert ended.returncode == 1
    lines = ended.stderr.splitlines()
    assert len(lines) <= 5 and "Abandoned" not in ended.stdout + ended.stderr and "report" not in ended.stdout + ended.stderr
    assert "catkin build, package gazebo_ros_control" in lines[0] and error in lines[1] and str(own) in ended.stderr
    assert lines[-1].endswith("run scripts/demo again: it goes on where it stopped")


def test_a_compiler_that_was_ended_for_want_of_memory_is_tried_alone(machine):
    machine.play(
        "catkin",
        f"""
        echo "$*" >> {machine.events}
        case "$*" in *"-p 1 -j 1"*) exit 0 ;; esac
        echo 'c++: fatal error: Killed signal terminated program cc1plus'
        exit 1""",
    )
    ended = machine.run("--demo")
    assert ended.returncode == 0 and "one at a time" in ended.stdout
    again = machine.seen()[-2] if machine.seen()[-1] == "install" else machine.seen()[-1]
    assert again.index("-p 1 -j 1") < again.index("--cmake-args")  # what follows that goes to CMake


def test_progress_in_a_log_is_a_line_now_and_then_not_one_for_each_package(machine):
    machine.play("catkin", """for n in $(seq 200); do echo "Starting  >>> p$n"; echo "Finished  <<< p$n  [ 0.1 seconds ]"; done""")
    ended = machine.run("--demo")
    assert ended.returncode == 0 and len(ended.stdout.splitlines()) < 12


def test_the_time_goes_on_while_one_package_is_compiled(machine):
    """On a terminal; and the last line of the build is not lost."""
    machine.play("catkin", """echo "Starting  >>> big"; sleep 3; printf 'Finished  <<< big\\nthe end\\n'""")
    ours, theirs = pty.openpty()
    with subprocess.Popen(
        [machine.setup, "--demo"], stdin=theirs, stdout=theirs, stderr=theirs, env={"PATH": str(machine.bin), "HOME": str(machine.folder)}
    ) as setup:
        os.close(theirs)
        seen = b"".join(iter(lambda: read_end(ours), b"")).decode()
    os.close(ours)
    assert setup.returncode == 0, seen
    times = set(re.findall(r"now big, 0 min (\d\d) s", seen))
    assert len(times) >= 3, seen
    assert (machine.folder / "clone/logs/setup/catkin.log").read_text().splitlines()[-1] == "the end"


def read_end(terminal):
    try:
        return os.read(terminal, 65536)
    except OSError:  # the other end is closed
        return b""


def needed(*arguments):
    return subprocess.run(["/usr/bin/python3", SCRIPTS / "needed_packages.py", *arguments], capture_output=True, text=True, timeout=60)


def test_what_the_demo_builds_is_what_it_needs_to_run():
    found = needed("--without", "theora_image_transport", "--", "arm_gazebo").stdout.split()
    assert {"arm_gazebo", "arm_description", "gazebo_ros", "gazebo_ros_control", "gazebo_msgs", "ode_sim", "xacro"} <= set(found)
    for for_tests_only in ("controller_manager_tests", "control_test_robots"):
        assert for_tests_only not in found
    assert "theora_image_transport" not in found and "theora_image_transport" in needed("gazebo_plugins").stdout.split()
    assert found == sorted(set(found))


def test_an_unknown_package_is_one_line():
    ended = needed("no_such_package")
    assert ended.returncode == 2 and ended.stdout == "" and "this workspace has no package no_such_package" in ended.stderr
