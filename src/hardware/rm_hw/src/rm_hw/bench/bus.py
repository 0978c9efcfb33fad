"""Motors, ports and faults joined into CAN buses. No clock of its own: ``tick`` is one millisecond."""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from rm_hw.bench.motor import SPECS, TUTORIAL_ARM, Load, Motor
from rm_hw.bench.slcan import Frame, SlcanPort
from rm_hw.coefficients import ConfigError
from rm_hw.frames import RM_COMMAND_IDS, command_slot, pack_feedback, unpack_command

TICK = 0.001
TUTORIAL = {"motors": {"joint1_motor": {"bus": "can0", "id": 0x201, "type": "rm_3508", "load": "tutorial_arm"}}}
_USAGE = {
    "turn": "turn MOTOR RADIANS: turn the output shaft by hand",
    "hold": "hold MOTOR: hold the shaft (also: a stuck motor)",
    "release": "release MOTOR",
    "leave": "leave MOTOR: the motor stops answering and listening, as if unplugged",
    "return": "return MOTOR: it is back",
    "drop": "drop MOTOR FRACTION: lose this fraction of its frames (0 ends it)",
    "late": "late MOTOR SECONDS: delay its frames (0 ends it)",
    "heat": "heat MOTOR CELSIUS: set its temperature",
    "garbage": "garbage BUS BYTES: put random bytes on the serial line",
    "busoff": "busoff BUS: nothing passes in either direction",
    "recover": "recover BUS: it does again",
    "unplug": "unplug BUS: the adapter disappears",
    "plug": "plug BUS: it is back",
    "rate": "rate MOTOR HZ: feedback frames per second (1000, 500, 250, 125)",
}


class BenchError(ConfigError):
    """A command or a configuration the bench cannot follow; one line with the remedy."""


@dataclass
class Device:
    """A motor with its address and its faults."""

    name: str
    id: int
    motor: Motor
    present: bool = True
    drop: float = 0.0
    late: float = 0.0
    every: int = 1
    hold_until_opened: bool = False
    queue: deque[tuple[float, Frame]] = field(default_factory=deque)

    def __post_init__(self) -> None:
        self.command_id, self.slot = command_slot(self.id)


class Bus:
    """One CAN bus: devices, and two ports: one for the driver, one for an onlooker such as candump."""

    def __init__(self, name: str, directory: str, watch: Callable[[str, Frame], None]) -> None:
        self.name, self.works = name, True
        self.devices: dict[str, Device] = {}
        self.commands: dict[int, Frame] = {}
        self._paths = (f"{directory}/{name}", f"{directory}/{name}.monitor")
        self._watch = watch
        self.ports: list[SlcanPort] = []
        self.plug()

    def plug(self) -> None:
        if not self.ports:
            self.ports = [SlcanPort(path) for path in self._paths]

    def unplug(self) -> None:
        for port in self.ports:
            port.close()
        self.ports = []

    @property
    def opened(self) -> bool:
        return bool(self.ports) and self.ports[0].open

    def listen(self) -> None:
        """Take what the ports' users have sent: to the motors, and to the other ports."""
        for port in self.ports:
            for frame in port.read(self.works):
                self._watch(self.name, frame)
                for other in self.ports:
                    if other is not port:
                        other.send([frame])
                if frame.id in RM_COMMAND_IDS and len(frame.data) == 8:
                    self.commands[frame.id] = frame
                    values = unpack_command(frame.data)
                    for device in self.devices.values():
                        if device.command_id == frame.id and device.present:
                            device.motor.command = values[device.slot]

    def speak(self, frames: list[Frame]) -> None:
        """Send ``frames`` to both ports, if the bus works."""
        if not self.works or not frames:
            return
        for port in self.ports:
            port.send(frames)
        for frame in frames:
            self._watch(self.name, frame)


