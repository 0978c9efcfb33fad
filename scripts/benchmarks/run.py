"""Measures what the project promises, section by section, and prints one table; see scripts/bench --help."""

import argparse
import contextlib
import json
import os
import platform
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

from node_signals.progress import progress

HERE = os.path.dirname(os.path.abspath(__file__))
ROBOT_TITLES = {
    "arm": "arm, 4 position controllers, joint states at 100 Hz",
    "ur5": "UR5 on a trajectory at 1 kHz control, joint states at 50 Hz",
}
JOINTS = {"arm": 4, "ur5": 6}

# What was asked for: a pattern of figure names, and the least or the most that is good.
WANTED = [
    (r"arm.*real-time factor, uncapped$", ">=", 20.0),
    (r"UR5.*real-time factor, uncapped$", ">=", 20.0),
    (r"^arm, physics thread.*sum", "<", 9.0),
    (r"^ur5, physics thread.*sum", "<", 15.0),
    (r"^arm, physics thread.*core", "<", 2.5),
    (r"^ur5, physics thread.*core", "<", 6.0),
    (r"^100 falling boxes: ode_sim / MuJoCo", "<=", 1.0),
    (r"^16 two-wheeled robots.*ode_sim / bare", "<=", 1.1),
    (r"^48 mesh rollers .* on a plane", "<", 600.0),
    (r"^48 mesh rollers", "<", 1000.0),
    (r"seconds to the first joint states", "<", 1.5),
    (r"memory of the server", "<", 300.0),
    (r"arms: cost per arm against one arm", "<=", 1.05),
    (r"first picture of RViz", "<", 3.0),
    (r"arm with 800x800 camera: real-time factor", ">=", 0.99),
    (r"frame / bare draw", "<=", 1.5),
    (r"^IK of .* solved within 5 ms", ">=", 99.6),
    (r"^IK of .* median", "<", 0.4),
    (r"^MotionBenchMaker, .*, all \d+: solved", ">=", 99.0),
    (r"^MotionBenchMaker, .*, all \d+: p50", "<", 30.0),
    (r"to timed trajectory: solved", ">=", 100.0),
    (r"to timed trajectory: p50", "<", 50.0),
    (r"to timed trajectory: p95", "<", 250.0),
    (r"1 000 objects, one added", "<", 2.0),
    (r"check / FCL's bare loop", "<=", 1.2),
    (r"^move_group: launch command to", "<", 3.0),
    (r"^move_group: memory", "<", 300.0),
    (r"^move_group: growth", "<", 2.0),
    (r"^view, 30 bodies: the same scaled", "<", 0.1),
    (r"^view, nobody looks any more", "<", 0.01),
    (r"^view: first page served", "<", 2.0),
    (r"^view, 200 models: processor seconds", "<", 5.0),
    (r"^view, page usable, s", "<", 2.0),
    (r"^view, arm lab.*factor", ">=", 0.99),
    (r"^view, 3 pages: mean", ">=", 0.99),
    (r"^view, 20 more reconnects: memory", "<", 5.0),
    (r"^view, .*errors", "<=", 0),
    (r"^rqt.* to its window, s", "<", 1.5),
    (r"^rqt_graph, .* drawn, s", "<", 1.0),
    (r"longest pause of the window", "<", 50.0),
    (r"^rqt_image_view.*part of a core", "<", 0.25),
    (r"motors: p99 cycle", "<", 1.5),
    (r"^robot in C\+\+.*p99", "<", 1.5),
    (r"^mbot.*real-time factor, throttled$", ">=", 0.99),
    (r"^mbot.*real-time factor, uncapped$", ">=", 10.0),
    (r"mbots: cost per mbot against one", "<=", 1.05),
    (r"^RViz with MotionPlanning: seconds", "<", 4.0),
    (r"^goal dragged.*pictures", ">=", 30.0),
    (r"^compiled controller: what calling", "<=", 0.5),
    (r"^compiled model plugin that reads", "<=", 1.0),
    (r"times as good as real Gazebo", ">=", 3.0),
    (r"^40 arm homeworks, 2 workers", "<", 480.0),
    (r"^class: throughput of 2 workers", ">=", 1.8),
    (r"^class: share of sub", ">=", 1.0),
    (r"^sandbox: seconds", "<", 0.3),
    (r"^class: driver's memory for a queue of 10000", "<", 500.0),
]


