"""Logs for students: which lines are errors, which came first, and what they usually mean."""

from __future__ import annotations

import re
import signal
from itertools import takewhile

# All text comes from submissions: each pattern takes time in proportion to what it reads, and a line is cut first.
_LONGEST = 2000  # characters of a line that are looked at
_COLOURS = re.compile(r"\x1b\[[0-9;]{0,40}m|\x1b\][^\x07\x1b\n]{0,200}\x07")
_ERROR = re.compile(
    r"\[ ?(ERROR|FATAL)\]|Traceback \(most recent call last\)|process has died|RLException|^ERROR|^CMake Error|\berror:|XacroException"
    r"|ResourceNotFound|Segmentation fault|No such file or directory|\*\*\* \[|undefined reference|^Invalid "
)
# What happens whenever a program is ended, and what upstream prints as an error although nothing is wrong.
_HARMLESS = re.compile(r"No p gain specified|escalating to SIG|Error 2$")
# What a program says that does not take its arguments. 'error' counts where a line begins: nodes print errors of their tracking, too.
_REFUSAL = re.compile(
    r"\[ ?(ERROR|FATAL)\]|(^|[\]:] *)error\b|\b(usage|synopsis|invalid|illegal|wrong|bad|missing|unknown|unrecogni[sz]ed|expect(s|ed)?|must"
    r"|can(no|'|)t|can not|could not|failed to|not (a|an|enough|allowed|valid)|out of range|too (few|many|large|small|big)|requires?"
    r"|refused?|rejected)\b",
    re.IGNORECASE,
)
# Signals by which a program ends that did something it may not; abort is how C++ ends at an exception that nobody catches.
_CRASHES = frozenset(map(int, (signal.SIGILL, signal.SIGTRAP, signal.SIGABRT, signal.SIGBUS, signal.SIGFPE, signal.SIGSEGV, signal.SIGSYS)))
_MEANINGS: list[tuple[re.Pattern, str]] = [
    (re.compile(pattern), meaning)
    for pattern, meaning in (
        (
            r"Could not find a package configuration file|Could not find package configuration file|find_package\(\w+\)",
            "CMake did not find a package that CMakeLists.txt asks for. Is it named in package.xml, and does it exist?",
        ),
        (
            r"fatal error: [^ ]{1,200}\.h(pp)?: No such file",
            "A header was not found. Is its package in find_package(catkin ... COMPONENTS) and in "
            "include_directories(${catkin_INCLUDE_DIRS})?",
        ),
        (r"undefined reference", "The linker misses a library: target_link_libraries(... ${catkin_LIBRARIES})."),
        (r"error: ", "The compiler refuses this line; the first error is the one to mend, the others often follow from it."),
        (
            r"ResourceNotFound: (\S+)",
            "A launch file or xacro names a package or file that is not there. Mind the spelling, and absolute paths of your own machine.",
        ),
        (
            r"is neither a launch file|is not a launch file name|\.launch\] is neither",
            "roslaunch did not find the launch file: is it in the folder launch of that package, under exactly this name?",
        ),
        (
            r"Invalid <param> tag|xacro[^ ]{0,80}[: ]+.{0,80}(error|Exception)|XacroException|undefined (macro|symbols)",
            "The robot description could not be made: run xacro by hand on the file to see the line.",
        ),
        (r"RLException: unused args", "The launch file does not declare an argument that was given: <arg name=... default=.../>."),
        (r"RLException|XML(Parse)?Error|not well-formed", "The launch file is not valid."),
        (
            r"Couldn't find executable|Cannot locate node of type",
            "A program is named that was not built or is not executable: add_executable in CMakeLists.txt, or chmod +x for a script.",
        ),
        (
            r"Controller Spawner couldn't find|Waiting for .{0,200}controller_manager",
            "The spawner looks for a controller manager in another namespace "
            "than the gazebo_ros_control plugin's: <robotNamespace> and the spawner's ns must be the same.",
        ),
        (
            r"Could not load controller|type was not specified|no controller.{0,80} named",
            "A controller is spawned whose parameters are not loaded, or in another namespace: look at rosparam list.",
        ),
        (
            r"Could not find joint|Could not find resource|does not exist in|No joint",
            "A controller names a joint that has no transmission of that kind of interface in the URDF.",
        ),
        (r"Traceback", "A Python program ended by an error; the last line of the traceback says which."),
        (r"Segmentation fault|exit code -11", "A program wrote or read outside of its memory."),
        (r"process has died", "A node ended by itself; look for what it printed just before."),
        (r"No space left on device", "The disk that a submission gets is full."),
    )
]


