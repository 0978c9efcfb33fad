"""Scripts for Noetic's Python (3.8, NumPy 1.17, SciPy 1.3, PyYAML 5.3, Matplotlib 3.1) run with Debian's.

The numbers are what NumPy 1.17.4, SciPy 1.3.3, Matplotlib 3.1.2 and OpenCV 4.2 print under Python 3.8.
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
    "import numpy as np; print(np.linspace(0, 1, 3.0), np.mat([1]).shape, np.msort([[3, 1], [1, 2]]).tolist(), np.round_(1.4), np.NAN)": "[0.  0.5 1. ] (1, 1) [[1, 1], [3, 2]] 1.0 nan",
    "import numpy as np; a = np.arange(3); a.itemset(0, 5); print(a.ptp(), np.cast['int32'](2.5), np.array(a, copy=False) is a)": "4 2 True",
    "import numpy as np; print(np.fromstring(b'ab', dtype=np.uint8), np.VisibleDeprecationWarning.__name__, np.float_ is np.float64)": "[97 98] VisibleDeprecationWarning True",
    "from numpy.core.umath_tests import inner1d; print(inner1d([[1, 2]], [[3, 4]]))": "[11]",
    "import scipy; from scipy import array, pi; print(array([1]), scipy.sqrt(4), round(pi, 4), len(scipy.rand(2)))": "[1] 2.0 3.1416 2",
    "from scipy import integrate as i; print(round(i.simps([1, 4, 9, 16]), 9), round(i.simps([1, 4, 9, 16], [0, 1, 2.5, 3]), 9),"
    " i.cumtrapz([1, 2]), i.trapz([1, 2]), round(i.romberg(lambda x: x, 0, 1), 9))": "21.166666667 16.895833333 [1.5] 1.5 0.5",
    "from scipy.signal import gaussian, hanning, ricker, cwt; print(len(gaussian(5, 1)), hanning(3).tolist(), round(ricker(5, 1.5)[1], 9),"
    " cwt([0, 1, 2, 3, 4, 5], ricker, [1])[0, 0].round(6))": "5 [0.0, 1.0, 0.0] 0.315031427 -0.752104",
    "from scipy.spatial.transform import Rotation as R; print(R.from_dcm([[0, -1, 0], [1, 0, 0], [0, 0, 1]]).as_dcm()[1, 0].round(9))": "1.0",
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
    "import random; print(random.sample({1:2}.keys(),1)); random.seed((1,2)); print(0 <= random.random() < 1)": "[1]\nTrue",
    "import math; print(math.factorial(5.0)); from math import factorial; print(factorial(4))": "120\n24",
    "import asyncio\nasync def f():\n  l=asyncio.Lock(loop=None); q=asyncio.Queue(3, loop=asyncio.get_event_loop()); "
    "q.put_nowait(1); print(l.locked(), q.qsize(), "
    "asyncio.Event(loop=None).is_set())\nasyncio.get_event_loop().run_until_complete(f())": "False 1 False",
    "import numpy as np; print(np.histogram([1,2],2,normed=True)[0], [np.float64(1.5), np.int64(2)], "
    "str((np.float32(.5),)))": "[1. 1.] [1.5, 2] (0.5,)",
    "from numpy import *; print(float_(1), product([2,3]), Inf, sin(0))": "1.0 6 inf 0.0",
    "from scipy import *; print(sin(0), array([1]), pi>3, linspace(0,1,2), isinstance(True, bool), max([1,2]))": "0.0 [1] True [0. 1.] True 2",
    "from scipy import fft, ifft; print(fft([1.0,2]).real, ifft([3.0,-1]).real)": "[ 3. -1.] [1. 2.]",
    "import scipy.linalg as l; print(l.eigh([[2.0,0],[0,3]], eigvals=(0,0))[0], l.eigvalsh([[2.0]], turbo=False), "
    "l.solve([[2.0]],[1.0],sym_pos=True))": "[2.] [2.] [0.5]",
    "from scipy.signal import firwin, firwin2; print(firwin(3,0.5,nyq=1.0).round(4), "
    "firwin2(5,[0,0.5,1],[1,1,0],nyq=1).round(3))": "[0.0462 0.9076 0.0462] [-0.009  0.111  0.75   0.111 -0.009]",
    "from scipy.stats import itemfreq, mode, norm, t; print(itemfreq([1,1,2]).tolist(), mode([1,1,2])[0][0], "
    "mode([[1,2],[1,3]])[0].shape, mode([3,3,4],axis=None)[0][0], round(norm.interval(alpha=.95)[0],3), "
    "round(t.interval(alpha=.9,df=3)[1],3), round(norm.moment(n=2),6))": "[[1, 2], [2, 1]] 1 (1, 2) 3 -1.96 2.353 1.0",
    "from scipy.spatial import cKDTree, KDTree; print(cKDTree([[0,0],[1,1]]).query([0,.1],n_jobs=2)[1], "
    "cKDTree([[0,0]]).query_ball_point([0,0],1,n_jobs=-1))": "0 [0]",
    "from scipy.sparse import csr_matrix, lil_matrix; m=csr_matrix([[1,0],[0,2]]); print(m.A.tolist(), m.H.A.tolist(), "
    "lil_matrix((1,1)).A.tolist())": "[[1, 0], [0, 2]] [[1, 0], [0, 2]] [[0.0]]",
    PLOT + "p.hist([1,2,2],2,normed=1); p.gca().hist([1,2],normed=True); p.hist2d([1,2],[1,2],normed=True); "
    "print(p.gca().patches[0].get_height())": "0.6666666666666666",
    PLOT + "p.plot([1,2]); a=p.gca(); l=a.lines[0]; a.lines.remove(l); print(len(a.lines)); p.plot([1]); p.plot([2]); "
    "a.lines.pop(0); a.lines.pop(); print(len(a.lines)); p.plot([1]); a.lines=[]; print(len(a.lines)); p.text(0,0,'a'); "
    "del a.texts[:]; p.text(0,0,'b'); a.texts=[]; a.patches=[]; a.collections=[]; print(len(a.texts))": "0\n0\n0\n0",
    PLOT + "c=p.contour([[0,1],[1,2]]); [k.set_alpha(.5) for k in c.collections]; [k.remove() for k in c.collections]; "
    "print(len(p.gca().collections))": "0",
    PLOT + "p.gca().xaxis.grid(b=True); print(p.gca().xaxis.get_gridlines()[0].get_visible())": "True",
    PLOT + "a=p.gca(); print(next(a._get_lines.prop_cycler)['color'], next(a._get_lines.prop_cycler)['color']); "
    "print(p.plot([1])[0].get_color())": "#1f77b4 #ff7f0e\n#2ca02c",
    PLOT + "a=p.subplot(121); b=p.subplot(122); a.get_shared_x_axes().join(a,b); a.set_xlim(0,7); print(b.get_xlim()[1], "
    "b.rowNum, b.colNum)": "7.0 0 1",
    PLOT + "p.stem([1,2],[1,2],'r-','bo'); p.gca().stem([1,2],[3,4],'r-','bo','k:',use_line_collection=True); "
    "print(len(p.gca().containers))": "2",
    PLOT + "p.loglog([1,2],[1,2],basex=2,basey=2,nonposx='clip',subsx=[2,3]); p.semilogy([1,2],basey=2); "
    "p.xscale('log',basex=2); p.yscale('log',nonposy='clip'); p.gca().set_xscale('log',nonposx='mask'); "
    "print(p.gca().get_xscale(), p.gca().get_yscale()); p.yscale('symlog',linthreshy=.1,linscaley=1); "
    "p.gcf().canvas.draw()": "log log",
    PLOT + "c=p.colorbar(p.imshow([[0,1]])); c.set_clim(0,5); c.draw_all(); print(c.mappable.get_clim())": "(0, 1)",
    PLOT + "import numpy as np; i=p.imshow(np.zeros((2,2)),'gray',None,'equal','nearest',.5,0,1,'lower'); "
    "print(i.get_cmap().name, i.get_alpha(), i.origin)": "gray 0.5 lower",
    PLOT + "p.subplots(1,2,True); a=p.gca(); a.add_patch(m.patches.Ellipse((0,0),1,2,30)); "
    "a.add_patch(m.patches.Rectangle((0,0),1,1,45)); a.add_patch(m.patches.Polygon([[0,0],[1,1],[0,1]],True)); "
    "a.add_patch(m.patches.RegularPolygon((0,0),5,.1)); a.add_patch(m.patches.Arc((0,0),1,1,0,0,90)); "
    "p.gcf().canvas.draw(); print(a.patches[0].angle)": "30",
    PLOT + "m.rcParams['text.latex.unicode']=True; p.rcParams.update({'savefig.frameon': False, 'font.size': 9}); p.rc('font', "
    "size=7); print(p.rcParams['font.size'])": "7.0",
    PLOT + "import warnings, matplotlib.cbook; warnings.filterwarnings('ignore',category=matplotlib.cbook.mplDeprecation); "
    "print(issubclass(matplotlib.cbook.MatplotlibDeprecationWarning, Warning))": "True",
    PLOT + "from matplotlib.dates import epoch2num, num2date, num2epoch; print(num2date(epoch2num(86400.0)).isoformat(), "
    "num2epoch(epoch2num(5.0)).round(3))": "1970-01-02T00:00:00+00:00 5.0",
    PLOT + "f=p.figure(figsize=(1,1),dpi=10); f.canvas.draw(); print(len(f.canvas.get_renderer().tostring_rgb()))": "300",
    "import yaml, warnings; warnings.filterwarnings('ignore', category=yaml.YAMLLoadWarning); print(yaml.load('a'))": "a",
    "import cv2, numpy as np; c=cv2.split(np.zeros((2,2,3),np.uint8)); c[0]=c[0]+1; print(type(c).__name__, cv2.merge(c).sum())": "list 4",
    "import cv2, numpy as np; i=np.zeros((50,90),np.uint8); i[10:40,10:40]=255; i[2:5,60:63]=255; "
    "c,h=cv2.findContours(i,cv2.RETR_EXTERNAL,cv2.CHAIN_APPROX_SIMPLE); c.sort(key=cv2.contourArea,reverse=True); "
    "c.append(c[0]); print(len(c), cv2.contourArea(c[0]), h.shape); "
    "print(len(cv2.findContours(i*0,cv2.RETR_EXTERNAL,cv2.CHAIN_APPROX_SIMPLE)[0]))": "3 841.0 (1, 2, 4)\n0",
    "import cv2, numpy as np; i=np.zeros((50,50,3),np.uint8); cv2.circle(i,tuple(np.float32([5.6,5])),3,(0,0,255)); "
    "cv2.line(i,tuple(np.float32([0,0])),tuple(np.float32([5,5])),(255,0,0)); print(i[0,0].tolist())": "[255, 0, 0]",
    "import cv2, numpy as np; print([i[0] for i in cv2.dnn.NMSBoxes([[0,0,9,9],[40,40,9,9]],[.9,.8],.5,.4)], "
    "len(cv2.dnn.NMSBoxes([],[],.5,.4)))": "[0, 1] 0",
    "import cv2, numpy as np; i=(np.random.RandomState(1).rand(200,200)*255).astype(np.uint8); o=cv2.ORB_create(); "
    "k,d=o.detectAndCompute(i,None); k2=o.detect(i,None); b=cv2.BFMatcher(cv2.NORM_HAMMING,crossCheck=True); "
    "m=b.match(d,d); m.sort(key=lambda x:x.distance); print(type(k).__name__, type(k2).__name__, type(m).__name__, "
    "len(m)==len(k)); m=cv2.BFMatcher().knnMatch(d,d,k=2); m.sort(key=lambda x: x[0].distance); print(type(m).__name__, "
    "len(m[0]), [1 for a,b in m][:1])": "list list list True\nlist 2 [1]",
    "from matplotlib.figure import Figure; print(Figure.gca.__qualname__)": "FigureBase.gca",  # pyplot of Debian 13 asks for it
}


CACHE = tempfile.mkdtemp()  # Matplotlib's list of fonts is made once
atexit.register(shutil.rmtree, CACHE)


def run(script, *folders):
    ended = subprocess.run(
        [sys.executable, "-c", script],
        capture_output=True,
        text=True,
        timeout=120,
        env={"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "MPLCONFIGDIR": CACHE, "PYTHONPATH": ":".join(map(str, folders))},
    )
    ended.stderr = "".join(line for line in ended.stderr.splitlines(True) if "font cache" not in line)
    return ended


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_script_runs_as_it_did(script):
    ended = run("import warnings; warnings.simplefilter('ignore')\n" + script, FOLDER)  # what goes next is announced
    assert ended.stderr == "" and ended.stdout.strip() == SCRIPTS[script]


def test_what_is_there_stays():
    """Names are added to NumPy, and those that it has mean what they meant."""
    stricter = {"array", "asarray", "asanyarray", "linspace", "logspace", "geomspace"}
    show = "import numpy; print({n: str(v).split(' at 0x')[0] for n, v in vars(numpy).items() if n[0] != '_' and n not in STRICTER})"
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


@pytest.mark.parametrize(
    "script, refused",
    [
        ("import numpy; numpy.array([[1, 2], [3]], dtype=float)", "ValueError"),
        ("import numpy; numpy.array([1, 'a'], int)", "ValueError"),
        ("import random; random.sample({1}, 2)", "ValueError"),
        ("import random; random.randint(1.5, 2)", "ValueError|TypeError"),
        ("import json; json.loads('{}', decoding='u')", "TypeError"),
        ("import scipy; scipy.wheels", "AttributeError"),
    ],
)
def test_what_noetic_refuses_is_refused(script, refused):
    assert run(script, FOLDER).stderr.splitlines()[-1].split(":")[0] in refused.split("|")


def test_a_module_that_is_gone_is_told_with_who_has_it():
    script = (
        "import sitecustomize; sitecustomize.GONE['gone'] = 'python3-gone'\n"
        "try:\n  import gone\nexcept ImportError as error:\n  print(error)"
    )
    assert run(script, FOLDER).stdout == "No module named 'gone': Python has dropped it; sudo apt install python3-gone\n"


def test_a_module_that_is_gone_is_made_anew(tmp_path):
    (tmp_path / "mine.py").write_text("x = 1\n")
    script = (
        f"import sitecustomize; sitecustomize.REMADE['imq'] = sitecustomize.REMADE['imp']\nimport imq as imp, json\n"
        f"m = imp.load_source('m', {str(tmp_path / 'mine.py')!r}); m.x = 2; found = imp.find_module('json')\n"
        "print(imp.reload(json) is json, m.x, imp.load_module('json', *found).__name__, imp.new_module('n').__name__, imp.__name__)"
    )
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
