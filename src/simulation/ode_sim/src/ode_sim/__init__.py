"""Robot simulation without ROS: descriptions, physics, sensors, rendering.

    world = ode_sim.World.load("arm.world")
    arm = world.spawn_urdf(text, name="arm")
    world.step(1000)
"""
from pkgutil import extend_path

__path__ = extend_path(__path__, __name__)  # the compiled core lies in the devel space, whichever path comes first

from ode_sim.collision_meshes import prepare
from ode_sim.description.model import DescriptionError, Pose, Problem
from ode_sim.handles import Attachment, CollisionHandle, JointFeedback, JointHandle, LinkHandle, ModelHandle, Twist
from ode_sim.world import Snapshot, World

__all__ = ["Attachment", "CollisionHandle", "DescriptionError", "JointFeedback", "JointHandle", "LinkHandle", "ModelHandle", "Pose",
           "Problem", "Snapshot", "Twist", "World", "prepare"]
