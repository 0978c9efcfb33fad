"""Transmissions between actuators and joints.

A robot driver whose hardware speaks actuator coordinates::

    hw.register_interface(ActuatorStateInterface(...)); hw.register_interface(EffortActuatorInterface(...))
    transmissions = RobotTransmissions()
    TransmissionInterfaceLoader(hw, transmissions).load(urdf)     # adds the joint interfaces to hw
    ...
    transmissions.actuator_to_joint_state.propagate()             # after reading
    transmissions.joint_to_actuator_effort.propagate()            # before writing

A type of one's own is a class with the methods of ``Transmission``, exported for ``transmission_interface``.
"""

from .loader import RobotTransmissions, TransmissionInterfaceLoader
from .parser import ActuatorInfo, JointInfo, TransmissionInfo, parse_transmissions
from .pipelines import TransmissionPipeline
from .transmissions import DifferentialTransmission, FourBarLinkageTransmission, SimpleTransmission, Transmission, TransmissionError

__all__ = [
    "ActuatorInfo",
    "DifferentialTransmission",
    "FourBarLinkageTransmission",
    "JointInfo",
    "RobotTransmissions",
    "SimpleTransmission",
    "Transmission",
    "TransmissionError",
    "TransmissionInfo",
    "TransmissionInterfaceLoader",
    "TransmissionPipeline",
    "parse_transmissions",
]
