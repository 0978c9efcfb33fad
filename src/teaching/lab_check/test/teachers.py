"""Who examines, and may or may not do much on this machine: root, root without control groups, and a user."""

import json
import os
import pathlib
import shutil
import subprocess
import sys

NOBODY = 65534
WHO = ("root", "root without control groups", "a user")
CHECK = [sys.executable, "-P", "-c", "import sys; from lab_check.cli import check; sys.exit(check())"]
MANIFEST = (
    "<package format='2'><name>{}</name><version>1.0.0</version><description>x</description><maintainer email='mallory@example.org'>x"
    "</maintainer><license>x</license><buildtool_depend>catkin</buildtool_depend>{}</package>"
)
CMAKE = "cmake_minimum_required(VERSION 3.10)\nproject({})\nfind_package(catkin REQUIRED)\ncatkin_package()\n"


class Teacher:
    """``name``: one of ``WHO``; ``place``: a folder of its own."""

    def __init__(self, name: str, place: pathlib.Path):
        self.name, self.place = name, place

    def words(self, words):
        if self.name == "a user" and os.getuid() == 0:
            shutil.chown(self.place, NOBODY, NOBODY)
            return ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", "env", f"HOME={self.place}", *words]
        if self.name == "root without control groups":
            hide = 'mount -t tmpfs none /sys/fs/cgroup && exec "$@"'
            return ["unshare", "--mount", "sh", "-c", hide, "sh", *words]
        return words

    def examine(self, spec: str, package: str, files: dict, cwd=None, **environment):
        """A package of these files, by that spec. Returns the report, the folder of the report and what ``check`` said."""
        (self.place / "spec.yaml").write_text(spec)
        for name, text in files.items():
            file = self.place / "mallory" / package / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
            file.chmod(0o755)
        out = self.place / "out"
        words = self.words([*CHECK, str(self.place / "spec.yaml"), str(self.place / "mallory"), "--out", str(out), "--no-films"])
        done = subprocess.run(words, capture_output=True, text=True, env={**os.environ, **environment}, cwd=cwd, timeout=900)
        assert done.returncode in (0, 1), done.stdout + done.stderr
        result = json.loads((out / "report.json").read_text())
        assert not result["fault"], result["fault"]
        return result, out, done.stdout + done.stderr

    def check(self, spec: str, script: str, cmake="", cwd=None, **environment):
        """A package ``evil`` whose configuration runs ``script`` in Python. Returns the report and what was printed while it was built."""
        files = {
            "package.xml": MANIFEST.format("evil", ""),
            "attack.py": script,
            "CMakeLists.txt": CMAKE.format("evil")
            + "execute_process(COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/attack.py)\n"
            + cmake,
        }
        result, out, _ = self.examine(spec, "evil", files, cwd, **environment)
        return result, (out / "build.log").read_text()


def reasons(result) -> str:
    """Of all verdicts."""
    return "\n".join(verdict["reason"] for task in result["tasks"] for verdict in task["verdicts"])
