"""What controllers and hardware agree on.

*Handles* hold the data of one joint, actuator or sensor as plain float attributes: the hardware writes states and
reads commands, the controller does the opposite, both from the one control loop, so nothing is locked.
*Interfaces* are named collections of handles; taking a handle out of a commanding interface claims its resource.
*RobotHW* is what a robot offers: interfaces, read() and write(), and a say in the switching of controllers.

Units: rad or m, rad/s or m/s, Nm or N.
"""

from .description import description_root
from .errors import ControlError, ResourceError
from .handles import (
    ActuatorHandle,
    ActuatorStateHandle,
    ForceTorqueSensorHandle,
    ImuSensorHandle,
    JointHandle,
    JointMode,
    JointModeHandle,
    JointStateHandle,
    PositionVelocityTorqueGainsJointHandle,
    PosVelAccJointHandle,
    PosVelJointHandle,
    addresses,
)
from .interfaces import (
    ActuatorStateInterface,
    EffortActuatorInterface,
    EffortJointInterface,
    ForceTorqueSensorInterface,
    HardwareInterface,
    ImuSensorInterface,
    JointCommandInterface,
    JointModeInterface,
    JointStateInterface,
    PositionActuatorInterface,
    PositionJointInterface,
    PositionVelocityTorqueGainsJointInterface,
    PosVelAccJointInterface,
    PosVelJointInterface,
    VelocityActuatorInterface,
    VelocityJointInterface,
)
from .robot_hw import ControllerInfo, InterfaceResources, RobotHW, SwitchState

__all__ = [
    "ActuatorHandle",
    "ActuatorStateHandle",
    "ActuatorStateInterface",
    "ControlError",
    "ControllerInfo",
    "EffortActuatorInterface",
    "EffortJointInterface",
    "ForceTorqueSensorHandle",
    "ForceTorqueSensorInterface",
    "HardwareInterface",
    "ImuSensorHandle",
    "ImuSensorInterface",
    "InterfaceResources",
    "JointCommandInterface",
    "JointHandle",
    "JointMode",
    "JointModeHandle",
    "JointModeInterface",
    "JointStateHandle",
    "JointStateInterface",
    "PosVelAccJointHandle",
    "PosVelAccJointInterface",
    "PosVelJointHandle",
    "PosVelJointInterface",
    "PositionActuatorInterface",
    "PositionJointInterface",
    "PositionVelocityTorqueGainsJointHandle",
    "PositionVelocityTorqueGainsJointInterface",
    "ResourceError",
    "RobotHW",
    "SwitchState",
    "VelocityActuatorInterface",
    "VelocityJointInterface",
    "addresses",
    "description_root",
]
