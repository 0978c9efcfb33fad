"""``rosrun rm_hw candump can0``: print the frames of a bus as candump of can-utils does, also from the motor bench."""

from __future__ import annotations

import argparse
import os
import signal
import sys

import can

from rm_hw.can_bus import OPEN_ERRORS, open_interface
from rm_hw.config import BENCH_DIRECTORY


def format_frame(channel: str, message: can.Message) -> str:
    """``message``, of the bus ``channel``, as a line: ``  can0  201   [8]  0F 3A 00 00 00 05 1C 00``."""
    identifier = f"{message.arbitration_id:08X}" if message.is_extended_id else f"{message.arbitration_id:03X}"
    data = "remote request" if message.is_remote_frame else " ".join(f"{byte:02X}" for byte in message.data)
    return f"  {channel}  {identifier}   [{message.dlc}]  {data}"


def open_bus(name: str, interface: str | None, channel: str | None) -> tuple[can.BusABC, str]:
    """Open bus ``name`` and return it with its name; without ``interface`` the bench's onlooker port if there is one.

    :param channel: as for :func:`open_interface`; None is what the bus is called.
    :raises OSError, ValueError, can.CanError: it cannot be opened.
    """
    monitor = os.path.join(BENCH_DIRECTORY, f"{name}.monitor")
    if interface is None and os.path.exists(monitor):
        return open_interface("slcan", channel or monitor), name
    return open_interface(interface or "socketcan", channel or name), name


def main(arguments: list[str] | None = None) -> int:
    """Print until Ctrl-C; returns the exit code."""
    parser = argparse.ArgumentParser(prog="candump", description=__doc__)
    parser.add_argument("bus", help="interface, for example can0")
    parser.add_argument("-n", type=int, default=0, metavar="COUNT", help="stop after so many frames")
    parser.add_argument("-i", "--interface", help="python-can interface; found by itself for SocketCAN and the bench")
    parser.add_argument("-c", "--channel", help="device of the interface, for example /dev/ttyACM0")
    parser.add_argument("-l", "--log", metavar="FILE", help="write to a log as well (.log, .asc, .blf, .csv)")
    parser.add_argument("-q", "--quiet", action="store_true", help="do not print frames")
    options = parser.parse_args(arguments)
    try:
        bus, _ = open_bus(options.bus, options.interface, options.channel)
        logger = can.Logger(options.log) if options.log else None
    except OPEN_ERRORS as error:
        print(
            f"candump: cannot open {options.bus}: {error}; is the interface up (ip link set {options.bus} up type "
            f"can bitrate 1000000), or 'rosrun rm_hw motor_bench' running?",
            file=sys.stderr,
        )
        return 1
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    seen = 0
    try:
        while not options.n or seen < options.n:
            message = bus.recv(0.2)
            if message is None:
                sys.stdout.flush()
                continue
            seen += 1
            message.channel = options.bus
            if logger:
                logger.on_message_received(message)
            if not options.quiet:
                print(format_frame(options.bus, message))
    except (KeyboardInterrupt, BrokenPipeError):
        pass
    except can.CanError as error:
        print(f"candump: {options.bus} is gone: {error}", file=sys.stderr)
        return 1
    finally:
        if logger:
            logger.stop()
        _close(bus)
    return 0


def _close(bus: can.BusABC) -> None:
    try:
        bus.shutdown()
    except can.CanError:
        return  # the adapter went before us
