"""Near-identical submissions, by runs of tokens that they share (winnowing: Schleimer, Wilkerson and Aiken, 2003).

Debian's ``similarity-tester`` reads C, C++ and text, but neither Python, XML nor YAML, in which half of a robot is written; here the tokens
are those of any language: names, numbers and signs, without comments, blanks and layout.
"""

from __future__ import annotations

import os
import pathlib
import re
import tempfile
import zlib
from collections import Counter
from dataclasses import dataclass
from itertools import combinations

from ..isolation.staging import Staged, StagingError, unpack, within_bounds
from ..isolation.untrusted_files import read_regular, walk

_ENDINGS = {".cpp", ".cc", ".c", ".h", ".hpp", ".py", ".launch", ".xacro", ".urdf", ".yaml", ".world", ".sdf"}
# One that is not closed goes to the end: to look for its end again from each beginning would take the square of the text.
_COMMENT = re.compile(
    r"//[^\n]*|/\*.*?(?:\*/|\Z)|<!--.*?(?:-->|\Z)|^[ \t]*#(?!include|define|if|endif|pragma)[^\n]*", re.DOTALL | re.MULTILINE
)
_TOKEN = re.compile(r"[A-Za-z_]\w*|\d+(?:\.\d+)?|[^\s\w]")
_RUN, _WINDOW, _LARGEST, _COMMON = 12, 8, 300_000, 0.5
_MOST_OF_SOURCE, _MOST_IN_ALL = 10_000_000, 200e6  # bytes of sources that are compared, of an archive that is unpacked for it
NEAR = 0.8  # share of the smaller one's prints that is near-identical


@dataclass(frozen=True)
class Pair:
    first: str
    second: str
    share: float


def prints(submission: pathlib.Path) -> set[int]:
    """Winnowed prints of all source files of ``submission``, a folder, zip or tar; empty for what is neither."""
    if submission.is_dir():
        return _of_folder(submission) if submission.resolve() != pathlib.Path("/") else set()
    with tempfile.TemporaryDirectory(prefix="lab_check_similar.") as place:
        try:
            with within_bounds():
                unpack(submission, pathlib.Path(place), _MOST_IN_ALL, Staged())
        except StagingError:  # what could be read until then counts
            pass
        return _of_folder(pathlib.Path(place))


def _of_folder(folder: pathlib.Path) -> set[int]:
    found: set[int] = set()
    left = _MOST_OF_SOURCE
    for name, _ in walk(folder, left_out=(".git", "build", "devel")):
        if os.path.splitext(name)[1] in _ENDINGS and left > 0:
            try:
                data = read_regular(folder, name, _LARGEST)
            except OSError:  # a link, a pipe, or not ours to read
                continue
            if len(data) < _LARGEST:
                left -= len(data)
                found |= of_text(data.decode("utf-8", "replace"))
    return found


def of_text(text: str) -> set[int]:
    """Winnowed prints of ``text``."""
    tokens = _TOKEN.findall(_COMMENT.sub(" ", text))
    hashes = [zlib.crc32("\0".join(tokens[i : i + _RUN]).encode()) for i in range(max(len(tokens) - _RUN + 1, 0))]
    return {min(hashes[i : i + _WINDOW]) for i in range(max(len(hashes) - _WINDOW + 1, 1))} if hashes else set()


def pairs(submissions: dict[str, pathlib.Path], near: float = NEAR) -> list[Pair]:
    """Pairs of ``submissions`` (paths by name) whose shares are ``near`` or more, most alike first.

    What more than half of a class of eight or more shares, the handed-out part, does not count.
    """
    found = {name: prints(path) for name, path in submissions.items()}
    if len(found) >= 8:
        often = Counter(p for these in found.values() for p in these)
        handed_out = {p for p, count in often.items() if count > _COMMON * len(found)}
        found = {name: these - handed_out for name, these in found.items()}
    alike = []
    for (first, a), (second, b) in combinations(sorted(found.items()), 2):
        if min(len(a), len(b)) >= 10:
            share = len(a & b) / min(len(a), len(b))
            if share >= near:
                alike.append(Pair(first, second, share))
    return sorted(alike, key=lambda pair: (-pair.share, pair.first, pair.second))


def main(arguments: list[str] | None = None) -> int:
    from ..cli import Parser

    parser = Parser(prog="rosrun lab_check similar", description="Point out near-identical submissions.")
    parser.add_argument("submissions", type=pathlib.Path, nargs="+")
    parser.add_argument("--least", type=float, default=NEAR, help="share in common that counts; default %(default)s")
    options = parser.parse_args(arguments)
    for pair in pairs({str(path): path for path in options.submissions}, options.least):
        print(f"{pair.share:6.1%} {pair.first} {pair.second}")
    return 0
