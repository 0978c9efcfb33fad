"""Force feedback, against the kernel's own header and a device that writes down what it is told."""

import os
import shutil
import subprocess

import pytest
from joystick import rumble
from joystick.rumble import EFFECT, EVIOCGBIT_FF, EVIOCSFF, INPUT, Rumble, event_device

PROGRAM = """
#include <linux/input.h>
#include <stddef.h>
#include <stdio.h>
int main() {
  printf("%zu %zu %zu %zu %zu %lu %lu %zu %d %d %d\\n", sizeof(struct ff_effect), offsetof(struct ff_effect, id),
         offsetof(struct ff_effect, replay.length), offsetof(struct ff_effect, u.rumble.strong_magnitude),
         offsetof(struct ff_effect, u.rumble.weak_magnitude), (unsigned long)EVIOCSFF, (unsigned long)EVIOCGBIT(EV_FF, 16),
         sizeof(struct input_event), FF_RUMBLE, EV_FF, FF_GAIN);
}
"""


@pytest.mark.skipif(shutil.which("gcc") is None, reason="no compiler")
def test_structures_are_those_of_the_kernel(tmp_path):
    (tmp_path / "a.c").write_text(PROGRAM)
    subprocess.run(["gcc", "-o", tmp_path / "a", tmp_path / "a.c"], check=True)
    said = [int(word) for word in subprocess.run([tmp_path / "a"], capture_output=True, text=True).stdout.split()]
    packed = EFFECT.pack(1, 2, 3, 4, 5, 6, 7, 8, 9)
    places = [packed.index(bytes([mark, 0])) for mark in (2, 6, 8, 9)]
    assert [EFFECT.size, *places, EVIOCSFF, EVIOCGBIT_FF, INPUT.size, rumble.FF_RUMBLE, rumble.EV_FF, rumble.FF_GAIN] == said


class Device:
    """What a driver does: gives the effect a number; a pipe holds the events."""

    def __init__(self, able=True):
        self.read, self.write = os.pipe()
        self.able, self.effects = able, []

    def control(self, descriptor, request, data):
        assert descriptor == self.write
        if request == EVIOCGBIT_FF:
            data[10] = 1 if self.able else 0
            return
        assert request == EVIOCSFF
        kind, number, _, _, _, length, _, heavy, light = EFFECT.unpack(data)
        assert (kind, length) == (0x50, 1000)
        self.effects.append((number, heavy, light))
        data[2:4] = (3).to_bytes(2, "little")

    def events(self):
        """Code and value of each since the last call."""
        os.set_blocking(self.read, False)
        try:
            data = os.read(self.read, 1000)
        except BlockingIOError:
            return []
        return [INPUT.unpack_from(data, at)[3:] for at in range(0, len(data), INPUT.size)]


def test_motors_turn_until_they_are_told_to_stop():
    device = Device()
    motors = Rumble(device.write, device.control)
    assert device.events() == [(0x60, 0xFFFF)]  # the gain
    motors.play(1.0)
    assert device.events() == [] and device.effects == []
    motors.set(0, 0.5)
    motors.set(1, 7.0)
    motors.play(2.0)
    assert device.effects == [(-1, 0x7FFF, 0xFFFF)] and device.events() == [(3, 1)]
    motors.play(2.5)
    assert device.events() == []
    motors.play(2.95)  # an effect lasts for a second
    assert device.events() == [(3, 1)] and len(device.effects) == 1
    for motor in (0, 1):
        motors.set(motor, 0.0)
    motors.set(1, float("nan"))
    motors.play(3.0)
    assert device.effects[1:] == [(3, 0, 0)] and device.events() == [(3, 1)]
    motors.play(9.0)
    assert device.events() == []


def test_a_device_without_motors_is_refused():
    device = Device(able=False)
    with pytest.raises(OSError, match="no motors"):
        Rumble(device.write, device.control)
    assert device.events() == []


def test_the_event_device_of_a_joystick(tmp_path):
    by_id = tmp_path / "by-id"
    by_id.mkdir()
    for name in ("js0", "js1", "event5", "event6"):
        (tmp_path / name).touch()
    for name, target in (("usb-A-joystick", "js0"), ("usb-B-joystick", "js1"), ("usb-B-event-joystick", "event6")):
        (by_id / name).symlink_to(tmp_path / target)
    assert event_device(str(tmp_path / "js1"), str(by_id)) == str(by_id / "usb-B-event-joystick")
    assert event_device(str(tmp_path / "js0"), str(by_id)) is None
    assert event_device(str(tmp_path / "js9"), str(by_id)) is None
