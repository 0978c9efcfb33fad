"""Scripts for Noetic's Python (3.8, NumPy 1.17, SciPy 1.3, PyYAML 5.3, Matplotlib 3.1) run with Debian's.

The numbers are what NumPy 1.17.4, SciPy 1.3.3 and Matplotlib 3.1.2 print under Python 3.8.
"""
import atexit
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "noetic_python"

PLOT = "import matplotlib as m; m.use('Agg', warn=False); import matplotlib.pyplot as p;"
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
    "import time; print(0 < time.clock() < 60)": "True",
    "import random; print(random.sample({7}, 1), random.sample(frozenset({8}), 1), random.randint(2.0, 2.0))": "[7] [8] 2",
    "import random; x = [1, 2]; random.shuffle(x, lambda: 0.0); print(x)": "[2, 1]",
    "import json, io; print(json.loads('[1]', encoding='utf-8'), json.load(io.StringIO('[2]'), encoding='utf-8'))": "[1] [2]",
    "import asyncio; f = asyncio.coroutine(lambda: 4); print(asyncio.run(f()))": "4",
    "import asyncio\n@asyncio.coroutine\ndef f():\n  yield from asyncio.sleep(0, loop=None)\n  return 3\n"
    "async def g():\n  return {t.result() for t in (await asyncio.wait([f(), f()]))[0]}\nprint(asyncio.run(g()))": "{3}",
    "import xml.etree.ElementTree as E; r = E.fromstring('<a><b/><c/></a>'); print([c.tag for c in r.getchildren()], len(r.getiterator()),"
    " len(E.ElementTree(r).getiterator('c')))": "['b', 'c'] 3 1",
    "import array; a = array.array('B', [1]); a.fromstring(b'2'); print(a.tostring())": "b'\\x012'",
    "from html.parser import HTMLParser; print(HTMLParser().unescape('&lt;'))": "<",
    "from fractions import gcd; print(gcd(12, -18), gcd(-12, 0), gcd(1.5, 0.5))": "-6 -12 0.5",
    "import configparser, io; p = configparser.SafeConfigParser(); p.readfp(io.StringIO('[a]\\nb = 1')); print(p.get('a', 'b'))": "1",
    "import locale; print(locale.format('%d', 3))": "3",
    "import unittest\nclass T(unittest.TestCase):\n  def test(self):\n    self.assertEquals(1, 1); self.assert_(True)\n"
    "r = unittest.TestResult(); unittest.makeSuite(T).run(r); print(r.testsRun, r.wasSuccessful())": "1 True",
    "import numpy as np; a = np.array([[1, 2], [3]]); print(a.dtype, a.shape, np.asarray([[1], 2]).dtype)": "object (2,) object",
    "import numpy as np; print(np.linspace(0, 1, 3.0), np.mat([1]).shape, np.msort([[3, 1], [1, 2]]).tolist(), np.round_(1.4), np.NAN)":
        "[0.  0.5 1. ] (1, 1) [[1, 1], [3, 2]] 1.0 nan",
    "import numpy as np; a = np.arange(3); a.itemset(0, 5); print(a.ptp(), np.cast['int32'](2.5), np.array(a, copy=False) is a)":
        "4 2 True",
    "import numpy as np; print(np.fromstring(b'ab', dtype=np.uint8), np.VisibleDeprecationWarning.__name__, np.float_ is np.float64)":
        "[97 98] VisibleDeprecationWarning True",
    "from numpy.core.umath_tests import inner1d; print(inner1d([[1, 2]], [[3, 4]]))": "[11]",
    "import scipy; from scipy import array, pi; print(array([1]), scipy.sqrt(4), round(pi, 4), len(scipy.rand(2)))": "[1] 2.0 3.1416 2",
    "from scipy import integrate as i; print(round(i.simps([1, 4, 9, 16]), 9), round(i.simps([1, 4, 9, 16], [0, 1, 2.5, 3]), 9),"
    " i.cumtrapz([1, 2]), i.trapz([1, 2]), round(i.romberg(lambda x: x, 0, 1), 9))": "21.166666667 16.895833333 [1.5] 1.5 0.5",
    "from scipy.signal import gaussian, hanning, ricker, cwt; print(len(gaussian(5, 1)), hanning(3).tolist(), round(ricker(5, 1.5)[1], 9),"
    " cwt([0, 1, 2, 3, 4, 5], ricker, [1])[0, 0].round(6))": "5 [0.0, 1.0, 0.0] 0.315031427 -0.752104",
    "from scipy.spatial.transform import Rotation as R; print(R.from_dcm([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).as_dcm()[1, 0].round(9))":
        "1.0",
    "from scipy.interpolate import interp2d; f = interp2d([0, 1, 2], [0, 1], [[0, 1, 2], [1, 2, 3]]); print(f(0.5, 0.5).round(9),"
    " f([0, 1], [0, 1]).round(9).tolist())": "[1.] [[0.0, 1.0], [1.0, 2.0]]",
    "from scipy.misc import derivative; import math; print(round(derivative(math.exp, 1, dx=.1, n=2, order=5), 9))": "2.718278805",
    "from scipy.stats import binom_test; print(round(binom_test([3, 7]), 9))": "0.34375",
    "from PIL import Image, ImageDraw; i = Image.new('L', (9, 9)); print(i.resize((3, 3), Image.ANTIALIAS).size,"
    " ImageDraw.Draw(i).textsize('hello')[0] > 9)": "(3, 3) True",
    "import sys; sys.setcheckinterval(10)": "",
    PLOT + "p.figure().canvas.set_window_title('a'); p.grid(b=True); p.stem([1, 2], [1, 2], use_line_collection=True);"
    "p.annotate(s='a', xy=(0, 0)); p.plot([1], [1])[0].set_data(1.0, 2.0); print(p.subplot(211).is_first_row(), p.hold(True))": "True None",
    PLOT + "p.style.use('seaborn'); p.style.use('seaborn-whitegrid'); p.gca().xaxis.get_major_ticks()[0].label.set_fontsize(8);"
    "f = p.figure(figsize=(2, 1), dpi=50); f.canvas.draw(); print(len(f.canvas.tostring_rgb()), m.cm.get_cmap('jet').name)": "15000 jet",
    PLOT + "from mpl_toolkits.mplot3d import Axes3D, proj3d; from matplotlib.patches import FancyArrowPatch\n"
    "class Arrow(FancyArrowPatch):\n  def draw(self, renderer):\n"
    "    print(len(proj3d.proj_transform([0, 1], [0, 1], [0, 1], renderer.M)))\n"
    "f = p.figure(); a = Axes3D(f); print(f.axes == [a]); a.w_xaxis.set_pane_color((1, 1, 1, 1))\n"
    "a.add_artist(Arrow((0, 0), (0, 0), mutation_scale=20)); f.canvas.draw(); g = p.figure(); g.add_subplot(111, projection='3d');"
    "print(len(g.axes))": "True\n3\n1",
    "from matplotlib.figure import Figure; print(Figure.gca.__qualname__)": "FigureBase.gca",  # pyplot of Debian 13 asks for it
}


