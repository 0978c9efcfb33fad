"""Windows: how soon they are there, how large a graph is drawn, whether fast topics block them. On a private X server."""

import argparse
import contextlib
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

import psutil

PUBLISHER = """
import sys, time, rospy
kind, rate = sys.argv[1], float(sys.argv[2])
rospy.init_node("bench_" + kind)
if kind == "plot":
    from std_msgs.msg import Float64MultiArray as Type
    make = lambda i: Type(data=[(i % 1000) / 1000.0 + k for k in range(20)])
    topic = "/bench"
elif kind == "topics":
    from std_msgs.msg import Float64 as Type
    make = lambda i: Type(data=(i % 1000) / 1000.0)
    topic = None
elif kind == "console":
    from rosgraph_msgs.msg import Log as Type
    make = lambda i: Type(level=2, name="/bench", msg="message number %d of the benchmark" % i, file="bench.py", line=i % 100,
                          topics=["/a"])
    topic = "/rosout_agg"
else:
    import os
    from sensor_msgs.msg import Image as Type
    frames = [os.urandom(800 * 800 * 3) for _ in range(3)]
    make = lambda i: Type(height=800, width=800, encoding="rgb8", step=2400, data=frames[i % 3])
    topic = "/bench_image"
topics = [topic] if topic else [f"/bench_{i}" for i in range(20)]
publishers = [rospy.Publisher(topic, Type, queue_size=1000 if kind != "image" else 2) for topic in topics]
start, i = time.time(), 0
while not rospy.is_shutdown():
    due = int((time.time() - start) * rate)
    while i < due:
        message = make(i)
        for publisher in publishers:
            publisher.publish(message)
        i += 1
    time.sleep(0.002)
print(i / (time.time() - start))
"""


def start_time(desktop, command, title):
    """Seconds from the command to its window, the least of three starts: what other programs cost is not the window's."""
    times = []
    for _ in range(3):
        begin = time.monotonic()
        program = desktop.run(command)
        program.window(title)
        times.append(time.monotonic() - begin)
        program.end()
    return min(times)


