"""The bench as a driver sees it: through python-can's own slcan back-end, with every fault."""

import random
import time

import can
import pytest
from rm_hw import protocol_lines
from rm_hw.bench.bus import Bench, BenchError
from rm_hw.bench.replay import Replay
from rm_hw.candump import format_frame
from rm_hw.frames import pack_command, pack_feedback, unpack_feedback

FREE = {"motors": {"a": {"bus": "can0", "id": 0x201, "type": "rm_3508"}, "b": {"bus": "can0", "id": 0x205, "type": "rm_6020"}}}


@pytest.fixture
def bench(tmp_path):
    bench = Bench(FREE, str(tmp_path))
    yield bench
    bench.close()


def connect(bench, prefix="lines://", suffix=""):
    protocol_lines.register()
    bus = can.Bus(interface="slcan", channel=f"{prefix}{bench.directory}/can0{suffix}", bitrate=1000000, sleep_after_open=0)
    while not any(port.open for port in bench.buses["can0"].ports if port.path.endswith("can0" + suffix)):
        bench.listen()
    return bus


def take(bus, count):
    """The next ``count`` frames; a pseudo-terminal delivers a moment after the write."""
    return [bus.recv(60.0) for _ in range(count)]


def ids(messages):
    return [m.arbitration_id for m in messages]


def wait_for_command(bench, identifier=0x200):
    for _ in range(60000):
        bench.listen()
        if identifier in bench.buses["can0"].commands:
            return
        time.sleep(0.001)
    raise AssertionError(f"no frame 0x{identifier:03X} came to the bench")


def command(bus, identifier, counts):
    bus.send(can.Message(arbitration_id=identifier, data=pack_command(counts), is_extended_id=False), timeout=0.01)


def test_feedback_and_commands_pass(bench):
    bus = connect(bench)
    command(bus, 0x200, [4096, 0, 0, 0])
    wait_for_command(bench)
    for _ in range(100):
        bench.tick()
    frames = take(bus, 200)
    assert ids(frames) == [0x201, 0x205] * 100
    last = unpack_feedback(frames[-2].data)
    assert last.current == pytest.approx(4096, abs=5) and last.rpm > 100
    assert bench.devices["b"].motor.speed == 0.0
    bus.shutdown()


def test_python_can_without_our_port_reads_it_too(bench):
    bus = connect(bench, prefix="")
    bench.tick()
    assert bus.recv(60.0).arbitration_id == 0x201
    bus.shutdown()


def test_nothing_is_sent_before_the_channel_is_open_nor_after(bench):
    bench.command("turn a 1")
    bench.tick()
    bus = connect(bench)
    bench.command("turn a 0")
    angle = unpack_feedback(pack_feedback(bench.devices["a"].motor.feedback())).angle
    bench.tick()
    first = take(bus, 2)
    assert unpack_feedback(first[0].data).angle > angle, "the frame before the opening was not kept"
    bus.shutdown()
    bench.listen()
    assert not bench.buses["can0"].opened


def test_onlooker_sees_both_directions(bench):
    bus, monitor = connect(bench), connect(bench, suffix=".monitor")
    command(bus, 0x200, [1, 2, 3, 4])
    wait_for_command(bench)
    bench.tick()
    assert ids(take(monitor, 3)) == [0x200, 0x201, 0x205]
    assert ids(take(bus, 2)) == [0x201, 0x205]
    for each in (bus, monitor):
        each.shutdown()


def test_garbage_is_counted_and_frames_go_on(bench):
    bus = connect(bench)
    for _seed in range(50):
        bench.command("garbage can0 200")
        bench.tick()
        bench.tick()
        received = take(bus, 3)  # noise may swallow the first frame behind it, never the next ones
        assert received[-1] is not None and set(ids(received)) == {0x201, 0x205}
        while bus.recv(0.002):
            pass
    assert bus.serialPortOrig.rejected > 0
    bus.shutdown()


@pytest.mark.parametrize("cut", range(1, 21))
def test_frames_split_anywhere_are_joined(bench, cut):
    bus = connect(bench)
    port, line = bench.buses["can0"].ports[0], b"t20181FFFFF9CFFF01900\r"
    port.send_raw(line[:cut])
    assert bus.recv(0.005) is None
    port.send_raw(line[cut:] + line)
    assert [unpack_feedback(m.data).angle for m in take(bus, 2)] == [8191, 8191]
    bus.shutdown()


def test_faults_of_one_motor_leave_the_other_alone(bench):
    bus = connect(bench)

    def tick(count=100):
        for _ in range(count):
            bench.tick()

    bench.command("leave a")
    command(bus, 0x200, [5000, 0, 0, 0])
    wait_for_command(bench)
    tick()
    assert ids(take(bus, 100)) == [0x205] * 100 and bench.devices["a"].motor.command == 0
    bench.command("return a")
    bench.command("drop a 0.5")
    tick(100)
    bench.command("drop a 0")
    tick(1)
    seen = []
    while seen.count(0x205) < 101:
        seen += ids(take(bus, 1))
    assert 25 < seen.count(0x201) < 75
    bench.command("late a 0.01")
    tick(20)
    assert ids(take(bus, 30))[:12] == [0x205] * 10 + [0x201, 0x205]
    bench.command("late a 0")
    bench.command("rate b 250")
    tick(100)
    late = 10  # frames of a that were still under way
    assert ids(take(bus, 125 + late)).count(0x205) == 25
    bus.shutdown()


