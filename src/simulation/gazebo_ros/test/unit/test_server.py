"""The step loop with a real world and no ROS network."""

import threading
import xml.etree.ElementTree as ET
from dataclasses import replace

import ode_sim
import pytest
import rospy
from gazebo_ros import ModelPlugin, PluginError, SensorPlugin, WorldPlugin
from gazebo_ros import server as server_module
from gazebo_ros.plugin_host import PluginHost, library_key
from gazebo_ros.server import Server, Stopped
from ode_sim.description import ResourceFinder, load_world, read_sdf_model

WORLD = """<sdf version="1.6"><world name="w">
<physics type="ode"><real_time_update_rate>0</real_time_update_rate></physics>
{plugins}<model name="block"><link name="link"><gravity>false</gravity>
<sensor name="eye" type="imu"><update_rate>100</update_rate>{sensor}</sensor></link>{model}</model></world></sdf>"""
LOG = []


class Recorder(ModelPlugin):
    def load(self, server, model, sdf):
        self.tag = sdf.get("tag", "?")
        LOG.append(f"load {self.tag} of {model.name}")
        server.before_step(lambda: LOG.append(f"before {self.tag} {server.now().to_nsec() // 1000000}"))
        server.after_step(lambda: LOG.append(f"after {self.tag}"))

    def reset(self):
        LOG.append(f"reset {self.tag}")

    def shutdown(self):
        LOG.append(f"shutdown {self.tag}")


class WorldRecorder(WorldPlugin):
    def load(self, server, sdf):
        LOG.append("load world")
        server.before_step(lambda: LOG.append("before world"))


class Eye(SensorPlugin):
    def load(self, server, sensor, sdf):
        LOG.append(f"load {sensor.scoped_name}")
        sensor.connect(lambda s: LOG.append(f"see {s.measurement_ns // 1000000}"))


class Wrong(ModelPlugin):
    def load(self, server, model, sdf):
        server.before_step(lambda: LOG.append("never"))
        raise PluginError("<jointName> is missing; name a joint of the model")


class Breaks(ModelPlugin):
    def load(self, server, model, sdf):
        server.before_step(self.fail)
        server.after_step(lambda: LOG.append("still connected"))

    def fail(self):
        LOG.append("failing")
        raise ZeroDivisionError("by hand")


class Driver(ModelPlugin):
    def load(self, server, model, sdf):
        server.drives(*(model.joints[name] for name in sdf.get("joints", "").split()))


@pytest.fixture
def errors(monkeypatch):
    lines = []
    monkeypatch.setattr(rospy, "logerr", lambda text, *args: lines.append(text % args))
    monkeypatch.setattr(rospy, "logwarn", lambda text, *args: lines.append(text % args))
    return lines


@pytest.fixture
def host(tmp_path):
    """A package that exports the classes above."""
    LOG.clear()
    package = tmp_path / "my_plugins"
    package.mkdir()
    (package / "package.xml").write_text("""<package format="2"><name>my_plugins</name><version>0.0.1</version>
        <description>d</description><maintainer email="a@b.c">m</maintainer><license>BSD</license>
        <depend>gazebo_ros</depend><export><gazebo_ros plugin="${prefix}/plugins.xml"/></export></package>""")
    names = {"recorder": "Recorder", "world": "WorldRecorder", "eye": "Eye", "wrong": "Wrong", "breaks": "Breaks", "driver": "Driver"}
    (package / "plugins.xml").write_text(
        '<library path=".">'
        + "".join(f'<class name="lib{name}.so" type="{__name__}.{cls}"/>' for name, cls in names.items())
        + "</library>"
    )
    import rospkg

    return PluginHost(rospkg.RosPack(ros_paths=[str(tmp_path)]))


def make(host, plugins="", model="", sensor="", **options):
    finder = ResourceFinder(environment=False)
    description, _ = load_world(WORLD.format(plugins=plugins, model=model, sensor=sensor), finder)
    world = ode_sim.World(description)
    return Server(world, description, finder, host, ros_time=False, **options)


def recorder(tag):
    return f"<plugin name='{tag}' filename='librecorder.so'><tag>{tag}</tag></plugin>"


class Running:
    """The loop in a thread; ended at the end of the block."""

    def __init__(self, server):
        self.server = server
        self.thread = threading.Thread(target=server.run, daemon=True)

    def __enter__(self):
        self.thread.start()
        return self.server

    def __exit__(self, *_):
        self.server.stop()
        self.thread.join(10)
        assert not self.thread.is_alive()


@pytest.mark.parametrize("name", ["libx.so", "x", " libx.so\n", "/usr/lib/libx.so", "x.so", "libx"])
def test_old_ways_to_write_a_library_name(name):
    assert library_key(name) == "x"


def test_order_of_loading_and_calling(host):
    server = make(
        host,
        "<plugin name='w' filename='libworld.so'/>",
        recorder("a") + recorder("b"),
        "<plugin name='e' filename='libeye.so'/>",
        iterations=1,
    )
    server.run()
    assert LOG == [
        "load world",
        "load block::link::eye",
        "load a of block",
        "load b of block",
        "before world",
        "before a 1",
        "before b 1",
        "after a",
        "after b",
        "shutdown a",
        "shutdown b",
    ]


def test_sensor_rate_in_sim_time(host):
    make(host, sensor="<plugin name='e' filename='libeye.so'/>", iterations=35).run()
    assert [line for line in LOG if line.startswith("see")] == ["see 10", "see 20", "see 30"]


def test_iterations_end_the_run(host):
    server = make(host, iterations=50)
    server.run()
    assert server.world.time_ns == 50_000_000


