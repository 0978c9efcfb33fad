"""Packages of ROS 2 messages that PyPI has not, from their definitions: ``scripts/setup --ros2`` runs this with ROS 2's own Python.

``python make_messages.py FOLDER...`` reads each FOLDER (a package's ``msg``, ``srv`` and ``action`` in ROS 2's form) and adds the package,
as ROS 2's generators and the compiler make it, to the virtual environment whose Python runs this.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from multiprocessing.pool import ThreadPool
from pathlib import Path

KINDS = ("msg", "srv", "action")
DEBIAN = "/usr/lib/python3/dist-packages"  # the generators need empy and catkin_pkg, of which PyPI has no wheels
ALWAYS = ("action_msgs", "builtin_interfaces", "service_msgs", "unique_identifier_msgs")  # what services and actions are made of
RUNTIME = ("rosidl_runtime_c", "rosidl_typesupport_c", "rcutils")
INTROSPECTION = "introspection_c"
BOOTSTRAPPED = {"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"}  # the wheels' start-up hook would start Python again for its libraries
GENERATED = ("rosidl_generator_c", "rosidl_generator_py")  # libraries that one of ours stands for
PARTS = ("py", "fastrtps_c", "c")  # folders that the generators write
FASTRTPS = ("rosidl_typesupport_fastrtps_c", "rosidl_typesupport_fastrtps_cpp", "fastcdr", "rmw")


class Package:
    """One package and where it goes."""

    def __init__(self, source: Path, prefix: Path) -> None:
        self.source, self.prefix, self.name = source, prefix, source.name
        self.files = sorted(file.relative_to(source) for kind in KINDS for file in source.glob(f"{kind}/*.{kind}"))
        used = {name for file in self.files for name in re.findall(r"^(\w+)/\w", (source / file).read_text(), re.MULTILINE)}
        self.needs = sorted((used | set(ALWAYS)) - {self.name})

    def generate(self, out: Path) -> Path:
        """Sources, below a folder that is to be on the path of headers."""
        self._rosidl(out / "raw", self.files)
        for part in PARTS:
            shutil.copytree(out / "raw" / part, out / "include" / self.name, dirs_exist_ok=True)
        # Of a message and an action of one name the generators describe the action twice.
        actions = {file.stem for file in self.files if file.parts[0] == "action"}
        for file in self.files:
            if file.stem in actions and file.parts[0] != "action":
                self._rosidl(out / "alone" / file.stem, [file])
                detail = Path(file.parts[0], "detail")
                for made in (out / "alone" / file.stem).glob(f"*/{detail}/*"):
                    shutil.copy(made, out / "include" / self.name / detail)
        for header in (out / "raw" / INTROSPECTION).rglob("*.h"):  # its sources have names of others
            shutil.copy(header, out / "include" / self.name / header.relative_to(out / "raw" / INTROSPECTION))
        return out / "include"

    def _rosidl(self, out: Path, files: list[Path]) -> None:
        words = ("-t", "c", "-t", "py", "-ts", "c", "-ts", "fastrtps_c", "-ts", "introspection_c")
        script = "import sys; from rosidl_cli.cli import main; sys.exit(main())"
        found = {"PYTHONPATH": DEBIAN, "AMENT_PREFIX_PATH": str(self.prefix), "PATH": "/usr/bin:/bin"}
        found["LD_LIBRARY_PATH"] = f"{self.prefix}/lib"
        subprocess.run(
            [sys.executable, "-c", script, "generate", "-o", out, *words, "-I", self.prefix / "share", self.name, *map(str, files)],
            check=True,
            cwd=self.source,
            env={**found, **BOOTSTRAPPED},
            stdout=subprocess.DEVNULL,
        )

    def compile(self, headers: Path) -> None:
        """Three libraries, of which the first finds the others at run time, and the module that Python imports."""
        here, lib = headers / self.name, self.prefix / "lib"
        import numpy

        installed = self.prefix / "include"
        includes = [headers, installed, *installed.iterdir(), sysconfig.get_paths()["include"], numpy.get_include()]
        sources = [path for path in here.rglob("*.c*") if path.suffix in (".c", ".cpp") and ".ep." not in path.name]
        fast = [path for path in sources if path.name.endswith("__type_support_c.cpp")]
        entry = here / f"_{self.name}_s.ep.rosidl_typesupport_c.c"
        first, second = f"lib{self.name}__rosidl_typesupport_c.so", f"lib{self.name}__rosidl_typesupport_fastrtps_c.so"
        base = [*(f"{name}__{end}" for end in (*GENERATED, "rosidl_typesupport_c") for name in self.needs), *RUNTIME]
        self._link(lib / first, [path for path in sources if path not in fast], includes, base)
        for end in GENERATED:  # packages that use this one look for these
            (lib / f"lib{self.name}__{end}.so").unlink(missing_ok=True)
            (lib / f"lib{self.name}__{end}.so").symlink_to(first)
        own = f"{self.name}__rosidl_typesupport_c"
        self._link(lib / second, fast, includes, [own, *(f"{n}__rosidl_typesupport_fastrtps_c" for n in self.needs), *FASTRTPS, *base])
        third = lib / f"lib{self.name}__rosidl_typesupport_introspection_c.so"
        needed = [f"{n}__rosidl_typesupport_introspection_c" for n in self.needs]
        inner = list((headers.parent / "raw" / INTROSPECTION).rglob("*.c"))
        self._link(third, inner, includes, [own, *needed, "rosidl_typesupport_introspection_c", *base])
        self._link(here / f"{self.name}_s__rosidl_typesupport_c.so", [entry], includes, [own, *base])

    def _link(self, target: Path, sources: list[Path], includes: list[object], libraries: list[str]) -> None:
        paths = [f"-I{folder}" for folder in includes]

        def compiled(source: Path) -> Path:
            compiler = ["g++", "-std=c++17"] if source.suffix == ".cpp" else ["gcc"]
            subprocess.run([*compiler, "-O1", "-fPIC", "-w", *paths, "-c", source, "-o", source.with_suffix(".o")], check=True)
            return source.with_suffix(".o")

        with ThreadPool(os.cpu_count()) as pool:
            objects = pool.map(compiled, sources)
        lib = self.prefix / "lib"
        names = [str(path) for name in dict.fromkeys(libraries) for path in sorted(lib.glob(f"lib{name}.so*"))[:1]]
        subprocess.run(["g++", "-shared", "-o", target, *objects, "-Wl,--no-as-needed", *names], check=True)

    def install(self, headers: Path) -> None:
        here, share = headers / self.name, self.prefix / "share"
        module = Path(sysconfig.get_paths()["purelib"]) / self.name
        module.mkdir(exist_ok=True)
        (module / "__init__.py").touch()
        shutil.copy(here / f"{self.name}_s__rosidl_typesupport_c.so", module)
        for kind in {file.parts[0] for file in self.files}:
            shutil.copytree(
                here / kind, module / kind, dirs_exist_ok=True, ignore=lambda _, names: [n for n in names if not n.endswith(".py")]
            )
            shutil.copytree(
                here / kind, self.prefix / "include" / self.name / self.name / kind, dirs_exist_ok=True,
                ignore=lambda _, names: [n for n in names if "." in n and not n.endswith(".h")],
            )  # fmt: skip
            for file in [*here.glob(f"{kind}/*.json"), *here.glob(f"tmp/{kind}/*.idl"), *self.source.glob(f"{kind}/*.{kind}")]:
                (share / self.name / kind).mkdir(parents=True, exist_ok=True)
                shutil.copy(file, share / self.name / kind)
        for resource, text in (("packages", ""), ("rosidl_interfaces", "\n".join(map(str, self.files)))):
            (share / "ament_index" / "resource_index" / resource / self.name).write_text(text)


def main() -> None:
    prefix = Path(sys.prefix)
    # Wheels say their plug-ins twice, which the generators take for two plug-ins of one name.
    for old in Path(sysconfig.get_paths()["purelib"]).glob("rosidl_*.egg-info"):
        shutil.rmtree(old)
    for folder in sys.argv[1:]:
        package = Package(Path(folder).resolve(), prefix)
        with tempfile.TemporaryDirectory() as out:
            headers = package.generate(Path(out))
            package.compile(headers)
            package.install(headers)


if __name__ == "__main__":
    main()
