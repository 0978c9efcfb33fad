"""The line that says how far long work is: on a terminal, and nowhere else."""

import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios

WORK = """
import sys, threading
from node_signals.progress import progress
with progress({count}, "counting", "things", quiet={quiet}, even={even}) as bar:
    for number in range(3):
        bar.update()
        bar.line(f"done {{number}}")
    bar.at(3, "the last")
    {wait}
"""


def on_terminal(script):
    """What a person sees: all that was written to a terminal of 100 columns."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 40, 100, 0, 0))
    process = subprocess.Popen([sys.executable, "-c", script], stdin=theirs, stdout=theirs, stderr=theirs)
    os.close(theirs)
    seen = b""
    while True:
        try:
            seen += os.read(ours, 65536)
        except OSError:  # the other end is closed
            break
    os.close(ours)
    assert process.wait() == 0, seen
    return seen.decode()


def script(count=3, quiet=False, even=False, wait="pass"):
    return WORK.format(count=count, quiet=quiet, even=even, wait=wait)


def test_a_terminal_shows_how_many_of_how_many_and_what_is_done_now():
    seen = on_terminal(script())
    assert "counting:" in seen and "3/3 things" in seen and "the last" in seen
    assert [line.strip() for line in re.findall(r"done \d", seen)] == ["done 0", "done 1", "done 2"]
    assert re.search(r"\[\d\d:\d\d\]", seen), "the time that has passed"
    assert re.search(r"\[\d\d:\d\d<\d\d:\d\d\]", on_terminal(script(even=True))), "and the time that is left"


def test_the_time_goes_on_while_nothing_is_done():
    shown = on_terminal(script(count=None, wait="threading.Event().wait(2.5)"))
    assert len(set(re.findall(r"counting: 3 things \[(\d\d:\d\d)\]", shown))) >= 2, shown


def test_a_log_gets_the_lines_alone():
    done = subprocess.run([sys.executable, "-c", script()], capture_output=True, text=True, check=True)
    assert done.stdout == "done 0\ndone 1\ndone 2\n" and done.stderr == ""


def test_quiet_shows_nothing_on_a_terminal_either():
    assert "counting" not in on_terminal(script(quiet=True))


def test_without_tqdm_the_work_is_done_all_the_same():
    seen = on_terminal("import sys; sys.modules['tqdm'] = None\n" + script())
    assert "counting" not in seen and "done 2" in seen
