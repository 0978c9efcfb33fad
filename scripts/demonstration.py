"""What the demonstrations share: options, a ROS master and a display of their own, the report."""

from __future__ import annotations

import argparse
import contextlib
import html
import os
import signal
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path


class DemoError(RuntimeError):
    """The demo cannot go on; one line."""


def add_options(parser: argparse.ArgumentParser, out: str) -> None:
    """:param out: the folder that ``--out`` is for when it is not given"""
    parser.add_argument("--headless", action="store_true", help="open no window even if there is a display")
    parser.add_argument("--out", default=out, help=f"folder for pictures, plot, table and report (default {out})")
    parser.add_argument("--check", action="store_true", help=argparse.SUPPRESS)


def check_folder(parser: argparse.ArgumentParser, out: str) -> None:
    """Make the folder, or end with a line that says why it cannot be."""
    try:
        os.makedirs(out, exist_ok=True)
        with tempfile.TemporaryFile(dir=out) as probe:
            probe.write(b"\0" * 4096)
    except OSError as error:
        parser.error(f"cannot write into --out {out}: {error.strerror}; name another folder")


def save_report(out: Path, figures: dict, pictures: list, title: str) -> None:
    """``out/report.html``: figures (name: text), then pictures (path, caption); the first one is wide."""
    rows = "\n".join(f"<tr><td>{html.escape(k)}</td><td>{html.escape(v)}</td></tr>" for k, v in figures.items())
    images = "\n".join(
        f'<figure><img src="{p.name}" alt="{html.escape(t)}"><figcaption>{html.escape(t)}</figcaption></figure>' for p, t in pictures
    )
    (out / "report.html").write_text(f"""<!doctype html>
<html lang="en"><meta charset="utf-8"><title>{html.escape(title)}</title>
<style>body {{font: 15px sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em}} img {{max-width: 100%; border: 1px solid #ccc}}
figure {{display: inline-block; width: 48%; margin: 0.5%; vertical-align: top}} figure:first-of-type {{width: 98%}}
td {{padding: 0.2em 1.2em 0.2em 0; border-bottom: 1px solid #ddd}} figcaption {{color: #555; font-size: 90%}}</style>
<h1>{html.escape(title)}</h1>
<table>
{rows}
</table>
{images}
</html>
""")


def main(name: str, options: argparse.Namespace, run: Callable[[argparse.Namespace, Path, dict, bool], int]) -> None:
    """Run a demonstration and leave the process with its exit code.

    :param run: of options, folder, environment (ROS master, display) and whether a person sees the windows
    """
    code = 0 if options.check else _run(name, options, run)
    sys.stdout.flush()
    os._exit(code)  # rospy's threads wait for a master that is gone


def _run(name: str, options: argparse.Namespace, run: Callable[[argparse.Namespace, Path, dict, bool], int]) -> int:
    out = Path(options.out).resolve()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    from launch_gallery.session import free_port
    from rviz_offscreen.display import private_display
    from rviz_offscreen.errors import DisplayError

    environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{free_port()}", ROS_HOME=str(out / "ros_home"))
    try:
        with contextlib.ExitStack() as stack:
            window = bool(environment.get("DISPLAY")) and not options.headless
            if not window:
                environment.update(stack.enter_context(private_display()))
            os.environ.update({k: environment[k] for k in ("ROS_MASTER_URI", "ROS_HOME")})
            return run(options, out, environment, window)
    except (DemoError, DisplayError) as error:
        print(f"scripts/{name}: {error} (folder {out})", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
