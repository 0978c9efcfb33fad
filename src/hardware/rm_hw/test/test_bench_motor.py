"""The simulated motors against figures that can be worked out by hand."""

import math

import pytest
from rm_hw.bench.motor import SPECS, TUTORIAL_ARM, Load, Motor

MS = 0.001


def run(motor, seconds):
    for _ in range(round(seconds / MS)):
        motor.step(MS)
    return motor


def test_no_load_figures_of_the_data_sheets():
    for name, rpm, amperes in (("rm_3508", 482, 0.78), ("rm_2006", 500, 0.6), ("rm_6020", 320, None)):
        spec = SPECS[name]
        motor = run(Motor(spec, command=spec.max_counts), 3.0)
        assert motor.output_speed * 30 / math.pi == pytest.approx(rpm, rel=0.05), name
        if amperes:
            assert motor.current == pytest.approx(amperes, rel=0.2), name


def test_acceleration_is_torque_over_inertia():
    spec, load = SPECS["rm_3508"], Load(inertia=0.5)
    motor = Motor(spec, load, command=8192)  # 10 A, 3 Nm at the output
    run(motor, 0.05)
    before = motor.output_speed
    run(motor, 0.02)
    inertia = 0.5 + spec.inertia * motor.gear**2
    torque = 10 * 0.3 - spec.coulomb * motor.gear - spec.viscous * motor.gear**2 * before
    assert (motor.output_speed - before) / 0.02 == pytest.approx(torque / inertia, rel=0.01)


def test_dry_friction_holds_exactly():
    spec = SPECS["rm_3508"]
    below = spec.coulomb / spec.torque_constant * spec.counts_per_unit
    assert run(Motor(spec, command=int(0.95 * below)), 1.0).angle == 0.0
    assert run(Motor(spec, command=int(1.05 * below)), 1.0).speed > 1.0


def test_arm_swings_down_and_settles_hanging():
    arm = run(Motor(SPECS["rm_3508"], TUTORIAL_ARM, gear=19.2032), 6.0)
    assert arm.speed == 0.0
    stiction = (arm.spec.coulomb * arm.gear + TUTORIAL_ARM.friction) / TUTORIAL_ARM.gravity
    assert abs(arm.output_angle - math.pi / 2) <= math.asin(stiction) + 1e-6


def test_energy_of_a_frictionless_arm_is_kept():
    from dataclasses import replace

    spec = replace(SPECS["rm_3508"], coulomb=0.0, viscous=0.0)
    load = Load(inertia=TUTORIAL_ARM.inertia, gravity=TUTORIAL_ARM.gravity)
    arm = Motor(spec, load, gear=19.2032)
    inertia = load.inertia + spec.inertia * arm.gear**2

    def energy():
        return inertia * arm.output_speed**2 / 2 - load.gravity * math.sin(arm.output_angle)

    energies = []
    for _ in range(3000):
        arm.step(MS)
        energies.append(energy())
    assert max(map(abs, energies)) < 0.01 * load.gravity


def test_hand_turns_by_the_angle_asked_for():
    motor = Motor(SPECS["rm_3508"], gear=19.2032)
    motor.hand = -0.7
    run(motor, 1.0)
    assert motor.output_angle == pytest.approx(-0.7) and motor.speed == 0.0


def test_stuck_motor_reports_current_but_no_speed():
    motor = run(Motor(SPECS["rm_3508"], command=4096, held=True), 0.1)
    assert motor.feedback().rpm == 0
    assert motor.feedback().current == pytest.approx(4096, abs=2)


def test_heat_follows_the_square_of_the_current():
    rises = [run(Motor(SPECS["rm_3508"], command=counts, held=True), 1.0).temperature - 25.0 for counts in (4000, 8000)]
    assert rises[1] / rises[0] == pytest.approx(4.0, rel=0.02)


def test_feedback_wraps_the_encoder():
    motor = Motor(SPECS["rm_3508"])
    motor.angle = -0.001
    assert motor.feedback().angle == 8190
    motor.angle = 2 * math.pi * 5.5 + 1e-6
    assert motor.feedback().angle == 4096


def test_a_gear_of_zero_is_refused():
    with pytest.raises(ValueError, match="19.2032"):
        Motor(SPECS["rm_3508"], gear=0.0)
