"""The mathematics: known values, round trips, conservation of power."""
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from transmission_interface import (DifferentialTransmission, FourBarLinkageTransmission, SimpleTransmission,
                                    TransmissionError)

REDUCTION = st.floats(0.01, 1000.0) | st.floats(-1000.0, -0.01)
VALUE = st.floats(-1000.0, 1000.0)


def pairs(element):
    return st.tuples(element, element)


def test_simple_values():
    t = SimpleTransmission(10.0, 1.0)
    assert t.position_to_joint([5.0]) == (1.5,) and t.position_to_actuator([1.5]) == (5.0,)
    assert t.velocity_to_joint([5.0]) == (0.5,) and t.velocity_to_actuator([0.5]) == (5.0,)
    assert t.effort_to_joint([5.0]) == (50.0,) and t.effort_to_actuator([50.0]) == (5.0,)


def test_differential_values():
    t = DifferentialTransmission([10.0, 10.0], [2.0, 4.0], [1.0, -1.0])
    assert t.position_to_joint([10.0, 10.0]) == (1.5, -1.0)     # together: only joint 1
    assert t.position_to_joint([10.0, -10.0]) == (1.0, -0.75)   # against each other: only joint 2
    assert t.effort_to_joint([1.0, 1.0]) == (40.0, 0.0)
    assert t.velocity_to_actuator([1.0, 0.0]) == (20.0, 20.0)


def test_four_bar_values():
    t = FourBarLinkageTransmission([10.0, 10.0], [1.0, 2.0])
    assert t.velocity_to_joint([10.0, 0.0]) == (1.0, -0.5)      # joint 1 takes joint 2 along
    assert t.velocity_to_joint([0.0, 10.0]) == (0.0, 0.5)
    assert t.effort_to_actuator([5.0, 0.0]) == (0.5, 0.5)


TRANSMISSIONS = [
    st.builds(lambda n, o: SimpleTransmission(n[0], o[0]), pairs(REDUCTION), pairs(VALUE)),
    st.builds(DifferentialTransmission, pairs(REDUCTION), pairs(REDUCTION), pairs(VALUE)),
    st.builds(FourBarLinkageTransmission, pairs(REDUCTION), pairs(REDUCTION), pairs(VALUE)),
]


@pytest.mark.parametrize("kind", TRANSMISSIONS)
@given(data=st.data(), values=pairs(VALUE))
def test_there_and_back(kind, data, values):
    t = data.draw(kind)
    values = values[:t.num_joints]
    for quantity in ("position", "velocity", "effort"):
        to_actuator = getattr(t, f"{quantity}_to_actuator")
        to_joint = getattr(t, f"{quantity}_to_joint")
        scale = max(map(abs, to_actuator(values)), default=1.0)
        assume(scale < 1e9)
        assert to_joint(to_actuator(values)) == pytest.approx(values, rel=1e-5, abs=1e-3)


@pytest.mark.parametrize("kind", TRANSMISSIONS[:2])
@given(data=st.data(), velocities=pairs(VALUE), efforts=pairs(VALUE))
def test_no_power_is_lost(kind, data, velocities, efforts):
    t = data.draw(kind)
    joint_v, joint_e = velocities[:t.num_joints], efforts[:t.num_joints]
    motor_v, motor_e = t.velocity_to_actuator(joint_v), t.effort_to_actuator(joint_e)
    power = sum(v * e for v, e in zip(joint_v, joint_e))
    assert sum(v * e for v, e in zip(motor_v, motor_e)) == pytest.approx(power, rel=1e-6, abs=1e-2)


@pytest.mark.parametrize("make", [
    lambda: SimpleTransmission(0.0), lambda: DifferentialTransmission([1.0, 0.0]),
    lambda: FourBarLinkageTransmission([1.0, 1.0], [0.0, 1.0])])
def test_zero_reduction_is_refused(make):
    with pytest.raises(TransmissionError, match="reduction of 0"):
        make()


def test_wrong_count_is_refused():
    with pytest.raises(TransmissionError, match="two numbers"):
        DifferentialTransmission([1.0])
