"""``rosrun rviz_offscreen screenshot``: PNG pictures of what RViz shows, without a display."""

from __future__ import annotations

import argparse
import contextlib
import ctypes.util
import json
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator

import rosgraph
import rospkg
import rospy
import yaml

from . import dead_nodes
from .display import die_with_parent, private_display
from .errors import OffscreenError, RvizCrashed, ScreenshotError
from .views import View, parse_view


def parser() -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(prog="screenshot", description=__doc__, epilog=main.__doc__)
    p.add_argument("--config", "-d", default="", help="RViz configuration (default: RViz's own default.rviz)")
    p.add_argument("--output", "-o", default="rviz.png", help="PNG to write; with several views -NAME or -NUMBER is added")
    p.add_argument(
        "--view",
        action="append",
        default=[],
        metavar="VIEW",
        help="front, back, left, right, top, iso, or [NAME:]yaw=..,pitch=..,distance=..,x=..,y=..,z=..; repeatable. "
        "A name without distance and focal point has the robot fill the frame",
    )
    p.add_argument("--window", action="store_true", help="the whole window instead of the 3D view alone")
    p.add_argument("--size", default="1280x800", help="WIDTHxHEIGHT in pixels (default 1280x800)")
    p.add_argument(
        "--backend",
        choices=["xvfb", "osmesa"],
        default="xvfb",
        help="xvfb: a private X server with Mesa's software OpenGL; osmesa: no X server at all",
    )
    p.add_argument("--fixed-frame", "-f", default="", help="fixed frame instead of the configuration's")
    p.add_argument("--timeout", type=float, default=15.0, help="seconds to wait until every display is drawn (default 15)")
    p.add_argument(
        "--grace", type=float, default=3.0, help="seconds after which a display is not waited for if nobody publishes its topic (default 3)"
    )
    p.add_argument(
        "--watch",
        type=float,
        default=0.0,
        metavar="SECONDS",
        help="go on for so long after all is drawn before the picture is taken: trails grow",
    )
    p.add_argument("--anti-aliasing", action="store_true", help="smooth edges (xvfb only; about eight times the work)")
    return p


def output_paths(output: str, views: list[View]) -> list[str]:
    """One path for each of ``views``: ``output`` itself for one, ``stem-NAME.png`` for several."""
    output = os.path.abspath(output)
    if len(views) < 2:
        return [output]
    stem, extension = os.path.splitext(output)
    return [f"{stem}-{view.name or number}{extension or '.png'}" for number, view in enumerate(views, 1)]


def check_config(path: str) -> None:
    """RViz itself shows its default for a file that it cannot use."""
    try:
        with open(path) as file:
            content = yaml.safe_load(file)
    except OSError as error:
        raise ScreenshotError(f"RViz configuration {path}: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise ScreenshotError(f"RViz configuration {path} is not YAML: {' '.join(str(error).split())}") from error
    if not isinstance(content, dict) or "Visualization Manager" not in content:
        raise ScreenshotError(f"{path} is not an RViz configuration: it has no 'Visualization Manager'")


def find_shim() -> str:
    """The preloaded library of the OSMesa back-end, in the devel or install space."""
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":"):
        path = os.path.join(prefix, "lib", "libglx_on_osmesa.so")
        if os.path.exists(path):
            return path
    raise ScreenshotError("libglx_on_osmesa.so is not built: run catkin build rviz_offscreen and source devel/setup.bash")


@contextlib.contextmanager
def backend(name: str, size: str) -> Iterator[dict[str, str]]:
    """Environment variables for RViz's process, while the back-end ``name``, "xvfb" or "osmesa", stands; ``size``: "WIDTHxHEIGHT"
    pixels.
    """
    if name == "xvfb":
        with private_display(f"{size}x24") as variables:
            yield {**variables, "QT_QPA_PLATFORM": "xcb"}
    else:
        if not ctypes.util.find_library("OSMesa"):
            raise ScreenshotError("libOSMesa is not installed; run scripts/setup (Debian package libosmesa6-dev)")
        yield {"LD_PRELOAD": f"{find_shim()} libOSMesa.so.8", "QT_QPA_PLATFORM": "offscreen", "DISPLAY": ""}


