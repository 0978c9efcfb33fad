"""Scenes whose every bit is known: what is rearranged in the core must not change a result.

golden_hashes.json holds a digest of each scene after every 100 steps: poses, joints, speeds, contacts with their forces, readings of
force and torque. The digests do not depend on how the core is compiled (without -ffast-math and -march), or on load.
They do depend on the machine's libm, which chooses its functions by processor, and on the version of ODE: golden_hashes.json says
for which of both it is. Elsewhere the test is skipped and says so.

A change that is meant to change results renews them:  python3 src/simulation/ode_sim/test/test_physics_golden.py --renew
Its commit says why results change.
"""

import hashlib
import json
import math
import os
import platform
import struct
import subprocess
import sys

import golden_scenes
import numpy as np
import pytest
from ode_sim import _core

STEPS, EVERY = 1300, 100
FILE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "golden_hashes.json")


def machine():
    """What the last bit depends on besides the core: ODE and its settings, and the functions of libm, by what they give."""
    functions = (math.sin, math.cos, math.atan, math.exp, math.asin)
    values = [f(x / 777.0) for f in functions for x in range(-777, 778)]
    values += [math.atan2(x, 3.3) for x in range(999)] + [math.sin(x * 1.7) for x in range(999)]
    ode = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "libode8*"], capture_output=True, text=True, check=False).stdout
    libm = hashlib.sha256(struct.pack(f"{len(values)}d", *values)).hexdigest()[:12]
    return f"{platform.machine()}, libode {ode or 'of unknown version'}, libm {libm}"


def state(world):
    """Every number that the core tells about the world, as bytes."""
    out = [
        np.array([world.time_ns, world.iterations], dtype=np.int64).tobytes(),
        world.link_poses.tobytes(),
        world.joint_positions.tobytes(),
        world.joint_velocities.tobytes(),
        world.contacts().tobytes(),
    ]
    for model in world.models.values():
        numbers = [float(model.asleep)]
        for link in model.links.values():
            numbers += [*link.linear_velocity(), *link.angular_velocity(), *link.applied_force(), *link.applied_torque()]
        for joint in model.joints.values():
            numbers += [joint.core.drive_mode, joint.core.drive_target, *np.ravel(joint.core.feedback())]
            numbers += [joint.core.effort(axis) for axis in range(joint.axis_count)]
        out.append(struct.pack(f"{len(numbers)}d", *numbers))
    return b"".join(out)


def digests(scene):
    """A digest after every EVERY steps, of all that was so far."""
    world, so_far, out = scene(), hashlib.sha256(), []
    for _ in range(STEPS // EVERY):
        world.step(EVERY)
        so_far.update(state(world))
        out.append(so_far.hexdigest()[:16])
    return out


def golden():
    with open(FILE, encoding="utf-8") as file:
        return json.load(file)


@pytest.mark.parametrize("scene", golden_scenes.SCENES, ids=lambda scene: scene.__name__)
def test_every_bit_is_as_it_was(scene):
    known = golden()
    if known["machine"] != machine():
        pytest.skip(f"the digests are those of {known['machine']}; this is {machine()}")
    found, wanted = digests(scene), known["scenes"][scene.__name__]
    first = next((i for i, (a, b) in enumerate(zip(found, wanted)) if a != b), None)
    assert first is None, (
        f"{scene.__name__}: some number differs after {(first + 1) * EVERY} steps. If that is meant, renew the digests, "
        "see the head of this file"
    )


def test_the_scenes_do_what_they_are_for():
    """Each road through the core is taken: direct solver and that of piles, motors of drives that touch, sleep, welds."""
    counted = {scene.__name__: scene() for scene in (golden_scenes.pile, golden_scenes.grip, golden_scenes.islands, golden_scenes.drive)}
    for world in counted.values():
        world.step(STEPS)
        assert not world.messages
    assert counted["pile"].core.counters.piles > 100 and counted["drive"].core.counters.direct > 100
    assert counted["grip"].core.counters.promotions > 0 and counted["grip"].models["part"].pose.p[2] > 0.23
    world = counted["islands"]
    world.step(100)
    asleep = [world.models[f"box{i}"].asleep for i in range(12)]
    assert any(asleep) and not all(asleep)


def renew():
    known = {"machine": machine(), "scenes": {scene.__name__: digests(scene) for scene in golden_scenes.SCENES}}
    with open(FILE, "w", encoding="utf-8") as file:
        scenes = ",\n".join(f"  {json.dumps(name)}: {json.dumps(found)}" for name, found in known["scenes"].items())
        file.write(f'{{"machine": {json.dumps(known["machine"])}, "scenes": {{\n{scenes}}}}}\n')


if __name__ == "__main__":
    if sys.argv[1:] != ["--renew"]:
        sys.exit(f"usage: {sys.argv[0]} --renew")
    print(f"{_core.__file__} makes {FILE}")
    renew()
