"""State and properties of models and links."""

from __future__ import annotations

from collections import Counter
from typing import Any

import rospy
from gazebo_msgs.msg import LinkState, ModelState
from gazebo_msgs.srv import (
    DeleteModel,
    GetLinkProperties,
    GetLinkState,
    GetModelProperties,
    GetModelState,
    GetModelStateResponse,
    GetWorldProperties,
    SetLinkProperties,
    SetLinkState,
    SetModelConfiguration,
    SetModelState,
)
from geometry_msgs.msg import Point, Quaternion
from geometry_msgs.msg import Pose as PoseMsg
from ode_sim import LinkHandle, math3
from ode_sim.description.model import Inertial, Pose

from gazebo_ros.api.geometry import entity_twist, frame_entity, pose_msg, pose_of, twist_msg, vector_of
from gazebo_ros.api.handlers import Refused, advertise, finite, listing, worded
from gazebo_ros.server import Server, Stopped


class _NumberedState(GetModelStateResponse):
    _has_header = False  # rospy would number the answers about all models together


class _GetNumberedState(GetModelState):
    _response_class = _NumberedState


class ModelServices:
    def __init__(self, server: Server):
        self._server = server
        self._world = server.world
        self._state_calls: Counter = Counter()  # get_model_state numbers its answers per model
        for name, service, f in (
            ("delete_model", DeleteModel, self._delete_model),
            ("get_model_properties", GetModelProperties, self._get_model_properties),
            ("get_model_state", _GetNumberedState, self._get_model_state),
            ("get_world_properties", GetWorldProperties, self._get_world_properties),
            ("get_link_properties", GetLinkProperties, self._get_link_properties),
            ("get_link_state", GetLinkState, self._get_link_state),
            ("set_link_properties", SetLinkProperties, self._set_link_properties),
            ("set_model_state", SetModelState, lambda request, _: self._set_model_state(request.model_state)),
            ("set_link_state", SetLinkState, lambda request, _: self._set_link_state(request.link_state)),
            ("set_model_configuration", SetModelConfiguration, self._set_model_configuration),
        ):
            advertise(server, name, service, f)
        rospy.Subscriber("~set_model_state", ModelState, self._on_message, (self._set_model_state, "set_model_state"), queue_size=10)
        rospy.Subscriber("~set_link_state", LinkState, self._on_message, (self._set_link_state, "set_link_state"), queue_size=10)

    def _on_message(self, message: Any, how: tuple) -> None:
        f, topic = how
        try:
            self._server.call(lambda: f(message))
        except ValueError as error:
            rospy.logwarn_throttle_identical(1.0, "message on ~%s: %s" % (topic, error))
        except Stopped:
            return

    # ------------------------------------------------------------------------------------------ look-up

    def _model(self, name: str):
        entity = self._world.models.get(name)
        if entity is None:
            raise worded("model does not exist", f"[{name}] is none of: {listing(self._world.models)}")
        return entity

    def _link(self, name: str, gazebo: str = "link not found, did you forget to scope the link by model name?"):
        link = self._world.find_link(name)
        if link is None:
            raise worded(gazebo, f"[{name}] names none; write model::link, as in the topic link_states")
        return link

    # ------------------------------------------------------------------------------------------ models

    def _delete_model(self, request, response) -> str:
        self._model(request.model_name)
        self._server.remove(request.model_name)
        return "DeleteModel: successfully deleted model"

    def _get_model_properties(self, request, response) -> str:
        model = self._model(request.model_name)
        response.body_names = list(model.links)
        response.geom_names = [name for link in model.links.values() for name in link.collisions]
        response.joint_names = list(model.joints)
        response.is_static = model.static
        return "GetModelProperties: got properties"

    def _get_model_state(self, request, response) -> str:
        model = self._model(request.model_name)
        self._state_calls[request.model_name] += 1
        response.header.seq = self._state_calls[request.model_name]
        response.header.stamp = rospy.Time.now()
        response.header.frame_id = request.relative_entity_name
        frame = frame_entity(
            self._world,
            request.relative_entity_name,
            "reference relative_entity_name not found, did you forget to scope the body by model name?",
        )
        response.pose, response.twist = _relative_state(model, frame)
        return "GetModelState: got properties"

    def _set_model_state(self, state) -> str:
        model = self._model(state.model_name)
        frame = frame_entity(self._world, state.reference_frame, "specified reference frame entity does not exist")
        pose = pose_of(state.pose)
        linear, angular = vector_of(state.twist.linear, "twist"), vector_of(state.twist.angular, "twist")
        if frame is not None:
            x_wf = frame.pose
            pose = math3.compose(x_wf, pose)
            linear, angular = math3.rotate(x_wf, linear), math3.rotate(x_wf, angular)
        model.pose = pose
        model.set_twist(linear, angular)
        return "SetModelState: set model state done"

    def _set_model_configuration(self, request, response) -> str:
        model = self._model(request.model_name)
        if len(request.joint_names) != len(request.joint_positions):
            raise worded(
                "joint name and position list have different lengths",
                f"{len(request.joint_names)} joint_names, {len(request.joint_positions)} joint_positions",
            )
        finite("joint_positions", *request.joint_positions)
        joints = {alias: joint for joint in model.joints.values() for alias in (joint.name, joint.scoped_name)}
        for name, position in zip(request.joint_names, request.joint_positions):
            if name in joints and joints[name].axis_count:
                joints[name].set_position(position)
        return "SetModelConfiguration: success"

    def _get_world_properties(self, request, response) -> str:
        response.sim_time = self._world.time
        response.model_names = list(self._world.models)
        response.rendering_enabled = True
        return "GetWorldProperties: got properties"

    # ------------------------------------------------------------------------------------------ links

    def _get_link_state(self, request, response) -> str:
        link = self._link(request.link_name)
        frame = frame_entity(
            self._world, request.reference_frame, "reference reference_frame not found, did you forget to scope the link by model name?"
        )
        state = response.link_state
        state.link_name, state.reference_frame = request.link_name, request.reference_frame
        state.pose, state.twist = _relative_state(link, frame)
        return "GetLinkState: got state"

    def _set_link_state(self, state) -> str:
        link = self._link(state.link_name, "link does not exist")
        frame = frame_entity(self._world, state.reference_frame, "failed")
        if frame is not None and not isinstance(frame, LinkHandle):
            raise worded("failed", f"reference_frame [{state.reference_frame}] is no link; name one as model::link")
        pose = pose_of(state.pose)
        linear, angular = vector_of(state.twist.linear, "twist"), vector_of(state.twist.angular, "twist")
        if frame is not None:  # velocities as Gazebo takes them: relative, but in world axes
            pose = math3.compose(frame.pose, pose)
            linear = math3.sub(linear, frame.linear_velocity())
            angular = math3.sub(angular, frame.angular_velocity())
        link.pose = pose
        link.set_twist(linear, angular)
        return "SetLinkState: success"

    def _get_link_properties(self, request, response) -> str:
        link = self._link(request.link_name)
        p_LC = math3.transform(math3.inverse(link.pose), link.com())
        response.com = PoseMsg(Point(*p_LC), Quaternion(0, 0, 0, 1))
        response.gravity_mode = link.gravity
        response.mass = link.mass
        (response.ixx, response.iyy, response.izz, response.ixy, response.ixz, response.iyz) = link.inertia
        return "GetLinkProperties: got properties"

    def _set_link_properties(self, request, response) -> str:
        link = self._link(request.link_name)
        r = request
        finite("the request", r.mass, r.ixx, r.ixy, r.ixz, r.iyy, r.iyz, r.izz)
        if not r.mass > 0.0:
            raise Refused(f"mass {r.mass:g} kg; it must be positive")
        if not (r.ixx > 0.0 and r.iyy > 0.0 and r.izz > 0.0):
            raise Refused(f"moments of inertia {r.ixx:g} {r.iyy:g} {r.izz:g} kg m^2; they must be positive")
        com = pose_of(r.com, "com")
        link.set_inertial(Inertial(r.mass, Pose(com.p), r.ixx, r.ixy, r.ixz, r.iyy, r.iyz, r.izz))
        link.gravity = r.gravity_mode
        return "SetLinkProperties: properties set"


def _relative_state(entity: Any, frame: Any) -> tuple[PoseMsg, Any]:
    """Pose and twist of ``entity`` in ``frame`` (None = world); the frame's rotation adds no velocity, as in Gazebo."""
    pose = entity.pose
    linear, angular = entity_twist(entity)
    if frame is not None:
        x_wf = frame.pose
        frame_linear, frame_angular = entity_twist(frame)
        pose = math3.relative(x_wf, pose)
        back = math3.quat_inverse(x_wf.q)
        linear = math3.quat_rotate(back, math3.sub(linear, frame_linear))
        angular = math3.quat_rotate(back, math3.sub(angular, frame_angular))
    return pose_msg(pose), twist_msg(linear, angular)
