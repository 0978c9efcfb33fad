"""What the tests of hostile inputs ask of every world."""

import numpy as np
import pytest


def refused(act, error=ValueError):
    """The one line by which it was refused."""
    with pytest.raises(error) as caught:
        act()
    assert "\n" not in str(caught.value) and 0 < len(str(caught.value)) < 300
    return str(caught.value)


def runs_on(world, steps=20):
    """The world can be stepped, seen, saved; all its numbers are numbers."""
    before = world.time
    world.step(steps)
    assert world.time > before
    for array in (world.link_poses, world.joint_positions, world.joint_velocities):
        assert np.isfinite(array).all()
    contacts = world.contacts()
    for name in ("position", "normal", "depth", "force", "torque"):
        assert np.isfinite(contacts[name]).all(), name
    for model in world.models.values():
        for joint in model.joints.values():
            assert np.isfinite(joint.feedback()).all()
        for link in model.links.values():
            assert np.isfinite((*link.linear_velocity(), *link.angular_velocity())).all()
    ranges, _ = world.cast_rays(np.array([[0, 0, 50.0]]), np.array([[0, 0, -1.0]]), 100.0)
    assert not np.isnan(ranges).any()
    world.restore(world.save())
