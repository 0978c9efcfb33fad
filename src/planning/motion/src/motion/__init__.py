"""Motion planning without ROS: robots, scenes, kinematics, planning, timing. See the package's README."""
from motion._core import (
    AllowedCollisionMatrix, AttachedBody, Box, CollisionResult, Cone, ConstraintResult, Constraints, Contact, Cylinder,
    DistanceResult, EndEffectorInfo, Group, InvalidInputError, JointConstraint, JointInfo, LinkInfo, Mesh, ModelError,
    MotionError, OcTree, OrientationConstraint, Plane, PlanningScene, PositionConstraint, RobotModel, RobotState, Shape,
    Sphere, UnknownNameError, VariableLimits, VirtualJointInfo, VisibilityConstraint, WorldObject, evaluate)
from motion.files import find_package
from motion.kinematics import IkResult, ik
from motion.model import load_model
from motion.pose import Pose