def test_bus_off_and_unplugging(bench):
    bus = connect(bench)
    bench.command("busoff can0")
    command(bus, 0x200, [5000, 0, 0, 0])
    bench.command("turn a 1")
    for _ in range(5):
        bench.listen()
        bench.tick()
    bench.command("recover can0")
    command(bus, 0x1FF, [7, 0, 0, 0])
    wait_for_command(bench, 0x1FF)
    assert bench.devices["a"].motor.command == 0 and bench.devices["b"].motor.command == 7
    bench.tick()
    assert ids(take(bus, 2)) == [0x201, 0x205]
    bench.command("unplug can0")
    with pytest.raises(can.CanError):
        command(bus, 0x200, [0, 0, 0, 0])
    bench.command("plug can0")
    again = connect(bench)
    bench.tick()
    assert ids(take(again, 2)) == [0x201, 0x205]
    again.shutdown()


def test_an_arm_is_held_until_somebody_listens(tmp_path):
    bench = Bench(None, str(tmp_path))
    motor = bench.devices["joint1_motor"].motor
    for _ in range(500):
        bench.tick()
    assert motor.output_angle == 0.0
    bus = connect(bench)
    for _ in range(500):
        bench.tick()
    assert motor.output_angle > 0.5
    bus.shutdown()
    bench.close()


@pytest.mark.parametrize(
    "line, remedy",
    [
        ("jump a", "no bench command"),
        ("leave c", "there are a, b"),
        ("turn a", "turn MOTOR RADIANS"),
        ("rate a 333", "1000, 500, 250 and 125"),
        ("busoff a", "there are can0"),
        ("", "no bench command"),
    ],
)
def test_wrong_commands_say_how_it_is_done(bench, line, remedy):
    with pytest.raises(BenchError, match=remedy):
        bench.command(line)


@pytest.mark.parametrize(
    "motors, remedy",
    [
        ({}, "no motors"),
        ({"a": {"bus": "can0", "id": 1}}, "no type"),
        ({"a": {"bus": "can0", "id": 0x201, "type": "rm_9000"}}, "known: rm_3508"),
        ({"a": {"bus": "can0", "id": 1, "type": "rm_3508"}}, "0x201..0x20B"),
        ({name: {"bus": "can0", "id": 0x201, "type": "rm_3508"} for name in "ab"}, "twice"),
        ({"a": {"bus": "can0", "id": 0x201, "type": "rm_3508", "load": {"weight": 3}}}, "weight"),
    ],
)
def test_wrong_configurations_are_named(tmp_path, motors, remedy):
    with pytest.raises(BenchError, match=remedy):
        Bench({"motors": motors}, str(tmp_path))


def test_same_seed_same_frames(tmp_path):
    def record():
        seen = []
        bench = Bench(FREE, str(tmp_path), seed=3, watch=lambda bus, frame: seen.append(frame))
        bench.command("drop a 0.3")
        bench.devices["a"].motor.command = 3000
        for _ in range(300):
            bench.tick()
        bench.close()
        return seen

    assert record() == record()


@pytest.mark.parametrize("suffix", ["log", "asc", "csv"])
def test_a_recording_replays_what_the_motors_said(tmp_path, suffix):
    path = str(tmp_path / f"run.{suffix}")
    rng, sent = random.Random(0), []
    with can.Logger(path) as logger:
        for i in range(50):
            for identifier in (0x200, 0x201):
                data = bytes(rng.randrange(32) for _ in range(8))
                logger.on_message_received(
                    can.Message(timestamp=100 + i * 0.001, arbitration_id=identifier, data=data, is_extended_id=False, channel="can0")
                )
                if identifier == 0x201:
                    sent.append(data)
    replay = Replay(path, str(tmp_path))
    name = next(iter(replay.buses))
    bus = can.Bus(interface="slcan", channel=f"lines://{tmp_path}/{name}", bitrate=1000000, sleep_after_open=0)
    while not replay.buses[name].opened:
        replay.listen()
    for _ in range(600):
        replay.listen()
        replay.tick()
    assert [bytes(m.data) for m in take(bus, 50)] == sent and replay.finished
    bus.shutdown()
    replay.close()


def test_a_log_that_is_none_is_named(tmp_path):
    (tmp_path / "x.log").write_text("")
    with pytest.raises(BenchError, match="no frame"):
        Replay(str(tmp_path / "x.log"), str(tmp_path))
    with pytest.raises(BenchError, match="cannot replay"):
        Replay(str(tmp_path / "missing.log"), str(tmp_path))


def test_candump_line():
    message = can.Message(arbitration_id=0x201, data=bytes.fromhex("0F3A000000051C00"), is_extended_id=False)
    assert format_frame("can0", message) == "  can0  201   [8]  0F 3A 00 00 00 05 1C 00"
