"""The node ``gazebo`` as a simulation for the page: one stream of poses, services for what is asked and done."""

from __future__ import annotations

import threading
import time
from dataclasses import replace
from typing import Any

import numpy as np
import rospy
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import (
    ApplyBodyWrench,
    DeleteLight,
    DeleteModel,
    GetLinkProperties,
    GetPhysicsProperties,
    SetLightProperties,
    SetLinkProperties,
    SetModelState,
    SetPhysicsProperties,
    SpawnModel,
)
from gazebo_ros.finding import make_finder
from gazebo_ros.msg import WorldContacts, WorldView
from gazebo_ros.srv import (
    CollisionSurface,
    CommandJoint,
    CommandJointRequest,
    DescribeWorld,
    SaveWorld,
    SetVisual,
    StepWorld,
    Timeline,
    TimelineRequest,
)
from geometry_msgs.msg import Point, Quaternion, Twist, Vector3, Wrench
from geometry_msgs.msg import Pose as PoseMsg
from ode_sim.description import model as d
from ode_sim.description.exchange import dumps, loads
from ode_sim.description.sdf_writer import light_text
from ode_sim_viewer.simulation import Frame, KeptMoment, LinkProperties, Looks, Refused, Simulation, SurfaceProperties, WorldRecord
from std_msgs.msg import ColorRGBA
from std_srvs.srv import Empty

_PATIENCE = 5.0  # wall s that a service may take to be there
_STALE = 3.0  # wall s without a frame: the simulator has gone
_JOINT_MODES = {
    "none": CommandJointRequest.NONE,
    "force": CommandJointRequest.FORCE,
    "position": CommandJointRequest.POSITION,
    "velocity": CommandJointRequest.VELOCITY,
}