CACHE = tempfile.mkdtemp()  # Matplotlib's list of fonts is made once
atexit.register(shutil.rmtree, CACHE)


def run(script, *folders):
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120,
                           env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "MPLCONFIGDIR": CACHE,
                                "PYTHONPATH": ":".join(map(str, folders))})
    ended.stderr = "".join(line for line in ended.stderr.splitlines(True) if "font cache" not in line)
    return ended


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_script_runs_as_it_did(script):
    ended = run("import warnings; warnings.simplefilter('ignore')\n" + script, FOLDER)  # what goes next is announced
    assert ended.stderr == "" and ended.stdout.strip() == SCRIPTS[script]


def test_what_is_there_stays():
    """Names are added to NumPy, and those that it has mean what they meant."""
    stricter = {"array", "asarray", "asanyarray", "linspace", "logspace", "geomspace"}
    show = "import numpy; print({n: repr(v).split(' at 0x')[0] for n, v in vars(numpy).items() if n[0] != '_' and n not in STRICTER})"
    plain, completed = (eval(run(show.replace("STRICTER", repr(stricter)), *folders).stdout) for folders in ((), (FOLDER,)))
    assert plain.items() < completed.items() and {"float", "product"} & (completed.keys() - plain.keys())


def test_a_name_that_never_was_is_an_error_of_its_usual_words():
    script = "import numpy as np; np.wheels"
    assert run(script, FOLDER).stderr.splitlines()[-1] == run(script).stderr.splitlines()[-1]


def test_starting_imports_nothing():
    """But the file itself: the time that Python takes to start stays what it is."""
    loaded = "import sys; print(*sorted(sys.modules))"
    more = set(run(loaded, FOLDER).stdout.split()) - set(run(loaded).stdout.split())
    assert more <= {"importlib", "importlib.machinery", "importlib._bootstrap", "importlib._bootstrap_external", "_warnings", "warnings"}


@pytest.mark.parametrize("script, refused", [
    ("import numpy; numpy.array([[1, 2], [3]], dtype=float)", "ValueError"), ("import numpy; numpy.array([1, 'a'], int)", "ValueError"),
    ("import random; random.sample({1}, 2)", "ValueError"), ("import random; random.randint(1.5, 2)", "ValueError|TypeError"),
    ("import json; json.loads('{}', decoding='u')", "TypeError"), ("import scipy; scipy.wheels", "AttributeError")])
def test_what_noetic_refuses_is_refused(script, refused):
    assert run(script, FOLDER).stderr.splitlines()[-1].split(":")[0] in refused.split("|")


def test_a_module_that_is_gone_is_told_with_who_has_it():
    script = ("import sitecustomize; sitecustomize.GONE['gone'] = 'python3-gone'\n"
              "try:\n  import gone\nexcept ImportError as error:\n  print(error)")
    assert run(script, FOLDER).stdout == "No module named 'gone': Python has dropped it; sudo apt install python3-gone\n"


def test_a_module_that_is_gone_is_made_anew(tmp_path):
    (tmp_path / "mine.py").write_text("x = 1\n")
    script = (f"import sitecustomize; sitecustomize.REMADE['imq'] = sitecustomize.REMADE['imp']\nimport imq as imp, json\n"
              f"m = imp.load_source('m', {str(tmp_path / 'mine.py')!r}); m.x = 2; found = imp.find_module('json')\n"
              "print(imp.reload(json) is json, m.x, imp.load_module('json', *found).__name__, imp.new_module('n').__name__, imp.__name__)")
    ended = run(script, FOLDER)
    assert ended.stdout == "True 2 json n imq\n", ended.stderr


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
