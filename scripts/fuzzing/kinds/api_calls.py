"""Calls of the simulator's Python API with numbers of every size, in every order, stepped after each."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from random import Random

from fuzzing import seeds, tree_cases, values, worlds
from fuzzing.findings import refused
from fuzzing.kinds import Kind
from fuzzing.kinds.descriptions import GROUND

_ROBOTS = ("arm.urdf", "rmrobot.urdf", "mbot_base.urdf", "mbot_with_laser.urdf", "steered_car.urdf", "ur5_robot.urdf")
_MODELS = ("unit_box.sdf", "unit_sphere.sdf", "coke_can.sdf", "table.sdf", "car_wheel.sdf", "hokuyo.sdf")
_STEPS = 3  # after each call
_SURFACE = ("mu", "mu2", "kp", "kd", "max_vel", "slip1", "slip2", "min_depth", "restitution", "bounce_threshold")
_PHYSICS = (
    "max_step_size",
    "max_contacts",
    "iters",
    "sor",
    "cfm",
    "erp",
    "contact_max_correcting_vel",
    "contact_surface_layer",
    "real_time_update_rate",
)
_PARAMETERS = (
    "fmax",
    "vel",
    "hi_stop",
    "lo_stop",
    "stop_erp",
    "stop_cfm",
    "friction",
    "damping",
    "thread_pitch",
    "gearbox_ratio",
    "no_such",
)
_DECLARED = (ValueError, KeyError)  # DescriptionError is a ValueError; KeyError: no such model


class Scene:
    """A world in which calls ``[name, a, numbers, b]`` are made: ``a`` and ``b`` choose among what is there.

    :param file: of the robot, one of the seeds.
    """

    def __init__(self, file: str):
        import ode_sim

        self.sim = ode_sim
        self.text = {**seeds.robots(), **seeds.models()}[file].decode()
        self.spawn_call = "spawn_urdf" if file.endswith(".urdf") else "spawn_sdf"
        self.world = ode_sim.World.load(GROUND, finder=seeds.finder())
        self.spawn("robot", ode_sim.Pose((0.0, 0.0, 0.3)))
        self.spawned, self.snapshots, self.held, self.views = 0, [], [], []
        self.gone: list[object] = []

    def spawn(self, name: str, pose) -> None:
        getattr(self.world, self.spawn_call)(self.text, name=name, pose=pose)

    def models(self, i: int) -> list[object]:
        """What a call chooses from: seldom the ground."""
        return [model for name, model in self.world.models.items() if name != "ground" or i % 7 == 0]

    def model(self, i: int):
        return _chosen(self.models(i), i)

    def link(self, i: int):
        return _chosen([link for model in self.models(i) for link in model.links.values()], i)

    def joint(self, i: int):
        return _chosen([joint for model in self.models(i) for joint in model.joints.values() if joint.axis_count], i)

    def collision(self, i: int):
        return _chosen([shape for model in self.models(i) for link in model.links.values() for shape in link.collisions.values()], i)

    def pose(self, v):
        """x y z, and a quaternion where there is one; the others turn about z."""
        return self.sim.Pose(tuple(v[:3]), tuple(v[3:7]) if any(v[3:7]) else (0.0, 0.0, 0.0, 1.0))


def _chosen(items: list, i: int):
    return items[i % len(items)] if items else None


def _respawn(s: Scene, a: int, v: list[float], b: int) -> None:
    if "robot" in s.world.models:
        s.world.remove("robot")
    s.spawn("robot", s.pose(v))


def _spawn(s: Scene, a: int, v: list[float], b: int) -> None:
    if len(s.world.models) < 8:
        s.spawned += 1
        s.spawn(f"robot_{s.spawned}" if a % 9 else "robot", s.pose(v))


def _remove(s: Scene, a: int, v: list[float], b: int) -> None:
    model = s.model(b)
    model.remove()
    s.gone.append(model)


def _inertial(s: Scene, a: int, v: list[float], b: int) -> None:
    from ode_sim.description.model import Inertial

    tensor = tuple(v[4:10]) if any(v[4:10]) else (0.1, 0.1, 0.1, 0.0, 0.0, 0.0)
    fields = dict(zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), tensor))
    s.link(b).set_inertial(Inertial(mass=v[0], pose=s.sim.Pose(tuple(v[1:4])), **fields))


def _physics(s: Scene, a: int, v: list[float], b: int) -> None:
    name = _PHYSICS[a % len(_PHYSICS)]
    setattr(s.world.physics, name, v[0])


def _surface(s: Scene, a: int, v: list[float], b: int) -> None:
    surface, name = s.collision(b).surface, _SURFACE[a % len(_SURFACE)]
    setattr(surface, name, v[0])
    if b % 5 == 0:
        surface.fdir1 = tuple(v[:3])


def _attach(s: Scene, a: int, v: list[float], b: int) -> None:
    s.held.append(s.world.attach(None if a % 4 == 0 else s.link(a), s.link(b)))


def _hold(s: Scene, a: int, v: list[float], b: int) -> None:
    if s.held:  # RuntimeError: what has let go cannot be held elsewhere
        refused(lambda: setattr(s.held[a % len(s.held)], "pose", s.pose(v)), RuntimeError, *_DECLARED)


def _restore(s: Scene, a: int, v: list[float], b: int) -> None:
    if s.snapshots:
        s.world.restore(s.snapshots[a % len(s.snapshots)])


def _rays(s: Scene, a: int, v: list[float], b: int) -> None:
    s.world.cast_rays([v[:3]] * 4, [v[3:6], v[6:9], (1.0, 0.0, 0.0), (0.0, 0.0, -1.0)], v[9] if a % 2 else 10.0, [s.collision(b)])


def _feedback(s: Scene, a: int, v: list[float], b: int) -> None:
    s.joint(b).feedback()


def _views(s: Scene, a: int, v: list[float], b: int) -> None:
    s.views.append((s.world.link_poses, s.world.joint_positions))
    for poses, positions in s.views:  # memory of before the last spawn must still be memory
        float(poses.sum() + positions.sum())


def _gone(s: Scene, a: int, v: list[float], b: int) -> None:
    """A handle of a removed model raises RuntimeError where it would act, and nothing worse."""
    if s.gone:
        model = s.gone[a % len(s.gone)]
        actions: list[Callable[[], object]] = [
            lambda: model.pose,
            lambda: setattr(model, "pose", s.pose(v)),
            lambda: model.set_twist(v[:3], v[3:6]),
        ]
        actions += [lambda link=link: link.add_force(v[:3]) for link in model.links.values()]
        actions += [lambda joint=joint: joint.position() if joint.axis_count else 0 for joint in model.joints.values()]
        refused(actions[b % len(actions)], RuntimeError, *_DECLARED)


def _axis(joint, a: int) -> int:
    return a % joint.axis_count


CALLS: dict[str, Callable[[Scene, int, list[float], int], object]] = {
    "respawn": _respawn,
    "spawn": _spawn,
    "remove": _remove,
    "link.inertial": _inertial,
    "physics": _physics,
    "surface": _surface,
    "attach": _attach,
    "restore": _restore,
    "rays": _rays,
    "feedback": _feedback,
    "views": _views,
    "gone": _gone,
    "model.pose": lambda s, a, v, b: setattr(s.model(b), "pose", s.pose(v)),
    "model.twist": lambda s, a, v, b: s.model(b).set_twist(v[:3], v[3:6]),
    "link.pose": lambda s, a, v, b: setattr(s.link(b), "pose", s.pose(v)),
    "link.twist": lambda s, a, v, b: s.link(b).set_twist(v[:3], v[3:6]),
    "link.force": lambda s, a, v, b: s.link(b).add_force(v[:3], v[3:6] if a % 2 else None),
    "link.torque": lambda s, a, v, b: s.link(b).add_torque(v[:3]),
    "link.set_force": lambda s, a, v, b: (s.link(b).set_force(v[:3]), s.link(b).set_torque(v[3:6])),
    "link.gravity": lambda s, a, v, b: setattr(s.link(b), "gravity", a % 2),
    "joint.force": lambda s, a, v, b: s.joint(b).add_force(v[0], _axis(s.joint(b), a)),
    "joint.motor": lambda s, a, v, b: s.joint(b).set_motor(v[0], v[1], _axis(s.joint(b), a)),
    "joint.drive_to": lambda s, a, v, b: s.joint(b).drive_to(v[0]),
    "joint.drive_off": lambda s, a, v, b: s.joint(b).drive_off(),
    "joint.follow": lambda s, a, v, b: s.joint(b).follow(s.joint(a) if a % 5 else None, v[0], v[1]),
    "joint.position": lambda s, a, v, b: s.joint(b).set_position(v[0], _axis(s.joint(b), a)),
    "joint.limits": lambda s, a, v, b: s.joint(b).set_limits(v[0], v[1], _axis(s.joint(b), a)),
    "joint.damping": lambda s, a, v, b: setattr(s.joint(b), "damping" if a % 2 else "friction", v[0]),
    "joint.param": lambda s, a, v, b: s.joint(b).set_param(_PARAMETERS[a % len(_PARAMETERS)], v[0]),
    "joint.read": lambda s, a, v, b: (s.joint(b).effort(), s.joint(b).anchor(), s.joint(b).world_axis(), s.joint(b).limits()),
    "gravity": lambda s, a, v, b: setattr(s.world, "gravity", tuple(v[:3])),
    "watch": lambda s, a, v, b: s.world.watch_contacts(s.collision(b), bool(a % 3)),
    "save": lambda s, a, v, b: s.snapshots.append(s.world.save()),
    "reset": lambda s, a, v, b: s.world.reset() if a % 2 else s.world.reset_poses(),
    "hold": _hold,
    "detach": lambda s, a, v, b: s.held[a % len(s.held)].detach() if s.held else None,
    "step": lambda s, a, v, b: s.world.step(b % 40),
}
_NEEDS = {
    "joint": "joint",
    "feedback": "joint",
    "link": "link",
    "attach": "link",
    "surface": "collision",
    "watch": "collision",
    "rays": "collision",
    "model": "model",
    "remove": "model",
}


class ApiKind(Kind):
    """``ode_sim.World`` and its handles. A case is JSON: a robot file, then calls ``[name, a, ten numbers, b]``."""

    name, suffix = "api", ".json"

    def prepare(self) -> None:
        known = {**seeds.robots(), **seeds.models()}
        self._files = [name for name in _ROBOTS + _MODELS if name in known]
        for name in self._files:
            Scene(name)

    def generate(self, random: Random) -> bytes:
        calls = []
        extreme = random.choice((0.02, 0.1, 0.4))
        for _ in range(random.choice((1, 2, 3, 5, 8, 12, 20, 30))):
            numbers = [values.number(random, extreme) if random.random() < 0.6 else 0.0 for _ in range(10)]
            calls.append([random.choice(list(CALLS)), random.randrange(40), numbers, random.randrange(1000)])
        return json.dumps({"file": random.choice(self._files), "calls": calls}).encode()

    def run(self, case: bytes) -> None:
        told = json.loads(case)
        scene = Scene(told["file"])
        for name, a, numbers, b in told["calls"]:
            need = _NEEDS.get(name.split(".")[0])
            if need and getattr(scene, need)(b) is None:
                continue
            refused(lambda: CALLS[name](scene, a, numbers, b), *_DECLARED)
            scene.world.step(_STEPS)
        world = scene.world
        for collision in list(world._collisions.values()):
            world.watch_contacts(collision)
        world.step(max(worlds.STEPS - _STEPS * len(told["calls"]), 5))
        worlds.check_state(world)
        worlds.check_messages(world, world.messages, "messages of a world")
        self._check_handles(world)
        worlds.check_replay(world)
        worlds.check_end(world)

    @staticmethod
    def _check_handles(world) -> None:
        import numpy as np

        from fuzzing.findings import Found

        for model in world.models.values():
            numbers = [*model.pose.p, *model.pose.q, *model.twist().linear]
            for link in model.links.values():
                numbers += [*link.linear_velocity(), *link.angular_velocity(), *link.com(), *link.applied_force()]
            for joint in model.joints.values():
                if joint.axis_count:
                    numbers += [joint.effort(), *joint.anchor()]
            if not np.isfinite(numbers).all():
                raise Found(
                    "silent NaN", "what the handles of a model say", f"{model.name}; world says: {(world.messages or ['nothing'])[0][:200]}"
                )

    def smaller(self, case: bytes) -> Iterator[bytes]:
        told = json.loads(case)
        for calls in tree_cases.runs(told["calls"]):
            yield json.dumps({**told, "calls": calls}).encode()
        for i, (name, a, numbers, b) in enumerate(told["calls"]):
            for j, value in enumerate(numbers):
                if value != 0.0:
                    fewer = [name, a, [*numbers[:j], 0.0, *numbers[j + 1 :]], b]
                    yield json.dumps({**told, "calls": [*told["calls"][:i], fewer, *told["calls"][i + 1 :]]}).encode()
