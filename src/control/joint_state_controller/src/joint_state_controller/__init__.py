"""Publishes the state of all joints of a robot on joint_states."""

from .controller import JointStateController

__all__ = ["JointStateController"]