class RosSimulation(Simulation):
    """:param namespace: of the simulator's node."""

    def __init__(self, namespace: str = "/gazebo"):
        self._namespace = namespace.rstrip("/")
        self._subscriber: rospy.Subscriber | None = None
        self._lock = threading.Lock()
        self._frame: Frame | None = None
        self._at = 0.0
        self._known: WorldRecord | None = None
        self._contact_stream: rospy.Subscriber | None = None
        self._contacts = np.zeros((0, 6), np.float32)
        self._prompt: dict[str, tuple[Any, threading.Lock]] = {}  # connections that are kept open

    # ------------------------------------------------------------------------------------------ what there is

    def look(self, on: bool) -> None:
        with self._lock:
            if on and self._subscriber is None:
                self._subscriber = rospy.Subscriber(
                    f"{self._namespace}/view", WorldView, self._take, queue_size=1, buff_size=1 << 22, tcp_nodelay=True
                )
            elif not on and self._subscriber is not None:
                self._subscriber.unregister()
                self._subscriber = None

    def watch_contacts(self, on: bool) -> None:
        with self._lock:
            if on and self._contact_stream is None:
                self._contact_stream = rospy.Subscriber(
                    f"{self._namespace}/view_contacts", WorldContacts, self._take_contacts, queue_size=1, tcp_nodelay=True
                )
            elif not on and self._contact_stream is not None:
                self._contact_stream.unregister()
                self._contact_stream, self._contacts = None, np.zeros((0, 6), np.float32)

    def contacts(self) -> np.ndarray:
        return self._contacts

    def close(self) -> None:
        self.look(False)
        self.watch_contacts(False)

    def frame(self) -> Frame | None:
        return self._frame if time.monotonic() - self._at < _STALE else None

    def describe(self) -> WorldRecord:
        response = self._call("describe_world", DescribeWorld)
        try:
            self._known = loads(response.world)
        except ValueError as error:
            raise Refused(f"the simulator describes its world in an unknown way: {error}") from error
        return self._known

    def model_names(self) -> dict[str, str]:
        return self.finder().models()

    def finder(self) -> Any:
        import rospkg

        return make_finder(rospkg.RosPack())

    def _take(self, message: WorldView) -> None:
        self._frame = Frame(
            message.revision,
            message.sim_time.to_sec(),
            message.real_time,
            message.iterations,
            message.paused,
            message.real_time_factor,
            np.frombuffer(message.poses, "<f4").reshape(-1, 7),
            np.frombuffer(message.joints, "<f4"),
        )
        self._at = time.monotonic()

    def _take_contacts(self, message: WorldContacts) -> None:
        self._contacts = np.frombuffer(message.contacts, "<f4").reshape(-1, 6)

    def _soon(self, name: str, service: type, *arguments: Any) -> Any:
        """As :meth:`_call` on a connection that is kept, for what a hand does many times a second and may do twice."""
        full = f"{self._namespace}/{name}"
        with self._lock:
            if name not in self._prompt:
                self._prompt[name] = (rospy.ServiceProxy(full, service, persistent=True), threading.Lock())
        proxy, lock = self._prompt[name]
        try:
            with lock:
                response = proxy(*arguments)
        except (rospy.ROSException, rospy.ServiceException, OSError):  # the server is another one by now
            with self._lock:
                self._prompt.pop(name, None)
            proxy.close()
            return self._call(name, service, *arguments)
        if not response.success:
            raise Refused(response.status_message)
        return response

    def _call(self, name: str, service: type, *arguments: Any, **named: Any) -> Any:
        """The answer of a service of the simulator.

        :raises Refused: it does not answer, or says no
        """
        full = f"{self._namespace}/{name}"
        try:
            rospy.wait_for_service(full, _PATIENCE)
            response = rospy.ServiceProxy(full, service)(*arguments, **named)
        except (rospy.ROSException, rospy.ServiceException, TypeError, ValueError) as error:
            raise Refused(f"{full}: {error}") from error
        if not getattr(response, "success", True):
            raise Refused(response.status_message)
        return response

    # ------------------------------------------------------------------------------------------ time

    def pause(self, on: bool) -> None:
        self._call("pause_physics" if on else "unpause_physics", Empty)

    def step(self, count: int) -> None:
        frame = self.frame()
        if frame is None or not frame.paused:
            self.pause(True)
        self._call("step", StepWorld, count)

    def reset(self, what: str) -> None:
        self._call({"time": "reset_time", "models": "reset_world", "all": "reset_simulation"}[what], Empty)

    # ------------------------------------------------------------------------------------------ models and lights

    def set_pose(self, model: str, pose: d.Pose) -> None:
        self._soon("set_model_state", SetModelState, ModelState(model, _pose(pose), Twist(), "world"))

    def insert(self, name: str, text: str, pose: d.Pose) -> None:
        self._call("spawn_sdf_model", SpawnModel, name, text, "", _pose(pose), "world")

    def delete(self, name: str) -> None:
        known = self._known
        if known is not None and known.model(name) is None and any(light.name == name for light in known.lights):
            self._call("delete_light", DeleteLight, name)
        else:
            self._call("delete_model", DeleteModel, name)

    def set_light(self, light: d.Light) -> None:
        lights = {other.name: other for other in self._known.lights} if self._known else {}
        self._change_light(light, lights.get(light.name))
        if self._known is not None and light.name in lights:
            self._known = replace(self._known, lights=tuple({**lights, light.name: light}.values()))

    def _change_light(self, light: d.Light, known: d.Light | None) -> None:
        if known is not None and (known.range, known.spot) != (light.range, light.spot):  # the service has no place for them
            self._call("delete_light", DeleteLight, light.name)
            self.insert(light.name, light_text(replace(light, pose=d.Pose())), light.pose)
            return
        self._call(
            "set_light_properties",
            SetLightProperties,
            light.name,
            light.cast_shadows,
            ColorRGBA(*light.diffuse),
            ColorRGBA(*light.specular),
            light.constant,
            light.linear,
            light.quadratic,
            Vector3(*light.direction),
            _pose(light.pose),
        )

    # ------------------------------------------------------------------------------------------ joints and links

    def set_joint_position(self, model: str, joint: str, position: float) -> None:
        self._soon("command_joint", CommandJoint, f"{model}::{joint}", CommandJointRequest.SET, position, 0.0, 0.0, 0.0)

    def command_joint(self, model: str, joint: str, mode: str, value: float, gains: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> None:
        self._soon("command_joint", CommandJoint, f"{model}::{joint}", _JOINT_MODES[mode], value, *gains)

    def link_properties(self, model: str, link: str) -> LinkProperties:
        r = self._call("get_link_properties", GetLinkProperties, f"{model}::{link}")
        p = r.com.position
        return LinkProperties(r.mass, (p.x, p.y, p.z), (r.ixx, r.ixy, r.ixz, r.iyy, r.iyz, r.izz), r.gravity_mode)

    def set_link_properties(self, model: str, link: str, properties: LinkProperties) -> None:
        self._call(
            "set_link_properties",
            SetLinkProperties,
            f"{model}::{link}",
            _pose(d.Pose(properties.com)),
            properties.gravity,
            properties.mass,
            *properties.inertia,
        )

    def push(self, model: str, link: str, force: d.Vec3, torque: d.Vec3, duration: float) -> None:
        name = f"{model}::{link}"
        self._soon(
            "apply_body_wrench",
            ApplyBodyWrench,
            name,
            "world",
            Point(),
            Wrench(Vector3(*force), Vector3(*torque)),
            rospy.Time(),
            rospy.Duration.from_sec(duration),
        )

    # ------------------------------------------------------------------------------------------ world

    def physics(self) -> tuple[d.Physics, d.Vec3]:
        r = self._call("get_physics_properties", GetPhysicsProperties)
        o = r.ode_config
        physics = replace(
            d.Physics(),
            max_step_size=r.time_step,
            real_time_update_rate=r.max_update_rate,
            iters=o.sor_pgs_iters,
            precon_iters=o.sor_pgs_precon_iters,
            sor=o.sor_pgs_w,
            cfm=o.cfm,
            erp=o.erp,
            contact_max_correcting_vel=o.contact_max_correcting_vel,
            contact_surface_layer=o.contact_surface_layer,
            max_contacts=o.max_contacts,
        )
        return physics, (r.gravity.x, r.gravity.y, r.gravity.z)

    def set_physics(self, physics: d.Physics, gravity: d.Vec3) -> None:
        config = self._call("get_physics_properties", GetPhysicsProperties).ode_config
        config.sor_pgs_iters, config.sor_pgs_w = physics.iters, physics.sor
        config.cfm, config.erp = physics.cfm, physics.erp
        config.contact_max_correcting_vel = physics.contact_max_correcting_vel
        config.contact_surface_layer, config.max_contacts = physics.contact_surface_layer, physics.max_contacts
        self._call(
            "set_physics_properties", SetPhysicsProperties, physics.max_step_size, physics.real_time_update_rate, Vector3(*gravity), config
        )

    # ------------------------------------------------------------------------------------------ looks and surfaces

    def surface(self, model: str, link: str) -> SurfaceProperties:
        r = self._call("collision_surface", CollisionSurface, f"{model}::{link}", False, 0.0, 0.0, 0.0)
        return SurfaceProperties(r.mu, r.mu2, r.restitution)

    def set_surface(self, model: str, link: str, surface: SurfaceProperties) -> None:
        self._call("collision_surface", CollisionSurface, f"{model}::{link}", True, surface.mu, surface.mu2, surface.restitution)

    def paint(self, model: str, link: str, rgba: d.Rgba) -> None:
        self._call("set_visual", SetVisual, f"{model}::{link}" if link else model, ColorRGBA(*rgba), "")

    def set_looks(self, model: str, looks: Looks) -> None:
        self._call("set_visual", SetVisual, model, ColorRGBA(), dumps(looks))

    # ------------------------------------------------------------------------------------------ timeline

    def moments(self) -> tuple[KeptMoment, ...]:
        r = self._timeline(TimelineRequest.LIST)
        return tuple(KeptMoment(number, time.to_sec()) for number, time in zip(r.numbers, r.times))

    def keep(self) -> None:
        self._timeline(TimelineRequest.KEEP)

    def record(self, period: float) -> None:
        self._timeline(TimelineRequest.RECORD, period=period)

    def go_back(self, number: int) -> None:
        self._timeline(TimelineRequest.RETURN, number)

    def _timeline(self, action: int, number: int = 0, period: float = 0.0) -> Any:
        return self._call("timeline", Timeline, action, number, period)

    def save(self) -> str:
        return self._call("save_world", SaveWorld).sdf


def _pose(pose: d.Pose) -> PoseMsg:
    return PoseMsg(Point(*pose.p), Quaternion(*pose.q))
