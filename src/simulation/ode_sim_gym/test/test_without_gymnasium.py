"""Where Gymnasium is not installed, who asks for an environment reads in one line what to do."""

import subprocess
import sys


def test_one_line_says_what_to_install():
    hide = "import sys; sys.modules['gymnasium'] = None; import ode_sim_gym"  # None: as if it were not installed
    done = subprocess.run([sys.executable, "-c", hide], capture_output=True, text=True, timeout=60)
    last = done.stderr.strip().splitlines()[-1]
    assert done.returncode == 1 and last.startswith("ImportError: ") and "scripts/setup --teaching" in last
