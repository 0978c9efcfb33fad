"""What can go wrong in the control stack: one tree, each error one line for a student.

::

    ControlError
    ├── ResourceError          hardware_interface: a joint, actuator or sensor is not there
    ├── DescriptionError       joint_limits_interface: the robot description cannot be used
    ├── JointLimitsError       joint_limits_interface: a handle needs limits that the joint does not have
    ├── TransmissionError      transmission_interface: a transmission cannot be made
    ├── InitError              controller_interface: a controller cannot be initialised
    ├── SwitchRefused          controller_manager: the switch cannot be done as asked
    └── InvalidTrajectory      joint_trajectory_controller: .code is that of FollowJointTrajectoryResult
        └── Late               all of it lies in the past

    ParameterError             node_signals.parameters, of all wings: missing, of the wrong kind or out of its range
    ├── PidParameterError      control_toolbox: the gains in a namespace
    ├── GeometryError          urdf_geometry_parser: robot_description does not say what was asked
    └── ConfigError            rm_hw: names the parameter and what to write instead
        └── BenchError         rm_hw.bench: a command or a configuration that the bench cannot follow

A class that cannot be loaded is plugin_loader's ``PluginError``.
"""


class ControlError(Exception):
    """The root; the text is the whole line."""


class ResourceError(ControlError):
    """A joint, actuator or sensor is not there; the line says which interface was asked and what it has."""
