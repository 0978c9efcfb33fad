"""``rosrun rm_hw identify``: torque constant and friction of a motor from a CAN log.

The motor turns a flywheel of known inertia J (kg m^2, at the rotor). Between two moments a and b the momentum changes:

    J (w_b - w_a) = k * integral(i) - b * integral(w) - c * integral(sign w)

with the speed w (rad/s), the current i (A), the torque constant k (Nm/A), viscous friction b (Nm s/rad) and dry
friction c (Nm). Each window of the log gives one such equation, least squares the three unknowns. Sums instead of
derivatives: the speed comes in whole revolutions per minute, differences of it are mostly noise.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from dataclasses import dataclass
from typing import Any

import can
import numpy as np

from rm_hw.can_bus import OPEN_ERRORS
from rm_hw.candump import open_bus
from rm_hw.frames import command_slot, pack_command, unpack_feedback

AMPERES_PER_COUNT = {"rm_3508": 20.0 / 16384.0, "rm_2006": 1.0e-3}
_WINDOW = 0.05  # s
_SLOW = 5.0  # rad/s; below it dry friction may hold instead of brake
_MISSING = 1.5  # frames by which a window may fall short
_RATE = 500.0  # Hz of commands


@dataclass(frozen=True)
class Identified:
    """Result of :func:`fit`, at the rotor, with standard errors in the same units.

    :ivar torque_constant: Nm/A; ``coulomb``: Nm; ``viscous``: Nm s/rad.
    :ivar residual: root mean square of the momentum that is not explained, as a share of the momentum exchanged.
    """

    torque_constant: float
    coulomb: float
    viscous: float
    errors: tuple[float, float, float]
    residual: float


def sending_times(arrivals: np.ndarray, period: float) -> np.ndarray:
    """(N,) s: when frames that arrived at ``arrivals`` were sent, given that the sender sends every ``period`` s.

    Frames wait in drivers and for a busy computer, and then come in a burst of which only the last is on time. A frame
    was sent at least j periods before the j-th one after it arrived; lost frames only weaken that bound.
    """
    slots = period * np.arange(len(arrivals))
    return slots + np.minimum.accumulate((arrivals - slots)[::-1])[::-1]


def read_log(path: str, feedback_id: int, type_name: str, rate: float = 1000.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(time s, speed rad/s, current A) of one motor, each (N,).

    :param path: of a log that python-can reads.
    :param feedback_id: identifier of the motor's frames.
    :param type_name: of the motor, which says how many A a count is.
    :param rate: Hz, of the motor's frames.
    :raises ValueError: there are too few frames of it.
    """
    samples = [
        (m.timestamp, f.rpm, f.current)
        for m in can.LogReader(path)
        if m.arbitration_id == feedback_id
        for f in (unpack_feedback(bytes(m.data)),)
    ]
    if len(samples) < 100:
        raise ValueError(f"{path} has {len(samples)} frames of id 0x{feedback_id:03X}: record some seconds of that motor")
    stamps, rpm, counts = np.array(samples, dtype=float).T
    return sending_times(stamps, 1.0 / rate), rpm * (math.pi / 30.0), counts * AMPERES_PER_COUNT[type_name]


def fit(stamps: np.ndarray, speed: np.ndarray, current: np.ndarray, inertia: float, rate: float = 1000.0) -> Identified:
    """Fit the three unknowns. Windows in which frames are missing are left out.

    :param stamps, speed, current: (N,) s, rad/s and A, as from :func:`read_log`.
    :param inertia: kg m^2 at the rotor.
    :param rate: Hz, of the motor's frames.
    :raises ValueError: the motor did not move enough.
    """
    dt = np.diff(stamps)

    def integral(values: np.ndarray) -> np.ndarray:
        return np.concatenate(([0.0], np.cumsum((values[1:] + values[:-1]) / 2.0 * dt)))

    edges = np.searchsorted(stamps, np.arange(stamps[0], stamps[-1], _WINDOW))
    slow = np.concatenate(([0], np.cumsum(np.abs(speed) < _SLOW)))
    pairs = [
        (a, b)
        for a, b in zip(edges[:-1], edges[1:])
        if b > a and slow[b] == slow[a] and abs((stamps[b] - stamps[a]) * rate - (b - a)) < _MISSING
    ]
    if len(pairs) < 20 or np.ptp(speed) < 20.0 * _SLOW:
        raise ValueError("the motor hardly moves in this log: use more current, longer, and in both directions")
    a, b = np.array(pairs).T
    columns = np.column_stack([np.diff([integral(v)[a], integral(v)[b]], axis=0)[0] for v in (current, -np.sign(speed), -speed)])
    momentum = inertia * (speed[b] - speed[a])
    scale = np.abs(columns).max(axis=0)
    solution, squares, rank, _ = np.linalg.lstsq(columns / scale, momentum, rcond=None)
    if rank < 3:
        raise ValueError("friction and torque cannot be told apart in this log: vary the current and the speed")
    variance = squares[0] / (len(pairs) - 3)
    errors = np.sqrt(variance * np.diag(np.linalg.inv((columns / scale).T @ (columns / scale)))) / scale
    values = solution / scale
    residual = math.sqrt(squares[0] / np.sum(momentum**2))
    return Identified(float(values[0]), float(values[1]), float(values[2]), tuple(errors), residual)


