"""Runs a scene on ode_sim and gives the rows that `recorder.cc` writes in real Gazebo."""

from __future__ import annotations

import os
import tempfile

import numpy as np
import ode_sim
from ode_sim.description.finder import ResourceFinder
from ode_sim.math3 import compose, inverse

from real_gazebo.chroot import write_scene
from real_gazebo.records import Record
from real_gazebo.scene import Deed, Scene

SOLVERS = ("gazebo", "default")


class Run:
    """:param solver: gazebo or default."""

    def __init__(self, scene: Scene, solver: str, folder: str) -> None:
        self.scene = scene
        write_scene(scene, folder, folder, "")
        finder = ResourceFinder(model_paths=[folder], environment=False)
        self.world = ode_sim.World.load(os.path.join(folder, "scene.world"), finder=finder)
        self.world.physics.solver = "gazebo" if solver == "gazebo" else "quick"
        self.folder, self.lines, self.elapsed, self.steps = folder, [], 0.0, 0
        self.lasting = [d for d in scene.deeds if d.kind in ("effort", "push", "torque", "pd", "velocity")]
        self.once = [d for d in scene.deeds if d not in self.lasting]
        if self.lasting:
            self.world.before_step.append(self._apply)
        self._watch()

    def _watch(self) -> None:
        for model in self.world.models.values():
            if self.scene.contacts:
                for link in model.links.values():
                    for collision in link.collisions.values():
                        self.world.watch_contacts(collision)
            if self.scene.wrenches:
                for joint in model.joints.values():
                    joint.feedback()

    def go(self) -> Record:
        dt, scene = self.world.dt, self.scene
        chunk, steps, k = max(1, round(scene.every / dt)), round(scene.seconds / dt), 0
        self._describe()
        self._write()
        while k < steps:
            self._do_once(k * dt)
            until = min([steps, (k // chunk + 1) * chunk] + [at for at in (round(d.start / dt) for d in self.once) if at > k])
            self.world.step(until - k)
            k = until
            if k % chunk == 0:
                self.elapsed = k * dt
                self._write()
        self._describe()
        return Record(self.lines)

    # ------------------------------------------------------------------------------------------------ deeds

    def _apply(self, world) -> None:
        t = self.steps * world.dt
        self.steps += 1
        for deed in self.lasting:
            if deed.start - 1e-9 <= t < deed.end - 1e-9:
                self._lasting_deed(deed, [float(v) for v in deed.value.split()])

    def _lasting_deed(self, deed: Deed, v: list[float]) -> None:
        if deed.kind == "push":
            self.world.find_link(deed.on).add_force(tuple(v))
        elif deed.kind == "torque":
            self.world.find_link(deed.on).add_torque(tuple(v))
        else:
            joint = self.world.find_joint(deed.on)
            if joint is None:
                return
            if deed.kind == "effort":
                joint.add_force(v[0], int(v[1]) if len(v) > 1 else 0)
            elif deed.kind == "pd":
                joint.add_force(v[1] * (v[0] - joint.position()) - v[2] * joint.velocity())
            else:  # velocity: the child as the joint lets it go, as Gazebo's Joint::SetVelocity
                w = tuple(v[0] * np.array(joint.world_axis()))
                joint.child.set_twist(tuple(np.cross(w, np.subtract(joint.child.com(), joint.anchor()))), w)

    def _do_once(self, t: float) -> None:
        for deed in [d for d in self.once if d.start <= t + 1e-9]:
            self.once.remove(deed)
            words = [] if deed.kind == "spawn" else [float(v) for v in deed.value.split()]
            getattr(self, "_" + deed.kind)(deed.on, words)

    def _motor(self, on, v):
        self.world.find_joint(on).set_motor(v[0], v[1])

    def _pose(self, on, v):
        from ode_sim.math3 import quat_from_rpy

        self.world.models[on].pose = ode_sim.Pose(tuple(v[:3]), quat_from_rpy(*v[3:]))

    def _twist(self, on, v):
        self.world.models[on].set_twist(tuple(v[:3]), tuple(v[3:]))

    def _position(self, on, v):
        self.world.find_joint(on).set_position(v[0])

    def _reset(self, on, v):
        self.world.reset()

    def _reset_poses(self, on, v):
        self.world.reset_poses()

    def _remove(self, on, v):
        self.world.remove(on)

    def _gravity(self, on, v):
        self.world.find_link(on).gravity = v[0] > 0

    def _world_gravity(self, on, v):
        self.world.gravity = tuple(v)

    def _spawn(self, on, v):
        with open(on.replace("{folder}", self.folder), encoding="utf-8") as file:
            text = file.read()
        (self.world.spawn_urdf if "<robot" in text else self.world.spawn_sdf)(text)
        self._watch()

    # ------------------------------------------------------------------------------------------------ rows

    def _row(self, kind: str, name: str, values) -> None:
        self.lines.append(f"{kind}:{name},{self.elapsed:.9g}," + ",".join(f"{v:.9g}" for v in values))

    def _write(self) -> None:
        for model in self.world.models.values():
            if model.static:
                continue
            if model.canonical_link:
                self._row(
                    "model",
                    model.name,
                    (*model.pose.p, *model.pose.q, *model.canonical_link.velocity_at(model.pose.p), *model.twist().angular),
                )
            if self.scene.links:
                for link in model.links.values():
                    self._row("link", link.scoped_name, (*link.pose.p, *link.pose.q, *link.linear_velocity(), *link.angular_velocity()))
            for joint in model.joints.values():
                self._write_joint(joint)
        if self.scene.contacts:
            for c in self.world.contacts():
                pair = "|".join(self.world.collision(c[side]).scoped_name for side in ("collision1", "collision2"))
                self._row("contact", pair, (*c["position"], *c["normal"], c["depth"], *c["force"], *c["torque"]))

    def _write_joint(self, joint) -> None:
        for axis in range(joint.axis_count):
            self._row(f"joint{axis or ''}", joint.scoped_name, (joint.position(axis), joint.velocity(axis)))
        if self.scene.wrenches:
            f = joint.feedback()  # on the links; Gazebo tells what they exert on the joint, each in its own axes
            values = []
            for link, vectors in ((joint.parent, (f.parent_force, f.parent_torque)), (joint.child, (f.child_force, f.child_torque))):
                back = inverse(ode_sim.Pose(q=link.pose.q)) if link else ode_sim.Pose()
                values += [-x for vector in vectors for x in compose(back, ode_sim.Pose(p=vector)).p]
            self._row("wrench", joint.scoped_name, values)

    def _describe(self) -> None:
        for model in self.world.models.values():
            self._row("is_model", model.name, (float(model.static), *model.pose.p, *model.pose.q))
            for link in model.links.values():
                i = link.description.inertial
                inertia = (i.mass, *i.pose.p, i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz) if i else (1, 0, 0, 0, 1, 1, 1, 0, 0, 0)
                self._row("is_link", link.scoped_name, (*inertia, *link.pose.p, *link.pose.q, float(link.gravity)))
                for collision in link.collisions.values():
                    self.lines.append(f"is_collision:{collision.scoped_name},{self.elapsed:.9g}")
            for joint in model.joints.values():
                words = [joint.parent.name if joint.parent else "world", joint.child.name, str(joint.axis_count)]
                for axis in range(joint.axis_count):
                    d = joint.description.axes[axis]
                    words += [f"{v:.9g}" for v in (*joint.world_axis(axis), *joint.limits(axis), d.effort, d.velocity, d.damping)]
                self.lines.append(f"is_joint:{joint.scoped_name},{self.elapsed:.9g}," + ",".join(words))


def run(scene: Scene, solver: str) -> Record:
    """:param solver: gazebo or default."""
    with tempfile.TemporaryDirectory() as folder:
        return Run(scene, solver, folder).go()
