"""The bench as a program: keys typed in a real terminal, a log recorded and replayed, mistakes on the command line."""

import os
import subprocess
import time

import can
import pexpect
import pytest
from rm_hw import protocol_lines

BENCH = os.path.join(os.path.dirname(__file__), "..", "scripts", "motor_bench")


def open_bus(folder):
    """The driver's end of the bench in ``folder``."""
    protocol_lines.register()
    path, end = os.path.join(folder, "can0"), time.monotonic() + 60.0
    while not os.path.exists(path) and time.monotonic() < end:
        time.sleep(0.01)
    return can.Bus(interface="slcan", channel=f"lines://{path}", bitrate=1000000, sleep_after_open=0)


def test_keys(tmp_path):
    bench = pexpect.spawn(BENCH, ["--no-ros", "--dir", str(tmp_path)], encoding="utf-8", timeout=60)
    bench.expect("keys: Tab next motor")
    for key, answer in (
        ("l", "leave joint1_motor"),
        ("l", "return joint1_motor"),
        ("\x1b[C", "turn joint1_motor 0.1"),
        (" ", "release joint1_motor"),
        (" ", "hold joint1_motor"),
        ("d", "drop joint1_motor 0.5"),
        ("b", "busoff can0"),
        ("b", "recover can0"),
        ("u", "unplug can0"),
        ("u", "plug can0"),
        ("\t", "selected joint1_motor"),
        ("?", "q quit"),
    ):
        bench.send(key)
        bench.expect_exact(answer)
    bench.expect("rad/s .* A .* C")
    bench.send("q")
    bench.expect(pexpect.EOF)
    bench.close()
    assert bench.exitstatus == 0 and os.listdir(tmp_path) == []


def test_record_and_replay(tmp_path):
    log = tmp_path / "run.log"
    bench = subprocess.Popen(
        [BENCH, "--no-ros", "--dir", str(tmp_path), "--log", str(log), "--at", "0.1", "turn joint1_motor 0.2"], stdin=subprocess.DEVNULL
    )
    bus = open_bus(tmp_path)
    recorded = [bytes(bus.recv(60.0).data) for _ in range(300)]
    bench.terminate()
    assert bench.wait(60) == 0
    assert len(set(recorded)) > 10, "the motor moved"
    replay = subprocess.Popen([BENCH, "--no-ros", "--dir", str(tmp_path), "--replay", str(log)], stdin=subprocess.DEVNULL)
    again = open_bus(tmp_path)
    logged = [bytes(m.data) for m in can.LogReader(str(log)) if m.arbitration_id == 0x201]
    assert [bytes(again.recv(60.0).data) for _ in range(len(logged))] == logged
    again.shutdown()
    assert replay.wait(60) == 0


@pytest.mark.parametrize(
    "arguments, remedy", [(["--config", "/no/such.yaml"], "No such file"), (["--replay", "/no/such.log"], "cannot replay")]
)
def test_mistakes_are_one_line(tmp_path, arguments, remedy):
    result = subprocess.run([BENCH, "--no-ros", "--dir", str(tmp_path), *arguments], capture_output=True, text=True, timeout=60)
    assert result.returncode == 1 and remedy in result.stderr and result.stderr.count("\n") == 1
