"""Run a busy world and print a digest of every bit of its state. Started by the tests in processes of their own."""

import hashlib
import sys

import ode_sim
from physics_models import arm, box, diff_drive, gripper, ground


def busy_world(seed=7):
    """Boxes in a heap, a robot that drives into them, a gripper that grips, an arm: every solver and mode at work."""
    world = ode_sim.World(seed=seed)
    world.spawn(ground())
    rng = world.rng("heap")
    for i in range(25):
        world.spawn(
            box(f"box{i}", (1.0 + rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), 0.1 + 0.08 * i), rpy=tuple(rng.uniform(-1, 1, 3)))
        )
    robot = world.spawn(diff_drive())
    hand = world.spawn(gripper(), name="hand")
    hand.pose = ode_sim.Pose((-2, 0, 0))
    world.spawn(box("part", at=(-2, 0, 0.225), size=(0.05, 0.05, 0.05), mass=0.2))
    world.spawn(box("stand", at=(-2, 0, 0.1), size=(0.1, 0.03, 0.2), static=True))
    mover = world.spawn(arm(4, name="mover", at=(0, 3, 0)))

    def command(w):
        for wheel in ("left", "right"):
            robot.joints[wheel].set_motor(10.0, 5.0)
        for name in ("left", "right"):
            hand.joints[name].drive_to(min(0.1, 0.1 * w.time))
        hand.joints["lift"].drive_to(max(0.0, min(0.2, 0.2 * (w.time - 1.0))))
        for joint in list(mover.joints.values())[1:]:
            joint.add_force(2.0)

    world.before_step.append(command)
    return world


def digest(world):
    return hashlib.sha256(bytes(world.save())).hexdigest()


if __name__ == "__main__":
    subject = busy_world()
    subject.step(int(sys.argv[1]))
    print(digest(subject))