def graph_figures():
    """Seconds from a graph of 50 nodes and 300 topics to its drawing, here, on Qt's offscreen platform."""
    from rqt_graph.dotcode import NODE_NODE_GRAPH, NODE_TOPIC_ALL_GRAPH, Options, generate_dot
    from rqt_graph.graph_pane import GraphPane
    from rqt_graph.ros_state import State
    from rqt_testing import in_process

    in_process.application()
    state = State({f"/ns{i % 5}/node_{i}" for i in range(50)})
    nodes = sorted(state.nodes)
    for i in range(300):
        start, end, topic = nodes[i % 50], nodes[(i * 7 + i // 50 + 1) % 50], f"{nodes[i % 50]}/topic_{i}"
        state.publishers[topic], state.subscribers[topic] = [start], [end]
        state.connections.add((start, topic, end))
    figures = {}
    for title, mode in (("nodes only", NODE_NODE_GRAPH), ("nodes and topics", NODE_TOPIC_ALL_GRAPH)):
        pane, drawn, begin = GraphPane(), [], time.monotonic()
        pane.drawn.connect(lambda: drawn.append(1))
        pane.resize(800, 600)
        pane.show()
        pane.show_dot(generate_dot(state, Options(mode)))
        in_process.wait_until(lambda: drawn, 60)
        figures[f"rqt_graph, 50 nodes, 300 topics, {title}: drawn, s"] = time.monotonic() - begin
    return figures


LOADS = {  # title: (what is published, its rate in Hz, the command)
    "rqt_plot, 20 curves of one topic at 1 kHz": (
        "plot",
        1000,
        ["rqt_plot", "/bench/data[0]:" + ":".join(f"data[{i}]" for i in range(1, 20))],
    ),
    "rqt_plot, 20 topics at 1 kHz": ("topics", 1000, ["rqt_plot", *(f"/bench_{i}/data" for i in range(20))]),
    "rqt_console, 2 000 messages/s": ("console", 2000, ["rqt_console"]),
    "rqt_image_view, 800x800 at 30 Hz": ("image", 30, ["rqt_image_view", "/bench_image"]),
    "rqt_graph, refreshed every 2 s": (None, 0, ["rqt_graph"]),
}


@contextlib.contextmanager
def published(desktop, kind, rate):
    """A fast publisher while this lasts; afterwards the list that is given has the rate that it reached, in Hz."""
    reached = []
    if kind is None:
        yield reached
        return
    publisher = subprocess.Popen(
        [sys.executable, "-c", PUBLISHER, kind, str(rate)], env=desktop.environment, text=True, stdout=subprocess.PIPE
    )
    try:
        yield reached
    finally:
        publisher.send_signal(signal.SIGINT)
        reached += [float(line) for line in publisher.communicate()[0].split()]


def load(desktop, kind, rate, command, seconds):
    """A window under a fast topic, after a warm-up: its figures by name."""
    with published(desktop, kind, rate) as reached:
        program = opened(desktop, command)
        time.sleep(3)
        process = psutil.Process(program.process.pid)
        program.ask("pause")
        time.sleep(0.5)
        program.ask("pause")
        before, memory, begin = sum(process.cpu_times()[:2]), process.memory_info().rss, time.monotonic()
        time.sleep(seconds)
        cores = (sum(process.cpu_times()[:2]) - before) / (time.monotonic() - begin)
        pause, processor = program.ask("pause")
        figures = {
            "part of a core": cores,
            "longest pause of the window, ms": pause,
            "of its processor time, ms": processor,
            f"memory grown in {seconds} s, MB": (process.memory_info().rss - memory) / 1e6,
        }
        program.end()
    return {**figures, **({"rate that was published, Hz": reached[0]} if reached else {})}


def opened(desktop, command):
    """The program with its window; a graph refreshes by itself."""
    program = desktop.run(command)
    program.window("")
    if command == ["rqt_graph"]:
        program.click("auto_refresh_check_box")
    return program


def soak(desktop, minutes, only):
    """All windows under their topics at the same time: memory in MB every half minute, printed as it comes; the growth from the
    third minute (buffers are full by then) to the end is the figure."""
    with contextlib.ExitStack() as stack:
        programs = {}
        for title, (kind, rate, command) in LOADS.items():
            if only in title:
                stack.enter_context(published(desktop, kind, rate))
                programs[title] = opened(desktop, command)
        series = {title: [] for title in programs}
        for _ in range(2 * minutes + 1):
            for title, program in programs.items():
                series[title].append(psutil.Process(program.process.pid).memory_info().rss / 1e6)
            print(f"{(len(series[title]) - 1) / 2:5} min", *(f"{values[-1]:8.1f}" for values in series.values()), flush=True)
            time.sleep(30)
        for program in programs.values():
            program.end()
    settled = min(6, minutes)
    return {
        f"{title}: memory grown from minute {settled / 2:g} to {minutes}, MB": values[-1] - values[settled]
        for title, values in series.items()
    }


def all_figures(desktop, seconds, only):
    figures = {}
    if not only:
        figures["rqt: from the command to its window, s"] = start_time(desktop, ["rqt"], "rqt")
        figures["rqt_graph: from the command to its window, s"] = start_time(desktop, ["rqt_graph"], "Node Graph")
    for title, what in LOADS.items():
        if only in title:
            figures.update({f"{title}: {name}": value for name, value in load(desktop, *what, seconds).items()})
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--soak", type=int, metavar="MINUTES", help="only this: memory of all windows under their topics")
    parser.add_argument("--only", default="", metavar="TEXT", help="windows whose title has this in it")
    arguments = parser.parse_args()
    seconds = 5 if arguments.quick else 30
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory() as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home)
        figures = {} if arguments.soak or arguments.only else graph_figures()
        master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            from rqt_testing.desktop import Desktop

            with Desktop("1000x900x24") as desktop:
                figures.update(
                    soak(desktop, arguments.soak, arguments.only) if arguments.soak else all_figures(desktop, seconds, arguments.only)
                )
        finally:
            master.terminate()
            master.wait()
    for name, value in figures.items():
        print(f"{name:80} {value:10.4g}")
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(figures, file)


if __name__ == "__main__":
    main()
