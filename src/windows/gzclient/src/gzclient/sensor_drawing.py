"""How the messages of sensors are drawn where the sensors are; each keeps its nodes up to date."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from gazebo_msgs.msg import ContactsState
from geometry_msgs.msg import WrenchStamped
from ode_sim.math3 import Pose, rotate, scale
from ode_sim_viewer.arrows import Forces
from ode_sim_viewer.drawing import wxyz
from ode_sim_viewer.simulation import Frame, WorldRecord
from sensor_msgs.msg import Image, LaserScan, PointCloud2, Range

from gzclient.images import picture_of
from gzclient.sensor_frames import cloud_points, field_of_view, is_camera, optical, range_cone, scan_points

_SMALL = 160  # pixels along a side of a picture in a frustum


class Place(NamedTuple):
    """Where a message's frame is: the scene node of its link, X_LS, and the names of model and link."""

    node: str
    pose: Pose
    model: str
    link: str


class Kind(NamedTuple):
    """``draw(view, source, place)``; ``most`` topics of it are shown. ``in_world``: whatever frame they name."""

    cls: Any  # of messages
    draw: Callable
    most: int = 30
    in_world: bool = False

    @property
    def type_name(self) -> str:
        return self.cls._type


class View(NamedTuple):
    """Where to draw: viser's scene, the world and its newest frame, m of an arrow for each N."""

    scene: Any
    world: WorldRecord
    frame: Frame
    scale: float


def _scan(view: View, source: Any, place: Place) -> None:
    points = scan_points(source.message)
    if not len(points):
        source.hide()
    elif source.node is None:
        source.node = view.scene.add_point_cloud(
            source.name(place.node),
            points,
            colors=(30, 60, 255),
            point_size=0.03,
            precision="float32",
            position=place.pose.p,
            wxyz=wxyz(place.pose.q),
        )
    else:
        source.node.points = points


def _cone(view: View, source: Any, place: Place) -> None:
    rim = range_cone(source.message)
    lines = np.concatenate([np.stack([np.zeros_like(rim), rim], 1), np.stack([rim[:-1], rim[1:]], 1)])
    if source.node is None:
        source.node = view.scene.add_line_segments(
            source.name(place.node), lines, colors=(255, 140, 0), thickness=0.008, position=place.pose.p, wxyz=wxyz(place.pose.q)
        )
    else:
        source.node.points = lines


def _camera(view: View, source: Any, place: Place) -> None:
    picture = picture_of(source.message)
    step = -(-max(picture.shape[:2]) // _SMALL)
    picture = np.ascontiguousarray(picture[::step, ::step])
    if source.node is not None:
        source.node.image = picture
        return
    aspect = picture.shape[1] / picture.shape[0]
    wide = field_of_view(view.world, place.model, place.link, source.message.header.frame_id)
    pose = optical(place.pose)
    source.node = view.scene.add_camera_frustum(
        source.name(place.node),
        fov=2 * math.atan(math.tan(min(wide, 3.0) / 2) / aspect),
        aspect=aspect,
        scale=0.3,
        thickness=0.005,
        image=picture,
        format="jpeg",
        position=pose.p,
        wxyz=wxyz(pose.q),
        cast_shadow=False,
    )


def _cloud(view: View, source: Any, place: Place) -> None:
    points, colours = cloud_points(source.message)
    if not len(points):
        source.hide()
        return
    if source.node is not None and len(points) != len(source.node.points):
        source.hide()  # its colours would not fit for a moment
    if source.node is None:
        camera = is_camera(view.world, place.model, place.link, source.message.header.frame_id)
        pose = optical(place.pose) if camera else place.pose
        source.node = view.scene.add_point_cloud(
            source.name(place.node), points, colors=colours, point_size=0.012, precision="float32", position=pose.p, wxyz=wxyz(pose.q)
        )
    else:
        source.node.points, source.node.colors = points, colours


def _bumper(view: View, source: Any, place: Place) -> None:
    """Places are those of the world, whatever the frame says; forces turn with the link of the first collision, on which they act.

    Of a body on something that stands the force on the body is drawn: the other one is hidden in what stands.
    """
    places, forces = [], []
    for state in source.message.states:
        model, _, rest = state.collision1_name.partition("::")
        record = view.world.model(model)
        row = record.links.get(rest.rpartition("::")[0]) if record is not None else None
        other = view.world.model(state.collision2_name.partition("::")[0])
        turn = Pose(q=view.frame.pose(row).q) if row is not None else Pose()
        sign = -1.0 if record is not None and record.static and other is not None and not other.static else 1.0
        for p, wrench in zip(state.contact_positions, state.wrenches):
            places.append((p.x, p.y, p.z))
            forces.append(scale(rotate(turn, (wrench.force.x, wrench.force.y, wrench.force.z)), sign))
    _forces(view, source, place, (220, 30, 160)).show(
        np.array(places, float).reshape(-1, 3), np.array(forces, float).reshape(-1, 3), view.scale
    )


def _wrench(view: View, source: Any, place: Place) -> None:
    """The force, and the torque in the direction of its axis, ten times as long for each N m."""
    wrench = source.message.wrench
    vectors = np.array(
        [(wrench.force.x, wrench.force.y, wrench.force.z), (10 * wrench.torque.x, 10 * wrench.torque.y, 10 * wrench.torque.z)]
    )
    _forces(view, source, place, (120, 60, 220)).show(np.zeros((2, 3)), vectors, view.scale)


def _forces(view: View, source: Any, place: Place, colour: tuple[int, int, int]) -> Forces:
    if source.forces is None:
        source.node = view.scene.add_frame(source.name(place.node), show_axes=False, position=place.pose.p, wxyz=wxyz(place.pose.q))
        source.forces = Forces(view.scene, source.node.name, colour)
    return source.forces


KINDS: dict[str, Kind] = {
    "Laser scans": Kind(LaserScan, _scan),
    "Sonars": Kind(Range, _cone),
    "Cameras": Kind(Image, _camera, 4),
    "Depth clouds": Kind(PointCloud2, _cloud, 4),
    "Bumpers": Kind(ContactsState, _bumper, in_world=True),
    "Wrenches": Kind(WrenchStamped, _wrench),
}
