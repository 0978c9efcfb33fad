"""Messages that need no ROS."""

from types import SimpleNamespace

import pytest


def make_message(names, *points):
    """A JointTrajectory look-alike; each point is (time, positions[, velocities[, accelerations]])."""
    rows = [
        SimpleNamespace(
            time_from_start=SimpleNamespace(to_sec=lambda t=point[0]: t),
            positions=point[1],
            velocities=point[2] if len(point) > 2 else [],
            accelerations=point[3] if len(point) > 3 else [],
        )
        for point in points
    ]
    return SimpleNamespace(joint_names=names, points=rows)


@pytest.fixture
def message():
    return make_message