@pytest.mark.parametrize(
    "filename, said",
    [
        ("librecordr.so", "plugin p (librecordr.so) of model block is not known here and is left out. Did you mean librecorder.so?"),
        ("libunheard_of.so", "It is none of the "),
        ("libunheard_of.so", "nor a library in GAZEBO_PLUGIN_PATH, LD_LIBRARY_PATH or a sourced workspace's lib"),
        ("", "plugin p (no filename) of model block is left out: it names no library"),
    ],
)
def test_unknown_plugin_is_one_short_line_that_helps(host, errors, filename, said):
    make(host, model=f"<plugin name='p' filename='{filename}'>...</plugin>" + recorder("a"), iterations=1).run()
    assert len(errors) == 1 and said in errors[0]
    assert len(errors[0]) < 250
    assert "load a of block" in LOG


def test_wrong_parameter_is_one_line_and_leaves_nothing_behind(host, errors):
    make(host, model="<plugin name='p' filename='libwrong.so'/>" + recorder("a"), iterations=2).run()
    assert errors == ["plugin p (libwrong.so) of model block: <jointName> is missing; name a joint of the model"]
    assert "never" not in LOG and "load a of block" in LOG


def test_failing_callback_is_disconnected_with_one_line(host, errors):
    make(host, model="<plugin name='p' filename='libbreaks.so'/>" + recorder("a"), iterations=3).run()
    assert errors == ["plugin p (libbreaks.so) of model block: ZeroDivisionError: by hand"]
    assert LOG.count("failing") == 1 and LOG.count("after a") == 3


def test_plugin_in_the_wrong_place(host, errors):
    make(host, model="<plugin name='p' filename='libeye.so'/>", iterations=1).run()
    assert len(errors) == 1 and "no ModelPlugin" in errors[0]


def test_call_runs_between_steps_and_passes_results_and_errors(host):
    with Running(make(host, paused=True)) as server:
        assert server.call(lambda: server.call(lambda: threading.current_thread().name)) != threading.current_thread().name
        with pytest.raises(KeyError):
            server.call(lambda: {}["x"])
        assert server.world.time_ns == 0


def test_call_after_the_end_is_refused(host):
    with Running(make(host)) as server:
        pass
    with pytest.raises(Stopped):
        server.call(lambda: None)


def test_stop_wakes_a_paused_server_and_releases_those_who_wait(host):
    server = make(host, paused=True)
    with Running(server):
        steps = server.call(lambda: server.request_steps(10**9))
    with pytest.raises(Stopped):
        steps.result(5)


def test_step_requests(host):
    with Running(make(host, paused=True)) as server:
        server.call(lambda: server.request_steps(20)).result(10)
        assert server.world.time_ns == 20_000_000 and server.now() == rospy.Time(0, 20_000_000)
        with pytest.raises(ValueError, match="at least 1"):
            server.call(lambda: server.request_steps(0))
        server.call(server.unpause)
        with pytest.raises(ValueError, match="pause"):
            server.call(lambda: server.request_steps(1))


def test_spawned_plugins_start_and_end_with_their_model(host):
    with Running(make(host, paused=True)) as server:
        text = f"<sdf version='1.6'><model name='m'><link name='l'/>{recorder('m')}</model></sdf>"
        model, _ = read_sdf_model(text, finder=server.finder)
        resolved = server.plugins.resolve(model)
        server.call(lambda: server.spawn(model, resolved))
        server.call(lambda: server.request_steps(2)).result(10)
        assert LOG == ["load m of m", "before m 1", "after m", "before m 2", "after m"]
        LOG.clear()
        server.call(lambda: server.remove("m"))
        server.call(lambda: server.request_steps(2)).result(10)
        assert LOG == ["shutdown m"]
        assert "m" not in server.world.models


def test_resets_reach_the_plugins(host):
    with Running(make(host, model=recorder("a"), paused=True)) as server:
        server.call(lambda: server.request_steps(5)).result(10)
        server.call(server.reset_world)
        assert server.world.time_ns == 5_000_000
        server.call(server.reset_simulation)
        assert server.world.time_ns == 0 and server.now() == rospy.Time()
        assert LOG.count("reset a") == 2
        server.call(lambda: server.request_steps(5)).result(10)
        server.call(server.reset_time)
        assert server.world.time_ns == 0 and server.now() == rospy.Time() and server.world.iterations == 5
        assert LOG.count("reset a") == 3


DRIVEN = "".join(
    f"""<link name="{child}"/><joint name="{name}" type="revolute"><parent>link</parent><child>{child}</child>
<axis><xyz>0 1 0</xyz></axis></joint>"""
    for name, child in (("axle", "wheel"), ("second", "other"))
)


def test_two_plugins_that_drive_the_same_joints_are_one_line(host, errors):
    def driver(name, joints):
        return f"<plugin name='{name}' filename='libdriver.so'><joints>{joints}</joints></plugin>"

    plugins = driver("a", "axle second") + driver("b", "axle second") + driver("c", "")
    with Running(make(host, model=DRIVEN + plugins, paused=True)) as server:
        server.call(lambda: None)
        told = [line for line in errors if "drive" in line]
        assert len(told) == 1, errors
        for word in ("plugin a (libdriver.so)", "plugin b (libdriver.so)", "axle, second", "model block"):
            assert word in told[0]
        server.call(lambda: server.remove("block"))  # and may be spawned anew, with one plugin
        description = replace(server.description.models[0], plugins=server.description.models[0].plugins[:1])
        server.call(lambda: server.spawn(description, server.plugins.resolve(description)))
        assert len([line for line in errors if "drive" in line]) == 1, errors
