"""One robot out of several.

Each part is a RobotHW class that its package exports::

    <export><hardware_interface plugin="${prefix}/robot_hw.xml"/></export>

    <library path="src"><class name="my_pkg/LeftArm" type="my_pkg.arms.LeftArm"
                               base_class_type="hardware_interface::RobotHW"/></library>
"""

from .combined_robot_hw import CombinedRobotHW

__all__ = ["CombinedRobotHW"]
