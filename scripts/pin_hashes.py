#!/usr/bin/python3
"""scripts/pin_hashes.py [FILE...]: the hashes of scripts/requirements*.txt anew, after a version in them was changed.

pip is asked which file it would take on Debian 12 and 13 (Python 3.11 and 3.13) on x86-64 and arm64; the hash of each becomes a line
below its requirement, and from then on pip takes no other file (``--require-hashes``). Comments and order stay.
"""

import argparse
import json
import re
import subprocess
import sys
from pathlib import Path

SCRIPTS = Path(__file__).resolve().parent
PYTHONS = ("3.11", "3.13")
MACHINES = ("x86_64", "aarch64")
GLIBC = (36, 35, 34, 31, 28, 27, 26, 24, 17, 12, 5)  # minor versions that Debian 12 can run
LEGACY = ("manylinux2014", "manylinux2010", "manylinux1")
_REQUIREMENT = re.compile(r"^([A-Za-z0-9._-]+==[^\s\\#]+)")
_PIP = [
    sys.executable,
    "-m",
    "pip",
    "--disable-pip-version-check",
    "install",
    "-q",
    "--dry-run",
    "--ignore-installed",
    "--no-deps",
    "--report",
    "-",
]


def wheel(requirement: str, python: str, machine: str) -> str | None:
    """sha256 of the wheel that pip takes there; None where there is none."""
    platforms = [f"manylinux_2_{minor}_{machine}" for minor in GLIBC] + [f"{name}_{machine}" for name in LEGACY]
    words = [word for name in (*platforms, f"linux_{machine}") for word in ("--platform", name)]
    return _asked([*words, "--python-version", python, "--only-binary", ":all:", "--target", "nowhere", requirement])


def source(requirement: str) -> str | None:
    """sha256 of the source archive; None where there is none."""
    return _asked(["--no-binary", requirement.partition("==")[0], requirement])


def _asked(words: list[str]) -> str | None:
    done = subprocess.run([*_PIP, *words], capture_output=True, text=True)
    if done.returncode:
        return None
    return json.loads(done.stdout)["install"][0]["download_info"]["archive_info"]["hashes"]["sha256"]


def hashes(requirement: str) -> set[str]:
    """
    :raises SystemExit: neither a wheel nor a source archive is to be had for one of the machines
    """
    found: set[str] = set()
    for python in PYTHONS:
        for machine in MACHINES:
            one = wheel(requirement, python, machine) or source(requirement)
            if one is None:
                print(f"{requirement}: nothing for Python {python} on {machine}", file=sys.stderr)
            else:
                found.add(one)
    if not found:
        raise SystemExit(f"scripts/pin_hashes.py: pip finds no {requirement}")
    return found


def pinned(text: str) -> str:
    """A requirements file with the hashes of today's files."""
    lines = []
    for line in text.splitlines():
        requirement = _REQUIREMENT.match(line)
        if requirement:
            lines.append(" \\\n".join([requirement[1], *(f"    --hash=sha256:{one}" for one in sorted(hashes(requirement[1])))]))
        elif not line.lstrip().startswith("--hash"):
            lines.append(line)
    return "\n".join(lines) + "\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="*", type=Path, default=sorted(SCRIPTS.glob("requirements*.txt")))
    for file in parser.parse_args().files:
        file.write_text(pinned(file.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