def lines_of(text: str) -> list[str]:
    """The lines of ``text`` that are not empty, without colours; very long ones are cut."""
    return [line.rstrip() for line in (_COLOURS.sub("", whole[: 2 * _LONGEST])[:_LONGEST] for whole in text.splitlines()) if line.strip()]


def _is_error(line: str) -> bool:
    return bool(_ERROR.search(line)) and not _HARMLESS.search(line) and not _makes_own(line)


def _makes_own(line: str) -> bool:
    """make's own last words, which follow those of whoever failed: ``make[1]: *** [Makefile:146: all] Error 2``."""
    target = line.find("*** [", line.find("make")) if "make" in line else -1
    return target >= 0 and ("Makefile" in line[target:] or "all" in line[target:])


def error_lines(text: str) -> list[str]:
    """Errors in ``text``, in the order in which they were printed; CMake's with the sentence that it says in the lines below."""
    lines = lines_of(text)
    return [_whole(lines, i) for i, line in enumerate(lines) if _is_error(line)]


def _whole(lines: list[str], index: int) -> str:
    more = takewhile(lambda line: line.startswith("  "), lines[index + 1 : index + 5]) if lines[index].startswith("CMake Error") else ()
    return " ".join([lines[index], *(line.strip() for line in more)])


def refusal(text: str) -> str:
    """The first line of ``text`` by which a program says that it does not take its arguments, '' when there is none."""
    return next((line for line in lines_of(text) if _REFUSAL.search(timeless(line))), "")


def crashed(code: int | None, text: str) -> bool:
    """Whether a program that ended with ``code`` and said ``text`` crashed: by a signal, which a shell and bwrap tell as 128 + its
    number, or in Python.
    """
    return code is not None and (code < 0 or code - 128 in _CRASHES) or "Traceback (most recent call last)" in text


def timeless(line: str) -> str:
    """A line of a log without its wall clock's time, which differs from run to run."""
    return re.sub(r"\[(WallTime: )?\d{9,}\.\d+(, )?", "[", line).replace("[]: ", "")


def meaning(line: str) -> str:
    """What the error ``line`` usually comes from, '' for one that nobody knows."""
    return next((text for pattern, text in _MEANINGS if pattern.search(line)), "")


def excerpt(text: str, before: int = 2, after: int = 6, most: int = 40) -> list[str]:
    """The first cause in ``text`` and what stands round it, then other errors, each once; the last lines when there is no error.

    :param before, after: lines round the first cause. :param most: lines in all
    """
    lines = lines_of(text)
    errors = [index for index, line in enumerate(lines) if _is_error(line)]
    if not errors:
        return [line[:300] for line in lines[-8:]]
    first = errors[0]
    shown = lines[max(0, first - before) : first + after]
    seen = {re.sub(r"[\d.]+", "#", line) for line in shown}
    for index in errors:
        shape = re.sub(r"[\d.]+", "#", lines[index])
        if index >= first + after and shape not in seen:
            seen.add(shape)
            shown.append(lines[index])
    return [line[:300] for line in shown[:most]]


def first_cause(text: str) -> tuple[str, str]:
    """(line, what it means) of the first error in ``text``; ('', '') when nothing is one."""
    for line in error_lines(text):
        return timeless(line)[:300], meaning(line)
    return "", ""
