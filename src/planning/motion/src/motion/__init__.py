"""Motion planning without ROS: robots, scenes, kinematics, planning, timing. See the package's README."""

from motion._core import (
    AllowedCollisionMatrix,
    AttachedBody,
    Box,
    CancelToken,
    CollisionResult,
    Cone,
    ConstraintResult,
    Constraints,
    Contact,
    Cylinder,
    DistanceResult,
    EndEffectorInfo,
    Group,
    InvalidInputError,
    JointConstraint,
    JointInfo,
    LinkInfo,
    Mesh,
    ModelError,
    MotionError,
    OccupancyMap,
    OcTree,
    OrientationConstraint,
    Plane,
    PlanningScene,
    PositionConstraint,
    RobotModel,
    RobotState,
    Shape,
    Sphere,
    UnknownNameError,
    VariableLimits,
    VirtualJointInfo,
    VisibilityConstraint,
    WorldObject,
    evaluate,
    label_points,
    planners,
)
from motion.cartesian import CartesianResult, cartesian_path, explain, is_valid, path_valid
from motion.files import find_package, load_mesh
from motion.kinematics import IkResult, ik
from motion.model import load_model
from motion.pilz import CartesianLimits, pilz_plan
from motion.pilz_sequence import SequenceResult, pilz_sequence
from motion.pipeline import Pipeline
from motion.planning import CODES, AuxiliaryPoint, MotionRequest, PlanResult, joint_goal, named_goal, plan, planner_problem, pose_goal
from motion.pose import Pose
from motion.timing import limit_cartesian_speed, limit_jerk, time_parameterize, timing_methods
from motion.trajectory import Trajectory

# What is written in Python reads as methods too.
PlanningScene.explain = explain
PlanningScene.is_valid = is_valid
PlanningScene.path_valid = path_valid
Mesh.load = staticmethod(load_mesh)
