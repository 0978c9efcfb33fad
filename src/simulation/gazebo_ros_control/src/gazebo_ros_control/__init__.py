"""ros_control in the simulator.

``plugin``
    The model plugin ``libgazebo_ros_control.so``: a controller manager in the robot's namespace, stepped by the world.
``robot_hw_sim``
    Base class of simulated robot hardware. A package replaces the default by exporting a class of its own, whose name
    goes into ``<robotSimType>``::

        <export><gazebo_ros_control plugin="${prefix}/robot_sims.xml"/></export>

        <library path="src"><class name="my_pkg/MyRobotSim" type="my_pkg.sim.MyRobotSim"
                                   base_class_type="gazebo_ros_control::RobotHWSim"/></library>
``default_robot_hw_sim``
    Position, velocity and effort commands, with and without PID gains, joint limits, emergency stop.
"""

from .robot_hw_sim import RobotHWSim

__all__ = ["RobotHWSim"]
