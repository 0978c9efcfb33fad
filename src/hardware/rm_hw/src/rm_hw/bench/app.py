"""``rosrun rm_hw motor_bench``: the bench in real time, with keys, ROS topics and a CAN log."""

from __future__ import annotations

import argparse
import contextlib
import math
import os
import queue
import signal
import sys
import time

import can
import yaml

from rm_hw.bench.bus import TICK, Bench, BenchError, Frame
from rm_hw.bench.keys import HELP, Keys
from rm_hw.bench.replay import Replay
from rm_hw.config import BENCH_DIRECTORY

_FURTHEST_BEHIND = 0.05  # s; a bench that was suspended longer than this does not catch up
_PRIORITY = 50
_PUBLISH_EVERY = 10  # ticks
_STATUS_EVERY = 200


class Recorder:
    """Writes every frame of every bus to a log of python-can; the suffix chooses the format (.log: candump's).

    Stamps are the bench's own time, in which motors are never late.
    """

    def __init__(self, path: str | None) -> None:
        self._logger = can.Logger(path) if path else None
        self._start = time.time()
        self.bench: Bench | Replay | None = None

    def __call__(self, bus: str, frame: Frame) -> None:
        if self._logger and self.bench is not None:
            self._logger.on_message_received(
                can.Message(
                    timestamp=self._start + self.bench.time, arbitration_id=frame.id, data=frame.data, channel=bus, is_extended_id=False
                )
            )

    def close(self) -> None:
        if self._logger:
            self._logger.stop()


class RosFace:
    """``~joint_states`` (100 Hz, behind the gearbox), ``~turn/MOTOR`` (std_msgs/Float64, rad by hand), ``~command``."""

    def __init__(self, bench: Bench | Replay, commands: queue.Queue) -> None:
        import rospy
        from sensor_msgs.msg import JointState
        from std_msgs.msg import Float64

        from rm_hw.srv import BenchCommand, BenchCommandResponse

        rospy.init_node("motor_bench", disable_signals=True)
        self._rospy, self._message, self._bench = rospy, JointState(), bench
        self._publisher = rospy.Publisher("~joint_states", JointState, queue_size=5)

        def carry_out(line: str) -> BenchCommandResponse:
            answer: queue.Queue = queue.Queue()
            commands.put((line, answer))
            return BenchCommandResponse(*answer.get())

        self._service = rospy.Service("~command", BenchCommand, lambda request: carry_out(request.command))
        self._turns = [
            rospy.Subscriber(f"~turn/{name}", Float64, lambda m, name=name: commands.put((f"turn {name} {m.data}", None)))
            for name in bench.devices
        ]

    def publish(self) -> None:
        motors = {name: device.motor for name, device in self._bench.devices.items()}
        self._message.header.stamp = self._rospy.Time.now()
        self._message.name = list(motors)
        self._message.position = [motor.output_angle for motor in motors.values()]
        self._message.velocity = [motor.output_speed for motor in motors.values()]
        self._message.effort = [motor.torque * motor.ratio for motor in motors.values()]
        self._publisher.publish(self._message)

    def shutdown(self) -> None:
        self._rospy.signal_shutdown("the bench ends")


def _arguments(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="motor_bench", description=__doc__.splitlines()[0], epilog=HELP, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--config",
        metavar="FILE",
        help="YAML: motors: {NAME: {bus, id, type, gear, load}}; without it the motor of rm_controls_tutorials with its arm",
    )
    parser.add_argument("--dir", default=BENCH_DIRECTORY, help="folder for the serial ports, BUS and BUS.monitor (%(default)s)")
    parser.add_argument("--log", metavar="FILE", help="record all frames (.log, .asc, .blf, .csv)")
    parser.add_argument("--replay", metavar="FILE", help="play the motors of a log instead of simulating some")
    parser.add_argument(
        "--at",
        nargs=2,
        action="append",
        default=[],
        metavar=("SECONDS", "COMMAND"),
        help="carry out a bench command at that time; may be repeated",
    )
    parser.add_argument("--no-ros", action="store_true", help="keys only, do not look for a roscore")
    return parser.parse_args(arguments)


