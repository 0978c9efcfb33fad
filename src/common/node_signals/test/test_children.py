"""Processes that a child leaves behind."""

import subprocess
import sys

PROGRAM = """
import subprocess
from node_signals.children import adopt_orphans, wait_for_all
adopt_orphans()
subprocess.Popen(["sh", "-c", "(read line; sleep 0.3; echo done > left) <&0 &"], stdin=subprocess.PIPE).wait()
wait_for_all()
print(open("left").read().strip())
wait_for_all()  # nobody is left
"""


def test_what_a_child_leaves_behind_is_waited_for(tmp_path):
    done = subprocess.run([sys.executable, "-c", PROGRAM], cwd=tmp_path, capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.stderr, done.returncode) == ("done\n", "", 0)