def predict(stamps: np.ndarray, speed: np.ndarray, current: np.ndarray, inertia: float, found: Identified) -> np.ndarray:
    """(N,) rad/s: the speed that the identified motor would have had with the recorded current.

    :param stamps, speed, current, inertia: as for :func:`fit`; of ``speed`` the first value counts.
    :param found: what :func:`fit` found.
    """
    result, w = np.empty_like(speed), float(speed[0])
    for k in range(len(stamps)):
        result[k] = w
        if k + 1 < len(stamps):
            dt = stamps[k + 1] - stamps[k]
            w += dt * (found.torque_constant * current[k] - found.viscous * w) / inertia
            brake = dt * found.coulomb / inertia
            w = math.copysign(max(0.0, abs(w) - brake), w)
    return result


def plot(path: str, stamps: np.ndarray, speed: np.ndarray, current: np.ndarray, predicted: np.ndarray, found: Identified) -> None:
    """Write a picture of speed, predicted speed and current to ``path``; its ending says which kind of file.

    :param stamps, speed, current: as from :func:`read_log`.
    :param predicted: (N,) rad/s, from :func:`predict`.
    :param found: what :func:`fit` found, for the title.
    """
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    _, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(9, 5))
    seconds = stamps - stamps[0]
    above.plot(seconds, speed, label="measured")
    above.plot(seconds, predicted, "--", label="identified model, same current")
    above.set(
        ylabel="rotor speed, rad/s",
        title=(
            f"k = {found.torque_constant:.5f} Nm/A, dry friction {1000 * found.coulomb:.2f} mNm, "
            f"viscous {1e6 * found.viscous:.2f} uNm s/rad"
        ),
    )
    above.legend()
    below.plot(seconds, current, color="tab:red")
    below.set(ylabel="current, A", xlabel="s")
    plt.tight_layout()
    plt.savefig(path, dpi=90)


def _excite(options: argparse.Namespace) -> None:
    """Send a current that sweeps through speeds in both directions, and record the bus."""
    command_id, slot = command_slot(options.id)
    bus, name = open_bus(options.bus, None, None)
    counts, start, due = options.amperes / AMPERES_PER_COUNT[options.type], time.time(), 0.0
    try:
        logger: Any  # a Logger is made as what writes the file's kind
        with can.Logger(options.log) as logger:
            while (elapsed := time.time() - start) < options.seconds:
                if elapsed >= due:
                    due = elapsed + 1.0 / _RATE
                    wave = math.sin(2 * math.pi * 0.4 * elapsed) + 0.4 * math.sin(2 * math.pi * 2.3 * elapsed)
                    frame = [0, 0, 0, 0]
                    frame[slot] = int(counts * wave / 1.4)
                    bus.send(can.Message(arbitration_id=command_id, data=pack_command(frame), is_extended_id=False))
                message = bus.recv(0.001)
                if message is not None:
                    message.channel = name
                    logger.on_message_received(message)
    finally:
        bus.send(can.Message(arbitration_id=command_id, data=bytes(8), is_extended_id=False))
        bus.shutdown()
    print(f"recorded {options.seconds:g} s to {options.log}")


def _fit(options: argparse.Namespace) -> None:
    stamps, speed, current = read_log(options.log, options.id, options.type, options.rate)
    found = fit(stamps, speed, current, options.inertia, options.rate)
    for label, value, error in zip(
        ("torque constant Nm/A", "dry friction Nm", "viscous friction Nm s/rad"),
        (found.torque_constant, found.coulomb, found.viscous),
        found.errors,
    ):
        print(f"{label:26} {value:11.4e} +- {error:.1e}")
    print(f"unexplained                {100 * found.residual:.2f} % of the momentum")
    if options.plot:
        plot(options.plot, stamps, speed, current, predict(stamps, speed, current, options.inertia, found), found)


def main(arguments: list[str] | None = None) -> int:
    """Run ``excite`` or ``fit``; returns the exit code."""
    parser = argparse.ArgumentParser(prog="identify", description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(required=True, metavar="excite|fit")
    excite = commands.add_parser("excite", help="move a motor and record the bus; the motor must be free to turn")
    excite.add_argument("bus", help="for example can0")
    excite.add_argument("--amperes", type=float, default=2.0, help="largest current (%(default)s)")
    excite.add_argument("--seconds", type=float, default=10.0)
    excite.set_defaults(run=_excite)
    fitting = commands.add_parser("fit", help="torque constant and friction from a log")
    fitting.add_argument(
        "--inertia", type=float, required=True, help="kg m^2 at the rotor: its own, and the load's divided by the square of the gear ratio"
    )
    fitting.add_argument("--rate", type=float, default=1000.0, help="of the motor's frames in Hz (%(default)g)")
    fitting.add_argument("--plot", metavar="FILE", help="write a picture")
    fitting.set_defaults(run=_fit)
    for each in (excite, fitting):
        each.add_argument("--log", required=True, metavar="FILE", help=".log, .asc, .blf or .csv")
        each.add_argument("--id", type=lambda text: int(text, 0), default=0x201, help="of its feedback (0x201)")
        each.add_argument("--type", choices=sorted(AMPERES_PER_COUNT), default="rm_3508")
    options = parser.parse_args(arguments)
    try:
        options.run(options)
    except KeyboardInterrupt:
        return 1
    except OPEN_ERRORS as error:
        print(f"identify: {error}", file=sys.stderr)
        return 1
    return 0