def _status(bench: Bench | Replay, selected: str | None) -> str:
    parts = []
    for name, device in bench.devices.items():
        motor = device.motor
        state = "" if device.present else " GONE"
        state += " held" if motor.held else ""
        parts.append(
            f"{'>' if name == selected else ' '}{name} {math.degrees(motor.output_angle):8.1f} deg "
            f"{motor.output_speed:7.2f} rad/s {motor.current:6.2f} A {motor.temperature:4.0f} C{state}"
        )
    return " |".join(parts)


class App:
    """The loop: one tick a millisecond of wall time."""

    def __init__(self, options: argparse.Namespace) -> None:
        self._recorder = Recorder(options.log)
        if options.replay:
            self.bench: Bench | Replay = Replay(options.replay, options.dir, self._recorder)
        else:
            config = None
            if options.config:
                with open(options.config) as file:
                    config = yaml.safe_load(file)
                if not isinstance(config, dict):
                    raise BenchError(f"{options.config}: write 'motors: {{NAME: {{bus, id, type}}}}'")
            self.bench = Bench(config, options.dir, watch=self._recorder)
        self._recorder.bench = self.bench
        self._plan = sorted((float(seconds), line) for seconds, line in options.at)
        self._commands: queue.Queue = queue.Queue()
        self._ros = None
        if not options.no_ros:
            import rosgraph

            if rosgraph.is_master_online():
                self._ros = RosFace(self.bench, self._commands)
            else:
                print(f"motor_bench: no roscore at {rosgraph.get_master_uri()}; going on without topics")
        self._stopped = False
        self._ticks = 0

    def stop(self, *_) -> None:
        self._stopped = True

    def run(self) -> None:
        """Until :meth:`stop`, the key q, or the end of a recording."""
        for name, bus in self.bench.buses.items():
            print(f"motor_bench: {name} is {bus.ports[0].path} (interface: slcan); look on with 'rosrun rm_hw candump {name}'", flush=True)
        keys = Keys(self.bench) if sys.stdin.isatty() and sys.stdout.isatty() else None
        with keys or contextlib.nullcontext():
            if keys:
                print(HELP)
            self._loop(keys)

    def close(self) -> None:
        self.bench.close()
        self._recorder.close()
        if self._ros:
            self._ros.shutdown()

    def _loop(self, keys: Keys | None) -> None:
        with contextlib.suppress(PermissionError):  # a motor is never late; the bench tries to be like it
            os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(_PRIORITY))
        due = time.monotonic()
        while not self._stopped:
            due += TICK
            late = time.monotonic() - due
            if late < 0.0:
                time.sleep(-late)
            elif late > _FURTHEST_BEHIND:
                due += late
            self.bench.listen()
            self._carry_out()
            self.bench.tick()
            self._ticks += 1
            if self._ros and self._ticks % _PUBLISH_EVERY == 0:
                self._ros.publish()
            if keys and self._ticks % _PUBLISH_EVERY == 0:
                try:
                    said = keys.poll()
                except EOFError:
                    return
                if said:
                    print("\r\x1b[K" + said)
                if self._ticks % _STATUS_EVERY == 0:
                    print("\r" + _status(self.bench, keys.motor) + "\x1b[K", end="", flush=True)
            if isinstance(self.bench, Replay) and self.bench.finished:
                print("motor_bench: the recording is over")
                return

    def _carry_out(self) -> None:
        while self._plan and self._plan[0][0] <= self.bench.time:
            self._do(self._plan.pop(0)[1], None)
        while not self._commands.empty():
            self._do(*self._commands.get())

    def _do(self, line: str, answer: queue.Queue | None) -> None:
        try:
            success, text = True, self.bench.command(line)
        except BenchError as error:
            success, text = False, str(error)
        print(f"\rmotor_bench: {text}\x1b[K" if sys.stdout.isatty() else f"motor_bench: {text}", flush=True)
        if answer:
            answer.put((success, text))


def main(arguments: list[str] | None = None) -> int:
    """Run the bench; returns the exit code."""
    options = _arguments([a for a in (sys.argv[1:] if arguments is None else arguments) if ":=" not in a])
    try:
        app = App(options)
    except (BenchError, OSError, ValueError, yaml.YAMLError) as error:
        print(f"motor_bench: {error}", file=sys.stderr)
        return 1
    signal.signal(signal.SIGINT, app.stop)
    signal.signal(signal.SIGTERM, app.stop)
    try:
        app.run()
    finally:
        app.close()
    return 0