def take(
    config: str,
    views: list[View],
    output: str,
    *,
    size: str = "1280x800",
    window: bool = False,
    fixed_frame: str = "",
    timeout: float = 15.0,
    grace: float = 3.0,
    watch: float = 0.0,
    backend_name: str = "xvfb",
    anti_aliasing: bool = False,
) -> dict:
    """Take the pictures.

    :param config: RViz's file; "": its default. :param views: [] for the configuration's own view.
    :param output: the picture's file, see :func:`output_paths`. :param size: "WIDTHxHEIGHT", each 16 to 8192 pixels.
    :param window: the whole window. :param fixed_frame: in place of the configuration's. :param anti_aliasing: smooth edges, with xvfb.
    :param timeout: wall s until every display is drawn. :param grace: s for which topics without publishers are waited for.
    :param watch: s to go on after all is drawn: trails grow. :param backend_name: see :func:`backend`.
    :returns: ``pictures`` (paths), ``not_ok`` (display -> what it says, of those not drawn in time), ``unpublished`` (display -> its
        topics, of those that nobody publishes), ``seconds`` to the first picture. :raises ScreenshotError: no picture.
    """
    views = views or [View("")]
    config = os.path.abspath(config) if config else os.path.join(rospkg.RosPack().get_path("rviz"), "default.rviz")
    check_config(config)
    try:
        width, height = (int(v) for v in size.lower().split("x"))
    except ValueError:
        width = height = 0
    if not (16 <= width <= 8192 and 16 <= height <= 8192):
        raise ScreenshotError(f"--size {size}: expected WIDTHxHEIGHT, each from 16 to 8192 pixels")
    paths = output_paths(output, views)
    for path in paths:
        folder = os.path.dirname(path)
        if not os.path.isdir(folder):
            raise ScreenshotError(f"no folder {folder} for {os.path.basename(path)}")
    if not rosgraph.is_master_online():
        # RViz itself would open a dialog that ignores Ctrl-C.
        raise ScreenshotError(f"no ROS master at {os.environ.get('ROS_MASTER_URI')}: start roscore or a launch file first")
    job = {
        "config": config,
        "window": window,
        "size": [width, height],
        "fixed_frame": fixed_frame,
        "timeout": timeout,
        "grace": grace,
        "watch": watch,
        "anti_aliasing": anti_aliasing,
        "pictures": [{"path": p, "view": v.values, "fit": v.fits} for p, v in zip(paths, views)],
    }
    with tempfile.TemporaryDirectory(prefix="rviz_offscreen_") as home, backend(backend_name, f"{width}x{height}") as variables:
        # RViz writes ~/.rviz on exit; a picture must neither read nor change the user's.
        environment = {**os.environ, **variables, "HOME": home, "ROS_LOG_DIR": home, "XDG_RUNTIME_DIR": home, "QT_LOGGING_RULES": "*=false"}
        try:
            result = run_grabber(job, environment, timeout + watch + 45)
        except RvizCrashed:  # once in some dozens of runs RViz with image panels damages its heap; a second one starts afresh
            result = run_grabber(job, environment, timeout + watch + 45)
    return {"pictures": paths, **result}


def run_grabber(job: dict, environment: dict[str, str], limit: float) -> dict:
    """Run :mod:`.grab` with ``job`` in a process of its own, so that a crash of RViz or OpenGL is only an exit code here.

    :param environment: all of it. :param limit: wall s for all of it
    :raises ScreenshotError: it did not end well
    """
    reading, writing = os.pipe()

    def prepare() -> None:
        die_with_parent()
        os.dup2(writing, 3)

    process = subprocess.Popen(
        [sys.executable, "-m", "rviz_offscreen.grab"],
        stdin=subprocess.PIPE,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        preexec_fn=prepare,
        close_fds=False,
    )
    os.close(writing)
    try:
        output, _ = process.communicate(json.dumps(job).encode(), timeout=limit)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise ScreenshotError(f"RViz did not finish within {limit:.0f} s") from None
    except BaseException:
        process.kill()
        process.wait()
        raise
    finally:
        dead_nodes.unregister()  # one that crashed when it left has given its answer before
    with os.fdopen(reading) as answers:
        answer = answers.readline()
    if answer:
        return json.loads(answer)
    text = output.decode(errors="replace")
    lines = [line for line in text.splitlines() if line.strip()]
    if process.returncode < 0:
        name = signal.Signals(-process.returncode).name
        raise RvizCrashed(
            f"RViz crashed ({name}); its last line: {lines[-1] if lines else 'none'} - is OpenGL there? "
            f"(Debian packages libgl1-mesa-dri, libosmesa6)"
        )
    raise ScreenshotError(f"RViz ended with code {process.returncode}; its last line: {lines[-1] if lines else 'none'}")


def main(argv: list[str] | None = None) -> int:
    """Exit code 0: every display drew something; 3: pictures written, but some display had nothing to draw (a line says
    which and why); 1: no picture; 2: wrong options.
    """
    options = parser().parse_args(rospy.myargv(sys.argv if argv is None else argv)[1:])
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        result = take(
            options.config,
            [parse_view(text) for text in options.view],
            options.output,
            size=options.size,
            window=options.window,
            fixed_frame=options.fixed_frame,
            timeout=options.timeout,
            grace=options.grace,
            watch=options.watch,
            backend_name=options.backend,
            anti_aliasing=options.anti_aliasing,
        )
    except OffscreenError as error:
        print(f"screenshot: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    for path in result["pictures"]:
        print(path)
    missing = missing_lines(result, options.timeout)
    for line in missing:
        print(f"screenshot: {line}", file=sys.stderr)
    return 3 if missing else 0


def missing_lines(result: dict, timeout: float) -> list[str]:
    """What the pictures of :func:`take`, which gave ``result``, lack after ``timeout`` s; none if all displays drew something."""
    lines = [
        f"nobody publishes {topics} of display '{name}'" if topics else f"display '{name}' has no topic set"
        for name, topics in sorted(result["unpublished"].items())
    ]
    if result["not_ok"]:
        waiting = ", ".join(f"{name} ({status})" for name, status in sorted(result["not_ok"].items()))
        lines.append(f"not ready after {timeout:g} s: {waiting}; is their topic published and their frame in tf?")
    return lines