def program(name, *arguments, environment=None, timeout=300):
    """Run a script of this folder; its last line is JSON."""
    done = subprocess.run(
        [sys.executable, os.path.join(HERE, name), *map(str, arguments)], capture_output=True, text=True, timeout=timeout, env=environment
    )
    if done.returncode:
        raise RuntimeError(f"{name} {' '.join(map(str, arguments))}: {' '.join(done.stderr.split()[-30:])}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def section_script(name, *arguments, timeout=900):
    """Run a script of this folder that writes its figures with --json."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "figures.json")
        done = subprocess.run(
            [sys.executable, os.path.join(HERE, name), "--json", file, *map(str, arguments)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            timeout=timeout,
        )
        if not os.path.exists(file):
            raise RuntimeError(f"{name}: {' '.join(done.stderr.split()[-30:])}")
        with open(file, encoding="utf-8") as figures:
            return json.load(figures)


@contextlib.contextmanager
def master():
    """A ROS master of its own; gives the environment that leads to it."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory() as home:
        environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home)
        quiet = {"env": environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        core = subprocess.Popen(["roscore", "-p", str(port)], **quiet)
        try:
            while subprocess.run(["rosparam", "list"], **quiet).returncode:
                time.sleep(0.1)
            yield environment
        finally:
            core.send_signal(signal.SIGINT)
            core.wait(timeout=30)


def parts(robot, steps, copies=1):
    with master() as environment:
        return program("step_parts.py", robot, steps, copies, environment=environment)


def other_engine(engine, robot, steps):
    """us per step, or why there is none."""
    if subprocess.run([sys.executable, "-c", f"import {engine}"], capture_output=True).returncode:
        return f"{engine} is not installed: scripts/setup --bench"
    done = subprocess.run(
        [sys.executable, os.path.join(HERE, "other_engines.py"), engine, robot, str(steps)],
        check=True,
        capture_output=True,
        text=True,
        timeout=300,
    )
    return json.loads(done.stdout[done.stdout.rindex("{") :])["us per step"]


def robot_figures(robot, quick):
    import physics

    title, steps = ROBOT_TITLES[robot], 5000 if quick else 20000
    ran = program("launched.py", robot, 6 if quick else 15)
    figures = {
        f"{title}: real-time factor, uncapped": ran["real-time factor"],
        f"{title}: joint states per sim second": ran["joint states"],
        f"{title}: processor time of the server per step, us": ran["processor us per step"],
    }
    timed = parts(robot, steps)
    step, wall = timed.pop("step"), timed.pop("wall")
    timed.pop("memory")
    for name, value in timed.items():
        figures[f"{robot}, physics thread, us per step: {name}"] = value
    figures[f"{robot}, physics thread, us per step: sum"] = step
    figures[f"{robot}, physics thread, us per step: by the wall clock"] = wall
    engines = {"bare C loop of ODE, as many boxes on hinge motors": min(physics.bare("arm", steps, JOINTS[robot])[0] for _ in range(3))}
    for engine in ("pybullet", "mujoco"):
        engines[f"{engine} with a PD in Python"] = other_engine(engine, robot, steps)
    for name, value in engines.items():
        figures[f"{robot}, us per step: {name}"] = value
        if not isinstance(value, str):
            figures[f"{robot}: core / {name.split(',')[0].split(' with')[0]}"] = timed["core"] / value
            figures[f"{robot}: whole step / {name.split(',')[0].split(' with')[0]}"] = step / value
    return figures


def start_up(quick):
    runs = [program("launched.py", "arm", 1) for _ in range(1 if quick else 3)]
    return {
        "arm_gazebo.launch without RViz: seconds to the first joint states": sorted(r["start"] for r in runs)[len(runs) // 2],
        "arm_gazebo.launch: memory of the server, MB": max(r["memory"] for r in runs),
    }


def scaling(quick):
    figures, one = {}, None
    for copies in (1, 2, 4) if quick else (1, 2, 4, 8):
        cost = parts("arm", 2000 if quick else 10000, copies)["step"]
        one = one or cost
        figures[f"{copies} arms, us per step"] = cost
        if copies > 1:
            figures[f"{copies} arms: cost per arm against one arm"] = cost / one / copies
    return figures


def tracking(quick):
    seconds = 4 if quick else 10
    return {
        f"UR5, {name} interface, 1 kHz, swings of 1.2 rad in 2 s: largest tracking error, rad": program("launched.py", case, seconds)[
            "largest error"
        ]
        for case, name in (("ur5", "position"), ("ur5_effort", "effort"))
    }


def pendulum(quick):
    import pendulum as module

    return module.figures(quick)


def camera(quick):
    found = section_script("camera.py", "--seconds", 5 if quick else 15)
    return {f"arm with 800x800 camera: {name}": value for name, value in found.items()}


def motion(quick):
    figures = section_script("planning.py", *(["--quick"] if quick else []))
    runs = [program("move_group.py", count, timeout=900) for count in ([0, 200] if quick else [0, 0, 1000])]
    planned = runs[-1]
    return {
        **figures,
        "move_group: launch command to 'You can start planning now', s": min(run["ready"] for run in runs),
        "move_group: processor seconds to there, of all that is launched": min(run["processor seconds of the launch"] for run in runs),
        "move_group: processor seconds to there, its own": min(run["processor seconds"] for run in runs),
        "move_group: memory when ready, MB": planned["memory"],
        f"move_group: memory after {planned['plans']} plans, MB": planned["memory after plans"],
        f"move_group: growth from plan 100 to plan {planned['plans']}, MB": planned["growth"],
        "move_group: processor time of a plan through its service, ms": planned["ms per plan"],
    }


def class_of(quick):
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "figures.json")
        subprocess.run(
            [sys.executable, os.path.join(HERE, "grading.py"), "--json", file, "--count", "8" if quick else "40"],
            check=True,
            stdout=subprocess.DEVNULL,
            timeout=3600,
        )
        with open(file, encoding="utf-8") as figures:
            return json.load(figures)


def rviz(quick):
    """The arm's own RViz set-up, on a private display, from the command to the picture on disk."""
    del quick
    import robots

    config = robots.find("arm_description", "manipulator.rviz")
    with master() as environment, tempfile.TemporaryDirectory() as folder:
        launch = subprocess.Popen(
            ["roslaunch", "arm_description", "display.launch", "rviz:=false"],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            while subprocess.run(["rostopic", "echo", "-n1", "/tf_static"], env=environment, capture_output=True, timeout=30).returncode:
                time.sleep(0.2)
            times = []
            for number in range(3):
                picture, start = os.path.join(folder, f"{number}.png"), time.monotonic()
                subprocess.run(
                    ["rosrun", "rviz_offscreen", "screenshot", "--config", config, "--output", picture],
                    check=True,
                    env=environment,
                    capture_output=True,
                    timeout=120,
                )
                times.append(time.monotonic() - start)
        finally:
            launch.send_signal(signal.SIGINT)
            launch.wait(timeout=30)
    return {"first picture of RViz, s": sorted(times)[1]}


SECTIONS = {
    "arm": ("the arm as fast as possible, where its time goes, and other engines", lambda quick: robot_figures("arm", quick)),
    "ur5": ("the UR5 on a trajectory, likewise", lambda quick: robot_figures("ur5", quick)),
    "start": ("from roslaunch to the first joint states; memory", start_up),
    "scaling": ("one to eight arms in a world", scaling),
    "tracking": ("error of the joint trajectory controller", tracking),
    "pendulum": ("error against step size", pendulum),
    "physics": ("bare physics against bare ODE, and rays", lambda quick: section_script("physics.py")),
    "garden": (
        "a base on mecanum wheels whose rollers are meshes, on a plane and among meshes",
        lambda quick: section_script("garden.py", "--steps", 300 if quick else 1000),
    ),
    "motion": ("kinematics, collision checks and plans of the motion library; move_group", motion),
    "camera": ("pictures per second, and what one costs", camera),
    "rviz": ("time to a picture of RViz", rviz),
    "windows": ("rqt: start, a large graph, fast topics", lambda quick: section_script("windows.py", *(["--quick"] if quick else []))),
    "desk": (
        "RViz with MotionPlanning: how soon, and a goal that is dragged",
        lambda quick: section_script("desk.py", "--seconds", 5 if quick else 10),
    ),
    "view": (
        "gzclient: what its stream costs the server, how soon its page is there",
        lambda quick: section_script("view.py", *(["--quick"] if quick else [])),
    ),
    "page": (
        "gzclient's page in Chromium: how soon, ten reconnects, a heavy world, three pages, a slow network, broken meshes",
        lambda quick: section_script("view_browser.py", *(["usable", "arm", "pages"] if quick else [])),
    ),
    "class": ("lab_check: a class of arm homeworks with seeded faults; the sandbox", class_of),
    "compiled": (
        "a compiled controller and a compiled model plugin: what calling them costs",
        lambda quick: section_script("compiled.py", *(["--quick"] if quick else [])),
    ),
    "gazebo": (
        "the real Gazebo Classic 11.1 beside this simulator, the same files; only by name: scripts/truth chroot comes first",
        lambda quick: section_script("beside_gazebo.py", *(["--quick"] if quick else []), timeout=3600),
    ),
    "can": ("cycles of rm_hw against the motor bench", lambda quick: section_script("can_loop.py", "--seconds", 5 if quick else 20)),
}
ONLY_BY_NAME = {"gazebo"}
if os.path.exists(os.path.join(HERE, "mobile.py")):
    SECTIONS["mobile"] = ("mbot with its sensors, many of them, and a pile of boxes", lambda quick: section_script("mobile.py"))


def wanted(name):
    """(text, check) of what was asked of a figure, or None."""
    for pattern, relation, limit in WANTED:
        if re.search(pattern, name):
            return f"{relation} {limit:g}", {">=": lambda v: v >= limit, "<": lambda v: v < limit, "<=": lambda v: v <= limit}[relation]
    return None


def show(name, value):
    if isinstance(value, str):
        print(f"  {name:78} {value}")
        return
    goal = wanted(name)
    verdict = f"  wanted {goal[0]:8}{'' if goal[1](value) else '  MISSED'}" if goal else ""
    print(f"  {name:78} {value:12.4g}{verdict}")


def measured(name, options):
    """The figures of a section."""
    figures = SECTIONS[name][1](options.quick)
    if name == "motion" and options.mbm:
        count = ["--count", "10"] if options.quick else []
        figures.update(section_script("problem_sets.py", options.mbm, *count, timeout=3600))
    return figures


def main():
    parser = argparse.ArgumentParser(
        prog="scripts/bench",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Print figures, each ratio measured in one run, and what was asked for.",
        epilog="sections:\n" + "\n".join(f"  {n:10} {t}" for n, (t, _) in SECTIONS.items()),
    )
    parser.add_argument("sections", nargs="*", metavar="SECTION", help="which; default all but gazebo")
    parser.add_argument("--json", metavar="FILE", help="write the figures there as well")
    parser.add_argument("--quick", action="store_true", help="shorter runs, rougher figures")
    parser.add_argument("--mbm", metavar="DIR", help="with section motion: MotionBenchMaker's problems there, see docs/performance.md")
    options = parser.parse_args()
    unknown = [name for name in options.sections if name not in SECTIONS]
    if unknown:
        parser.error(f"no section {', '.join(unknown)}; there are {', '.join(SECTIONS)}")
    if options.mbm and options.sections and "motion" not in options.sections:
        parser.error("--mbm belongs to section motion")
    if options.mbm and not os.path.isdir(options.mbm):
        parser.error(f"--mbm: there is no folder {options.mbm}")
    report = {"machine": platform.platform(), "cores": os.cpu_count(), "load before": os.getloadavg()[0], "figures": {}}
    failed = False
    print(f"{report['machine']}, {report['cores']} cores, load {report['load before']:.1f}")
    names = options.sections or [name for name in SECTIONS if name not in ONLY_BY_NAME]
    for number, name in enumerate(names):
        title, _ = SECTIONS[name]
        load = os.getloadavg()[0]
        print(f"\n{name}: {title} (load before {load:.1f})", flush=True)
        try:
            with progress(len(names), "measuring", "sections") as bar:
                bar.at(number, name)
                figures = measured(name, options)
        except (RuntimeError, OSError, ValueError, subprocess.SubprocessError) as error:
            print(f"  failed: {error}")
            failed = True
            continue
        report["figures"][name] = {"load before": load, **figures}
        for figure, value in figures.items():
            show(figure, value)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(report, out, indent=2)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