class Bench:
    """All buses and motors.

    :param config: ``{"motors": {name: {bus, id, type, gear, load, start, ambient}}}``; ``load`` is ``tutorial_arm``, or
        a mapping with inertia, gravity, damping, friction. None: the one motor of rm_controls_tutorials.
    :param directory: where the links to the serial ports are made, ``<bus>`` and ``<bus>.monitor``.
    :param watch: called with (bus, frame) for every frame that passes a bus.
    :param seed: of its random numbers.
    """

    def __init__(
        self,
        config: dict | None = None,
        directory: str = "/tmp/rm_bench",
        seed: int = 0,
        watch: Callable[[str, Frame], None] = lambda bus, frame: None,
    ) -> None:
        self.time = 0.0
        self.ticks = 0
        self.directory = directory
        self.buses: dict[str, Bus] = {}
        self.devices: dict[str, Device] = {}
        self._random = random.Random(seed)
        self._watch = watch
        motors = (config or TUTORIAL).get("motors")
        if not isinstance(motors, dict) or not motors:
            raise BenchError("bench configuration has no motors: write 'motors: {NAME: {bus, id, type}}'")
        for name, entry in motors.items():
            self._add(name, entry)

    def _add(self, name: str, entry: dict) -> None:
        missing = [key for key in ("bus", "id", "type") if key not in entry]
        if missing:
            raise BenchError(f"motor '{name}' has no {' and no '.join(missing)}: bus, id and type are needed")
        if entry["type"] not in SPECS:
            raise BenchError(f"motor '{name}': type '{entry['type']}' is not simulated; known: {', '.join(SPECS)}")
        bus, load = str(entry["bus"]), entry.get("load", {})
        try:
            motor = Motor(
                SPECS[entry["type"]],
                TUTORIAL_ARM if load == "tutorial_arm" else Load(**load),
                entry.get("gear"),
                float(entry.get("start", 0.0)),
                float(entry.get("ambient", 25.0)),
            )
            device = Device(name, int(entry["id"]), motor)
        except (TypeError, ValueError) as error:
            raise BenchError(f"motor '{name}': {error}") from None
        motor.temperature = motor.ambient
        if motor.load.gravity:  # a hand holds the arm until somebody listens, so that its zero is known
            motor.held = device.hold_until_opened = True
        if bus not in self.buses:
            self.buses[bus] = Bus(bus, self.directory, self._watch)
        if any(other.id == device.id for other in self.buses[bus].devices.values()):
            raise BenchError(f"motor '{name}': id 0x{device.id:03X} is used twice on {bus}")
        self.buses[bus].devices[name] = self.devices[name] = device

    def listen(self) -> None:
        """Take frames from all ports."""
        for bus in self.buses.values():
            bus.listen()

    def tick(self) -> None:
        """One millisecond of physics, then the motors' feedback."""
        self.ticks += 1
        self.time += TICK
        for bus in self.buses.values():
            frames = []
            for device in bus.devices.values():
                if device.hold_until_opened and bus.opened:
                    device.hold_until_opened = device.motor.held = False
                device.motor.step(TICK)
                if not device.present or self.ticks % device.every:
                    continue
                if device.drop and self._random.random() < device.drop:
                    continue
                device.queue.append((self.time + device.late, Frame(device.id, pack_feedback(device.motor.feedback()))))
            for device in bus.devices.values():
                while device.queue and device.queue[0][0] <= self.time:
                    frames.append(device.queue.popleft()[1])
            bus.speak(frames)

    def command(self, line: str) -> str:
        """Carry out one line such as ``leave joint1_motor`` and say what was done.

        :raises BenchError: unknown command, motor or bus.
        """
        words = line.split()
        if not words or words[0] not in _USAGE:
            raise BenchError(f"'{line}' is no bench command. " + "; ".join(_USAGE.values()))
        verb, arguments = words[0], words[1:]
        of_bus = verb in ("garbage", "busoff", "recover", "unplug", "plug")
        targets: Mapping[str, object] = self.buses if of_bus else self.devices
        if not arguments or arguments[0] not in targets:
            raise BenchError(f"{verb}: '{' '.join(arguments[:1])}' is not on the bench; there are {', '.join(targets)} ({_USAGE[verb]})")
        needs_number = verb in ("turn", "drop", "late", "heat", "garbage", "rate")
        try:
            number = float(arguments[1]) if needs_number else 0.0
        except (IndexError, ValueError):
            raise BenchError(f"{verb} needs a number: {_USAGE[verb]}") from None
        if of_bus:
            self._bus_fault(verb, self.buses[arguments[0]], int(number))
        else:
            self._device_fault(verb, self.devices[arguments[0]], number)
        return " ".join(words)

    def _bus_fault(self, verb: str, bus: Bus, count: int) -> None:
        if verb == "garbage":
            for port in bus.ports:
                port.send_raw(bytes(self._random.randrange(256) for _ in range(count)))
        elif verb in ("busoff", "recover"):
            bus.works = verb == "recover"
        else:
            getattr(bus, verb)()

    @staticmethod
    def _device_fault(verb: str, device: Device, number: float) -> None:
        motor = device.motor
        if verb == "turn":
            motor.hand += number
        elif verb in ("hold", "release"):
            motor.held, device.hold_until_opened = verb == "hold", False
        elif verb in ("leave", "return"):
            device.present = verb == "return"
            motor.command = 0  # without power there is no current
        elif verb == "drop":
            device.drop = number
        elif verb == "late":
            device.late = number
        elif verb == "heat":
            motor.temperature = number
        elif verb == "rate":
            if number not in (1000.0, 500.0, 250.0, 125.0):
                raise BenchError(f"rate {number:g}: the speed controllers offer 1000, 500, 250 and 125 Hz")
            device.every = int(1000 / number)

    def close(self) -> None:
        """Remove the ports."""
        for bus in self.buses.values():
            bus.unplug()
