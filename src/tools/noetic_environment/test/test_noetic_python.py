"""Scripts for Noetic's Python (3.8, NumPy 1.17, PyYAML 5.3, Matplotlib 3.1) run with Debian's."""
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "noetic_python"

#: What a script of Noetic's time writes, and what it prints.
SCRIPTS = {
    "import yaml; print(yaml.load('a: [1, 2.5]'))": "{'a': [1, 2.5]}",
    "import yaml; print(list(yaml.load_all('a\\n---\\nb')))": "['a', 'b']",
    "import yaml; print(yaml.load('a: 2020-01-01', Loader=yaml.BaseLoader))": "{'a': '2020-01-01'}",
    "import numpy as np; print(np.float(2), np.int(3.7), np.array([1], dtype=np.bool), np.asscalar(np.array([4])))": "2.0 3 [ True] 4",
    "import numpy as np; print(np.product([2, 3]), np.Inf, np.NaN, np.float_(1), np.alltrue([1]))": "6 inf nan 1.0 True",
    "import collections; print(isinstance({}, collections.Mapping), issubclass(list, collections.Iterable))": "True True",
    "from collections import MutableMapping, OrderedDict; print(isinstance(OrderedDict(), MutableMapping))": "True",
    "from fractions import gcd; print(gcd(12, 18))": "6",
    "import threading; print(threading.current_thread().isAlive())": "True",
    "import base64; print(base64.decodestring(base64.encodestring(b'ab')))": "b'ab'",
    "import inspect; print(inspect.getargspec(lambda a, b=1, *c: 0).args)": "['a', 'b']",
    "import PyKDL; print(PyKDL.Joint().getTypeName(), PyKDL.Joint('j', PyKDL.Joint.RotZ).getTypeName(),"
    " PyKDL.Segment(PyKDL.Joint(PyKDL.Joint.Fixed)).getJoint().getTypeName())": "None RotZ None",
    "import matplotlib; matplotlib.use('Agg'); import matplotlib.pyplot as plt; f = plt.figure(); a = f.gca(projection='3d');"
    "print(a.name, plt.gca() is a, f.gca(projection='3d') is a, plt.figure().gca().name)": "3d True True rectilinear",
    "from matplotlib.figure import Figure; print(Figure.gca.__qualname__)": "FigureBase.gca",  # pyplot of Debian 13 asks for it
}


def run(script, *folders):
    return subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60,
                          env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "PYTHONPATH": ":".join(map(str, folders))})


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_script_runs_as_it_did(script):
    ended = run(script, FOLDER)
    assert ended.stderr == "" and ended.stdout.strip() == SCRIPTS[script]


def test_what_is_there_stays():
    """Names are added to NumPy, and those that it has mean what they meant."""
    show = "import numpy; print({n: repr(v).split(' at 0x')[0] for n, v in vars(numpy).items() if n[0] != '_'})"
    plain, completed = (eval(run(show, *folders).stdout) for folders in ((), (FOLDER,)))
    assert plain.items() < completed.items() and {"float", "product"} & (completed.keys() - plain.keys())


def test_a_name_that_never_was_is_an_error_of_its_usual_words():
    script = "import numpy as np; np.wheels"
    assert run(script, FOLDER).stderr.splitlines()[-1] == run(script).stderr.splitlines()[-1]


def test_starting_imports_none_of_them():
    loaded = "import sys; print([n for n in ('numpy', 'yaml', 'matplotlib', 'fractions', 'inspect') if n in sys.modules])"
    assert run(loaded, FOLDER).stdout == run(loaded).stdout


def test_a_module_of_that_name_of_ones_own_is_left_as_it_is(tmp_path):
    (tmp_path / "yaml.py").write_text("mine = 1\n")
    ended = run("import yaml; print(vars(yaml).get('load'), yaml.mine)", tmp_path, FOLDER)
    assert (ended.stdout, ended.stderr) == ("None 1\n", "")


def test_a_sitecustomize_further_down_runs_as_well(tmp_path):
    (tmp_path / "sitecustomize.py").write_text("print(__name__, __file__)\n")
    assert run("pass", FOLDER, tmp_path).stdout == f"sitecustomize {tmp_path}/sitecustomize.py\n"


def test_the_source_of_a_completed_module_is_still_found():
    script = "import inspect, yaml; print(inspect.getsource(yaml) != '', yaml.__loader__.get_filename())"
    assert run(script, FOLDER).stdout.startswith("True /")
