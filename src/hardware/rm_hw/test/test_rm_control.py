"""What compiled controllers of rm_common's interfaces see of the motors, and what they write comes back."""

from hardware_interface import ActuatorStateHandle, ActuatorStateInterface
from hardware_interface.compiled import CompiledRobotHW, twin
from rm_hw.actuator import Actuator
from rm_hw.coefficients import Coefficients
from rm_hw.config import ImuConfig
from rm_hw.hardware import RmRobotHW, package_coefficients
from rm_hw.imu import Imu


def robot():
    coefficients = Coefficients.from_params("rm_3508", package_coefficients()["rm_3508"])
    hardware = RmRobotHW()
    states = ActuatorStateInterface()
    for name, calibrate in (("arm", True), ("wheel", False)):
        state = ActuatorStateHandle(name)
        states.register_handle(state)
        actuator = Actuator(name, "rm_3508", "can0", 0x201, coefficients, need_calibration=calibrate)
        hardware._actuators.append((actuator, state, None))
    hardware.register_interface(states)
    hardware._imus["base_imu"] = Imu(ImuConfig("base_imu", "can0", 0x301, "base_link"))
    return hardware


def test_the_interfaces_have_the_names_that_controllers_ask_for():
    names = CompiledRobotHW(twin(robot())).interface_names()
    assert names == [
        "hardware_interface::ActuatorStateInterface",
        "rm_control::ActuatorExtraInterface",
        "rm_control::GpioCommandInterface",
        "rm_control::GpioStateInterface",
        "rm_control::RmImuSensorInterface",
        "rm_control::RobotStateInterface",
    ]


def test_motors_both_ways():
    hardware = robot()
    twin(hardware)
    part, (arm, wheel) = hardware._part, [actuator for actuator, _, _ in hardware._actuators]
    seen = {actuator.name: motor for actuator, motor in part._motors}
    assert (seen["arm"].need_calibration, seen["wheel"].need_calibration) == (True, False)
    arm.halted, arm.position, arm.calibration_reading = False, 1.5, True
    part.show()
    assert (seen["arm"].halted, seen["arm"].position, seen["arm"].calibration_reading, seen["wheel"].halted) == (False, 1.5, True, True)
    seen["arm"].offset, seen["arm"].calibrated = -1.5, True
    part.take()
    assert (arm.offset, arm.calibrated, wheel.offset) == (-1.5, True, 0.0)
