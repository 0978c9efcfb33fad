"""Holding on to things: libgazebo_ros_vacuum_gripper.so and libgazebo_grasp_fix.so."""

from __future__ import annotations

import itertools
import math

from gazebo_ros.plugin import ModelPlugin, PluginError
from node_signals.rates import Spaced
from ode_sim import Attachment, math3
from std_msgs.msg import Bool
from std_srvs.srv import Empty, EmptyResponse

from gazebo_plugins.ros_side import Topics, find_link, required

_REACH = 0.05  # m from the gripper's origin to the link it pulls at
_HELD = 0.01  # m: this near, the link is snapped to the gripper
_STRONGEST = 20.0  # N


class VacuumGripper(ModelPlugin):
    """While on, links of other models within 5 cm are pulled in and carried along."""

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "C")
        self.link = find_link(model, server.world, sdf)
        self.on = False
        self.publisher = self.topics.publisher(required(sdf, "topicName"), Bool)
        self.topics.service("on", Empty, lambda _: self._switch(True))
        self.topics.service("off", Empty, lambda _: self._switch(False))
        server.before_step(self.step)

    def _switch(self, on: bool) -> EmptyResponse:
        self.on = on
        return EmptyResponse()

    def step(self) -> None:
        grasping = False
        if self.on:
            gripper = self.link.pose
            velocity = self.link.linear_velocity(), self.link.angular_velocity()
            for model in self.server.world.models.values():
                if model is self.model or model.static:
                    continue
                for link in model.links.values():
                    grasping |= self._pull(link, gripper, velocity)
        if self.publisher.get_num_connections():
            self.publisher.publish(Bool(grasping))

    @staticmethod
    def _pull(link, gripper, velocity) -> bool:
        pose = link.pose
        offset = math3.sub(gripper.p, pose.p)
        distance = math3.norm(offset)
        if distance >= _REACH:
            return False
        link.set_twist(*velocity)
        if distance < _HELD:
            link.pose = type(pose)(gripper.p, pose.q)
        else:
            link.add_force(math3.scale(offset, min(1.0 / distance, _STRONGEST) / distance))
        return True

    def shutdown(self) -> None:
        self.topics.close()


class GraspFix(ModelPlugin):
    """Fixes an object to the palm while two links of the gripper press on it from opposite sides.

    Grips hold by friction here without this plugin; robots that carry it in their description keep working with it.
    ``<arm><arm_name><palm_link><gripper_link>...</arm>``, ``forces_angle_tolerance`` (deg), ``update_rate`` (Hz),
    ``grip_count_threshold``, ``max_grip_count``, ``release_tolerance`` (m).
    """

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        arm = sdf.child("arm")
        if arm is None:
            raise PluginError("<arm> with <palm_link> and <gripper_link> elements is missing")
        self.palm = find_link(model, server.world, arm, "palm_link")
        fingers = [child.text for child in arm.children("gripper_link")]
        unknown = [name for name in fingers if name not in model.links]
        if unknown or not fingers:
            raise PluginError(f"<gripper_link> {', '.join(unknown) or 'is missing'}: no such link in model {model.name}")
        self.collisions: dict[int, str] = {}
        for name in fingers:
            for collision in model.links[name].collisions.values():
                self.collisions[collision.id] = name
                server.world.watch_contacts(collision)
        self.angle = math.radians(sdf.get("forces_angle_tolerance", 120.0))
        self.gate = Spaced(max(sdf.get("update_rate", 5.0), 1e-3))
        self.threshold = sdf.get("grip_count_threshold", 2)
        self.most = sdf.get("max_grip_count", 8)
        self.release = sdf.get("release_tolerance", 0.005)
        self.counts: dict[str, int] = {}
        self.attachment: Attachment | None = None
        self.finger_gap = 0.0
        self.fingers = [model.links[name] for name in fingers]
        server.after_step(self.step)

    def _gap(self) -> float:
        """Sum of the distances between the fingers' centres of mass: grows when the gripper opens."""
        points = [finger.com() for finger in self.fingers]
        return sum(math3.norm(math3.sub(a, b)) for a, b in itertools.combinations(points, 2))

    def step(self) -> None:
        if not self.gate.due(self.server.world.time_ns):
            return
        if self.attachment is not None:
            if not self.attachment.active or self._gap() > self.finger_gap + self.release:
                self._let_go()
            return
        gripped = self._gripped()
        for name in list(self.counts):
            self.counts[name] = self.counts[name] - 1 if name not in gripped else self.counts[name]
            if self.counts[name] <= 0:
                del self.counts[name]
        for name in gripped:
            self.counts[name] = min(self.counts.get(name, 0) + 1, self.most)
            if self.counts[name] > self.threshold:
                self._hold(gripped[name])
                return

    def _gripped(self) -> dict:
        """Objects (model name -> link) pressed from two directions further apart than the tolerance."""
        pushes: dict[str, list] = {}
        links: dict[str, object] = {}
        for contact in self.server.world.contacts():
            for own, other, sign in (("collision1", "collision2", -1.0), ("collision2", "collision1", 1.0)):
                if int(contact[own]) in self.collisions:
                    link = self.server.world.collision(int(contact[other])).link
                    if link.model is not self.model and not link.model.static:
                        pushes.setdefault(link.model.name, []).append(math3.scale(tuple(contact["normal"]), sign))
                        links[link.model.name] = link
        return {
            name: links[name]
            for name, normals in pushes.items()
            if any(math3.dot(a, b) < math.cos(self.angle) for a in normals for b in normals)
        }

    def _hold(self, link) -> None:
        self.finger_gap = self._gap()
        self.attachment = self.server.world.attach(self.palm, link)
        self.counts.clear()

    def _let_go(self) -> None:
        if self.attachment is not None:
            self.attachment.detach()
            self.attachment = None

    def reset(self) -> None:
        self._let_go()
        self.counts.clear()
        self.gate.reset()

    shutdown = _let_go
