"""Identification against motors whose constants are known, through feedback frames as they come over the bus."""

import can
import numpy as np
import pytest
from rm_hw.bench.motor import SPECS, Load, Motor
from rm_hw.frames import pack_feedback
from rm_hw.identify import fit, main, predict, read_log


def record(path, type_name, amplitude, seconds=10.0, late=0.0):
    """A log of a motor with a flywheel; returns its inertia at the rotor. Frames come up to ``late`` s late, in bursts."""
    motor, arrivals = Motor(SPECS[type_name], Load(inertia=0.01)), np.arange(int(seconds * 1000)) * 0.001
    for begin in np.random.default_rng(0).uniform(0.0, seconds, int(3 * seconds)):
        arrivals = np.where((arrivals > begin) & (arrivals < begin + late), begin + late, arrivals)
    with can.Logger(str(path)) as logger:
        for k in range(int(seconds * 1000)):
            t = k * 0.001
            motor.command = int(amplitude * (np.sin(2.5 * t) + 0.4 * np.sin(14.5 * t)) / 1.4)
            motor.step(0.001)
            logger.on_message_received(
                can.Message(timestamp=100.0 + arrivals[k], arbitration_id=0x201, data=pack_feedback(motor.feedback()), is_extended_id=False)
            )
    return SPECS[type_name].inertia + 0.01 / motor.gear**2


@pytest.mark.parametrize("type_name, amplitude, late", [("rm_3508", 2500, 0.0), ("rm_3508", 2500, 0.1), ("rm_2006", 2500, 0.0)])
def test_constants_are_found(tmp_path, type_name, amplitude, late):
    path, spec = tmp_path / "run.log", SPECS[type_name]
    inertia = record(path, type_name, amplitude, late=late)
    samples = read_log(str(path), 0x201, type_name)
    found = fit(*samples, inertia)
    assert found.torque_constant == pytest.approx(spec.torque_constant, rel=0.02)
    assert found.coulomb == pytest.approx(spec.coulomb, rel=0.05)
    assert found.viscous == pytest.approx(spec.viscous, rel=0.15)
    assert found.residual < 0.05
    predicted = predict(*samples, inertia, found)
    assert np.abs(predicted - samples[1]).mean() < 0.05 * np.ptp(samples[1])


def test_command_line_writes_a_picture(tmp_path, capsys):
    inertia = record(tmp_path / "run.log", "rm_3508", 2500, seconds=4.0)
    assert main(["fit", "--log", str(tmp_path / "run.log"), "--inertia", str(inertia), "--plot", str(tmp_path / "x.png")]) == 0
    assert "torque constant" in capsys.readouterr().out and (tmp_path / "x.png").stat().st_size > 1000


def test_a_motor_that_stands_still_is_named(tmp_path, capsys):
    record(tmp_path / "run.log", "rm_3508", 100, seconds=2.0)
    assert main(["fit", "--log", str(tmp_path / "run.log"), "--inertia", "1e-5"]) == 1
    assert "hardly moves" in capsys.readouterr().err
    assert main(["fit", "--log", str(tmp_path / "run.log"), "--inertia", "1e-5", "--id", "0x202"]) == 1
    assert "0 frames of id 0x202" in capsys.readouterr().err
