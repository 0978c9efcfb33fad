"""The service ``check_state_validity``."""

from __future__ import annotations

import motion
import rospy
from geometry_msgs.msg import Vector3
from moveit_core import convert
from moveit_msgs.msg import ConstraintEvalResult, ContactInformation, CostSource
from moveit_msgs.srv import GetStateValidity

from ..capability import Capability, serve
from .kinematics import merge_state

_BODIES = {
    "robot_link": ContactInformation.ROBOT_LINK,
    "world": ContactInformation.WORLD_OBJECT,
    "attached": ContactInformation.ROBOT_ATTACHED,
}
_MOST = 100


class StateValidation(Capability):
    """Whether a state is free of collisions and keeps to constraints, and what collides."""

    title = "StateValidationService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("check_state_validity", GetStateValidity, self._check)

    def _check(self, request, response) -> None:
        scene = self.context.monitor.copy()
        state = scene.state
        merge_state(scene, state, request.robot_state)
        if request.group_name:
            self.context.group(request.group_name)
        found = scene.check(state, request.group_name, contacts=_MOST, per_pair=1)
        response.valid = not found.collision
        response.contacts = [contact_message(contact, scene.frame) for contact in found.contacts]
        most = len(scene.objects) + len(self.context.model.links)
        response.cost_sources = [cost_message(source) for source in scene.cost_sources(state, request.group_name, most)]
        limits = convert.constraints(request.constraints, scene)
        if not limits.empty():
            for judged in motion.evaluate(scene, state, limits):
                response.constraint_result.append(ConstraintEvalResult(bool(judged.satisfied), float(judged.distance)))
                response.valid = response.valid and bool(judged.satisfied)


def contact_message(contact, frame: str) -> ContactInformation:
    """A contact as a message; positions are in ``frame``."""
    message = ContactInformation(
        contact_body_1=contact.body_1,
        body_type_1=_BODIES[contact.type_1],
        contact_body_2=contact.body_2,
        body_type_2=_BODIES[contact.type_2],
        depth=float(contact.depth),
    )
    message.header.frame_id, message.header.stamp = frame, rospy.Time.now()
    message.position.x, message.position.y, message.position.z = (float(v) for v in contact.position)
    message.normal.x, message.normal.y, message.normal.z = (float(v) for v in contact.normal)
    return message


def cost_message(source) -> CostSource:
    """A cost source as a message; its box is in the planning frame."""
    return CostSource(float(source.density), Vector3(*map(float, source.low)), Vector3(*map(float, source.high)))
