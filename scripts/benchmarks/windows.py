"""Windows: how soon they are there, how large a graph is drawn, whether fast topics block them. On a private X server."""
import argparse
import json
import os
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
elif kind == "console":
    from rosgraph_msgs.msg import Log as Type
    make = lambda i: Type(level=2, name="/bench", msg="message number %d of the benchmark" % i, file="bench.py", line=i % 100, topics=["/a"])
    topic = "/rosout_agg"
else:
    import os
    from sensor_msgs.msg import Image as Type
    frames = [os.urandom(800 * 800 * 3) for _ in range(3)]
    make = lambda i: Type(height=800, width=800, encoding="rgb8", step=2400, data=frames[i % 3])
    topic = "/bench_image"
publisher = rospy.Publisher(topic, Type, queue_size=1000 if kind != "image" else 2)
start, i = time.time(), 0
while not rospy.is_shutdown():
    due = int((time.time() - start) * rate)
    while i < due:
        publisher.publish(make(i))
        i += 1
    time.sleep(0.002)
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
    from rqt_testing import in_process
    from rqt_graph.dotcode import NODE_NODE_GRAPH, NODE_TOPIC_ALL_GRAPH, Options, generate_dot
    from rqt_graph.graph_pane import GraphPane
    from rqt_graph.ros_state import State

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


def load(desktop, kind, rate, command, title, seconds):
    """A window under a fast topic: (part of a core, longest pause in ms, growth of its memory in MB), after a warm-up."""
    publisher = subprocess.Popen([sys.executable, "-c", PUBLISHER, kind, str(rate)], env=desktop.environment)
    try:
        program = desktop.run(command)
        program.window(title)
        time.sleep(3)
        process = psutil.Process(program.process.pid)
        program.ask("pause")
        time.sleep(0.5)
        program.ask("pause")
        before, memory, begin = sum(process.cpu_times()[:2]), process.memory_info().rss, time.monotonic()
        time.sleep(seconds)
        cores = (sum(process.cpu_times()[:2]) - before) / (time.monotonic() - begin)
        figures = cores, program.ask("pause"), (process.memory_info().rss - memory) / 1e6
        program.end()
        return figures
    finally:
        publisher.terminate()
        publisher.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    seconds = 5 if arguments.quick else 30
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory() as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home)
        figures = graph_figures()
        master = subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            from rqt_testing.desktop import Desktop

            with Desktop("1000x900x24") as desktop:
                figures["rqt: from the command to its window, s"] = start_time(desktop, ["rqt"], "rqt")
                figures["rqt_graph: from the command to its window, s"] = start_time(desktop, ["rqt_graph"], "Node Graph")
                for title, kind, rate, command in (
                        ("rqt_plot, 20 curves at 1 kHz", "plot", 1000, ["rqt_plot", "/bench/data[0]:" + ":".join(
                            f"data[{i}]" for i in range(1, 20))]),
                        ("rqt_console, 2 000 messages/s", "console", 2000, ["rqt_console"]),
                        ("rqt_image_view, 800x800 at 30 Hz", "image", 30, ["rqt_image_view", "/bench_image"])):
                    cores, pause, growth = load(desktop, kind, rate, command, "", seconds)
                    figures.update({f"{title}: part of a core": cores, f"{title}: longest pause of the window, ms": pause,
                                    f"{title}: memory grown in {seconds} s, MB": growth})
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
