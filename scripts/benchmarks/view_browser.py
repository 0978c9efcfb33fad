#!/usr/bin/env python3
"""What the simulator's window bears, in a real browser: how soon it is usable, ten reconnects, a heavy world, three pages at
once, a slow network, broken meshes.

    scripts/bench page                                          all of it, beside what was asked for
    scripts/benchmarks/view_browser.py                          the same, a table
    scripts/benchmarks/view_browser.py usable slow              some
    scripts/benchmarks/view_browser.py --shots DIR --json FILE  with pictures, and for programs

Wanted: chromium, chromium-driver and the Python package selenium. Seconds are wall time of this machine as it is: the load is
among the figures.
"""

import argparse
import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

import psutil

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "..", "src", "windows", "gzclient", "test")]
from browser import Browser, missing  # noqa: E402
from hardships import BROKEN, SlowNetwork, body, broken_bodies, heavy_bodies, swinging_balls, write_world  # noqa: E402
from run import master  # noqa: E402

PLAIN = "table"


class Bench:
    """The simulator and its window; a world at a time."""

    def __init__(self, environment, folder, shots):
        self.environment = {name: value for name, value in environment.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
        self.folder, self.shots = folder, shots

    @contextlib.contextmanager
    def run(self, *words, **options):
        process = subprocess.Popen(words, env=self.environment, text=True, start_new_session=True, stderr=subprocess.DEVNULL, **options)
        try:
            yield process
        finally:
            os.killpg(process.pid, signal.SIGINT)
            try:
                process.wait(30)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)

    @contextlib.contextmanager
    def world(self, models, *options):
        file = write_world(os.path.join(self.folder, "bench.world"), models)
        quiet = {"env": self.environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        with self.run("rosrun", "gazebo_ros", "gzserver", *options, file, stdout=subprocess.DEVNULL) as server:
            while subprocess.run(["rosservice", "call", "/gazebo/get_world_properties"], **quiet).returncode:
                time.sleep(0.2)
            yield server

    @contextlib.contextmanager
    def client(self):
        """(process, address)."""
        with self.run("gzclient", "--port", "0", stdout=subprocess.PIPE) as process:
            yield process, process.stdout.readline().split()[-1]

    def shot(self, page, name):
        if self.shots:
            page.shot(os.path.join(self.shots, f"{name}.png"))


def processor(process):
    parts = [process, *process.children(recursive=True)]
    return sum(part.cpu_times().user + part.cpu_times().system for part in parts)


# ---------------------------------------------------------------------------------------------- what is measured


def usable(bench):
    """A browser that is open already goes to the address as soon as it is printed."""
    figures = {}
    with bench.world(swinging_balls(30)), Browser("about:blank", frames=0) as page:
        seen, cost = [], []
        for _ in range(3):
            begin = time.monotonic()
            with bench.client() as (process, address):
                page.driver.get(address)
                page.see("Iterations", "b20")
                seen.append(time.monotonic() - begin)
                cost.append(processor(psutil.Process(process.pid)))
                page.driver.get("about:blank")
        figures["page usable, s after the command, best of 3"] = min(seen)
        figures["page usable: processor s of gzclient"] = min(cost)
    return figures


def reconnects(bench):
    """The memory is that of the page's own copies at first, which are used again: what grows later would be lost."""
    with bench.world(swinging_balls(30)), bench.client() as (process, address), Browser(address) as page:
        page.see("Iterations", "b20")
        times, memory = [], []
        for _ in range(40):
            begin = time.monotonic()
            page.driver.refresh()
            page.see("Iterations", "real-time factor", "b20")
            times.append(time.monotonic() - begin)
            memory.append(psutil.Process(process.pid).memory_info().rss / 1e6)
        bench.shot(page, "reconnects")
        return {
            "ten reconnects: slowest, s": max(times[:10]),
            "twenty reconnects: memory of gzclient, MB": memory[19],
            "20 more reconnects: memory of gzclient grew by, MB": memory[39] - memory[19],
            "reconnects: errors on the page": len(page.complaints()),
        }


def heavy(bench):
    """200 models of 5 000 triangles."""
    with bench.world(heavy_bodies(bench.folder), "-u"), bench.client() as (process, address), Browser(address) as page:
        begin = time.monotonic()
        page.see("more: search")
        listed = time.monotonic() - begin
        page.fill("Search", "m199")
        page.click("m199")
        page.see("Mass (kg)")
        picked = time.monotonic() - begin - listed
        begin = time.monotonic()
        page.click("Play")
        page.see("real-time factor")
        played = time.monotonic() - begin
        with contextlib.suppress(Exception):  # without a graphics card one picture may take longer than the driver waits
            bench.shot(page, "heavy")
        return {
            "200 models, 1 000 000 triangles: listed, s": listed,
            "200 models, 1 000 000 triangles: a model picked by search, s": picked,
            "200 models, 1 000 000 triangles: from Play to the time that runs, s": played,
            "200 models, 1 000 000 triangles: processor s of gzclient": processor(psutil.Process(process.pid)),
            "200 models, 1 000 000 triangles: errors on the page": len(page.complaints()),
        }


def factor(page):
    found = re.search(r"real-time factor (\d+\.\d+)", page.text())
    return float(found.group(1)) if found else None


def pages(bench):
    """Three at once; the simulation runs on."""
    with contextlib.ExitStack() as stack:
        stack.enter_context(bench.world(swinging_balls(30)))
        process, address = stack.enter_context(bench.client())
        shown = [stack.enter_context(Browser(address, frames=2)) for _ in range(3)]
        for page in shown:
            page.see("real-time factor", "b20")
        client, factors = psutil.Process(process.pid), []
        before, begin = processor(client), time.monotonic()
        while time.monotonic() < begin + 8.0:
            factors.append(min(value for value in map(factor, shown) if value is not None))
            time.sleep(0.5)
        load = (processor(client) - before) / (time.monotonic() - begin)
        shown[0].click("Pause")
        for page in shown:
            page.see("paused")
        return {
            "3 pages: mean real-time factor of 8 s": sum(factors) / len(factors),
            "3 pages: least of them": min(factors),
            "3 pages: part of a core in gzclient": load,
            "3 pages: errors": sum(len(page.complaints()) for page in shown),
        }


def arm(bench):
    """The first lab as its launch file starts it, its camera watched by a node, the world by a page."""
    environment = {**bench.environment, "HOME": bench.folder}
    options = {"env": environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "start_new_session": True}
    lab = [subprocess.Popen(["roslaunch", "arm_gazebo", "arm_gazebo.launch", "gui:=false", "rviz:=false"], **options)]
    try:
        subprocess.run(
            ["rostopic", "echo", "-n1", "/camera/image_raw/header"], env=environment, stdout=subprocess.DEVNULL, timeout=120, check=True
        )
        lab.append(subprocess.Popen(["rostopic", "hz", "/camera/image_raw"], **options))
        with bench.client() as (_, address), Browser(address, frames=10) as page:
            page.see("real-time factor", "arm")
            time.sleep(5.0)  # the browser is busy with its first picture
            first, begin = sim_time(environment), time.monotonic()
            time.sleep(20.0)
            last, end = sim_time(environment), time.monotonic()
            bench.shot(page, "arm")
            return {
                "arm lab, camera and one page: real-time factor": (last - first) / (end - begin),
                "arm lab, camera and one page: errors on the page": len(page.complaints()),
            }
    finally:
        for process in reversed(lab):
            os.killpg(process.pid, signal.SIGINT)
            process.wait(60)


def sim_time(environment):
    said = subprocess.run(["rostopic", "echo", "-n1", "/clock"], env=environment, capture_output=True, text=True, timeout=30).stdout
    return int(re.search(r"secs: +(\d+)", said).group(1)) + 1e-9 * int(re.search(r"nsecs: +(\d+)", said).group(1))


def slow(bench):
    """2 Mbit/s, 0.1 s late; 30 bodies move all the time."""
    with bench.world(swinging_balls(30)), bench.client() as (_, address):
        with SlowNetwork(int(address.rsplit(":", 1)[1].strip("/"))) as network:
            begin = time.monotonic()
            with Browser(f"http://localhost:{network.port}/") as page:
                page.see("real-time factor", "b20", seconds=120)
                loaded, carried = time.monotonic() - begin, network.carried
                time.sleep(10.0)
                rate = (network.carried - carried) / 10.0
                begin = time.monotonic()
                page.click("Pause")
                page.see("paused")
                answered = time.monotonic() - begin
                bench.shot(page, "slow")
                return {
                    "2 Mbit/s: page usable, s": loaded,
                    "2 Mbit/s: carried until then, MB": carried / 1e6,
                    "2 Mbit/s: stream, kB/s": rate / 1e3,
                    "2 Mbit/s: from a click to what it did, s": answered,
                    "2 Mbit/s: errors on the page": len(page.complaints()),
                }


def broken(bench):
    """Meshes that are not there, cut off, of text, of nothing; what is whole is drawn."""
    models = body(PLAIN, 0, 0, 0.3) + broken_bodies(bench.folder)
    with bench.world(models), bench.client() as (_, address), Browser(address) as page:
        page.see("real-time factor", PLAIN, *BROKEN)
        page.click(PLAIN)
        page.see("Mass (kg)")
        bench.shot(page, "broken")
        return {
            "6 broken meshes: models listed beside them": float(PLAIN in page.text()),
            "6 broken meshes: real-time factor": factor(page) or 0.0,
            "6 broken meshes: errors on the page": len(page.complaints()),
        }


PARTS = {f.__name__: f for f in (usable, arm, reconnects, heavy, pages, slow, broken)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"of {', '.join(PARTS)}; all, if none")
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--shots", metavar="DIR", help="keep pictures of the page there")
    options = parser.parse_args()
    if missing():
        sys.exit(f"not installed: {missing()} (apt install chromium chromium-driver)")
    if unknown := [part for part in options.parts if part not in PARTS]:
        parser.error(f"there is no part {unknown[0]}; there are {', '.join(PARTS)}")
    figures = {}
    with master() as environment, tempfile.TemporaryDirectory() as folder:
        bench = Bench(environment, folder, options.shots)
        for name in options.parts or PARTS:
            for key, value in {**PARTS[name](bench), f"({name}: load of the machine)": os.getloadavg()[0]}.items():
                figures[f"view, {key}"] = value
                print(f"view, {key:70} {value:.4g}", flush=True)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(figures, file)


if __name__ == "__main__":
    main()
