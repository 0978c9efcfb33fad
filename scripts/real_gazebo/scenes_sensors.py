"""Sensors of Gazebo's core, without noise. Here they are measured by this simulator's server, with the recorder as a compiled plugin."""

import math

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.sdf import axis, box, collision, cube, cylinder, ground, inertial, joint, link, model, solid, sphere, surface, world

NEAR = (1e-4, 2e-5)


def sensors(name, what, law, bodies, rows, seconds=1.0, deeds=(), version="1.6", extra="", every=0.05, gravity="0 0 -9.8"):
    return add(
        Scene(
            name,
            "sensors",
            what,
            law,
            world(ground(), *bodies, version=version, extra=extra, gravity=gravity),
            tuple(rows),
            seconds,
            every,
            tuple(deeds),
            server=True,
        )
    )


def sensor(kind, inside="", name="s", rate=100, pose=""):
    place = f"<pose>{pose}</pose>" if pose else ""
    return f"<sensor name='{name}' type='{kind}'>{place}<always_on>1</always_on><update_rate>{rate}</update_rate>{inside}</sensor>"


def reads(name, components, what, laws=None, time=math.inf, near=NEAR, default=None):
    return tuple(
        Row(
            f"{word} of {name}" + (f" at {time:g} s" if time < math.inf else ""),
            lambda r, i=i: r.sensor(name, i, time),
            law=None if laws is None else laws[n],
            gazebo=near,
            default=default or near,
        )
        for n, (i, word) in enumerate(zip(components, what))
    )


XYZ = ("x", "y", "z")
# ---------------------------------------------------------------------------------------------------- rays
SCAN = (
    "<ray><scan><horizontal><samples>37</samples><resolution>1</resolution><min_angle>-1.5707963</min_angle>"
    "<max_angle>1.5707963</max_angle></horizontal>"
    "</scan><range><min>0.1</min><max>4.5</max><resolution>0.01</resolution></range></ray>"
)
ROOM = (
    solid("east", box(0.2, 8, 1.5), 1, 1, "4 0 0.75 0 0 0", static=True),
    solid("north", box(8, 0.2, 1.5), 1, 1, "0 3 0.75 0 0 0", static=True),
    solid("south", box(8, 0.2, 1.5), 1, 1, "0 -3.5 0.75 0 0 0", static=True),
    solid("pillar", cylinder(0.3, 1.5), 1, 1, "2 1 0.75 0 0 0", static=True),
    solid("near", sphere(0.02), 1, 1, "0.09 0 0.8 0 0 0", static=True),
)


def holder(inside, pose="0 0 0.8 0 0 0.1"):
    return model("m", link("l", inertial(1, 0.01), inside), pose=pose, static=True)


sensors(
    "ray_room",
    "laser of 37 beams in a room with a pillar; a ball nearer than range_min",
    "ranges to the walls",
    (holder(sensor("ray", SCAN)), *ROOM),
    tuple(
        Row(f"beam {i}, m", lambda r, i=i: r.sensor("m::l::s", 1 + i), gazebo=(1e-4, 1e-5), default=(1e-4, 1e-5)) for i in range(0, 37, 3)
    ),
    0.6,
)
sensors(
    "ray_vertical",
    "laser of 5 x 3 beams over the floor, tilted by 0.3 rad",
    "to the floor: h / sin",
    (
        holder(
            sensor(
                "ray",
                (
                    "<ray><scan><horizontal><samples>5</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal>"
                    "<vertical><samples>3</samples><min_angle>-0.2</min_angle>"
                    "<max_angle>0.2</max_angle></vertical></scan><range><min>0.1</min><max>20</max></range></ray>"
                ),
            ),
            "0 0 1 0 0.5 0",
        ),
    ),
    tuple(Row(f"beam {i}, m", lambda r, i=i: r.sensor("m::l::s", 1 + i), gazebo=(1e-4, 1e-4), default=(1e-4, 1e-4)) for i in range(15)),
    0.6,
)
sensors(
    "ray_shapes",
    "laser past sphere, box and cylinder, its own body in the way",
    "own link's shapes are seen by Gazebo's rays as well",
    (
        model(
            "m",
            link("l", inertial(1, 0.01), collision(sphere(0.05), pose="0.5 0 0 0 0 0"), sensor("ray", SCAN)),
            pose="0 0 0.8 0 0 0",
            static=True,
        ),
        solid("a", sphere(0.3), 1, 1, "1.5 1 0.8 0 0 0", static=True),
        solid("b", box(0.3, 0.3, 1), 1, 1, "1.5 -1 0.8 0 0 0.4", static=True),
    ),
    tuple(
        Row(f"beam {i}, m", lambda r, i=i: r.sensor("m::l::s", 1 + i), gazebo=(1e-4, 1e-5), default=(1e-4, 1e-5))
        for i in (0, 10, 12, 18, 24, 25, 36)
    ),
    0.6,
)
# ---------------------------------------------------------------------------------------------------- IMU
IMU = ("qx", "qy", "qz", "qw", "wx", "wy", "wz", "ax", "ay", "az")
sensors(
    "imu_rest",
    "IMU on a static, tilted link, its own pose turned",
    "gravity as +g in the sensor's frame; orientation from where it started",
    (
        model(
            "m",
            link("l", inertial(1, 0.01), sensor("imu", pose="0.1 0 0 0 0 0.5")),
            joint("j", "fixed", "world", "l"),
            pose="0 0 1 0.3 0.2 0",
        ),
    ),
    reads("m::l::s", range(1, 11), IMU, near=(1e-4, 1e-4), default=(1e-3, 1e-3)),
)
SWING = (
    "<imu><orientation_reference_frame><localization>CUSTOM</localization>"
    "<custom_rpy>0 0 0</custom_rpy></orientation_reference_frame></imu>"
)
for label, reference in (("imu_pendulum", ""), ("imu_pendulum_custom", SWING)):
    sensors(
        label,
        f"IMU at the end of a pendulum from 1.2 rad{', orientation frame CUSTOM' if reference else ''}",
        "w^2 r + g cos along the rod",
        (
            model(
                "m",
                link("l", inertial(1, 0.02, "0 0 -0.5 0 0 0"), sensor("imu", reference, pose="0 0 -0.5 0 0 0"), pose="0 0 0 0 1.2 0"),
                joint("j", "revolute", "world", "l", axis("0 1 0")),
                pose="0 0 2 0 0 0.3",
            ),
        ),
        reads("m::l::s", range(1, 11), IMU, time=0.4, near=(2e-2, 2e-2), default=(3e-2, 3e-2))
        + reads("m::l::s", (6,), ("wy",), time=0.7, near=(2e-2, 2e-2), default=(3e-2, 3e-2)),
        1.0,
    )
sensors(
    "imu_falling",
    "IMU on a falling box",
    "reads 0 while it falls",
    (model("m", link("l", inertial(1, 0.01), collision(box(0.1, 0.1, 0.1)), sensor("imu")), pose="0 0 3 0 0 0"),),
    reads("m::l::s", range(8, 11), XYZ, (0, 0, 0), 0.5, near=(1e-3, 1e-2), default=(1e-3, 1e-2)),
    0.6,
)
# ---------------------------------------------------------------------------------------------------- force and torque
for direction in ("parent_to_child", "child_to_parent"):
    for frame in ("child", "parent", "sensor"):
        inside = f"<force_torque><frame>{frame}</frame><measure_direction>{direction}</measure_direction></force_torque>"
        sensors(
            f"force_torque_{frame}_{direction}",
            f"force_torque sensor, frame {frame}, {direction}: 2 kg aside on a fixed joint whose frames are turned",
            "19.6 N of weight",
            (
                model(
                    "m",
                    link("base", inertial(5, 0.1), pose="0 0 1 0.2 0 0"),
                    joint("hold", "fixed", "world", "base"),
                    link("w", inertial(2, 0.01, "0.1 0 0.05 0 0 0"), pose="0.3 0.2 1.2 0.4 0 0.3"),
                    joint("j", "fixed", "base", "w", sensor("force_torque", inside, pose="0 0 0 0 0.5 0"), pose="0.02 0 0 0 0 0.7"),
                ),
            ),
            reads("m::j::s", range(1, 7), ("fx", "fy", "fz", "tx", "ty", "tz"), near=(2e-3, 5e-3), default=(2e-3, 5e-3)),
        )
sensors(
    "force_torque_default",
    "force_torque sensor without settings, 3 kg hanging on a fixed joint",
    "29.4 N",
    (
        model(
            "m",
            link("post", inertial(1, 0.1), pose="0 0 1 0 0 0"),
            joint("bolt", "fixed", "world", "post"),
            link("w", inertial(3, 0.1), pose="0.3 0 0.8 0 0 0"),
            joint("j", "fixed", "post", "w", sensor("force_torque")),
        ),
    ),
    reads("m::j::s", range(1, 7), ("fx", "fy", "fz", "tx", "ty", "tz"), near=(2e-3, 5e-3)),
)
sensors(
    "force_torque_revolute",
    "force_torque sensor on a revolute joint held by its stops, 2 kg aside",
    "19.6 N",
    (
        model(
            "m",
            link("base", inertial(5, 0.1), pose="0 0 1 0 0 0"),
            joint("hold", "fixed", "world", "base"),
            link("w", inertial(2, 0.01, "0.1 0 0.05 0 0 0"), pose="0 -0.5 2 0.4 0 0"),
            joint("j", "revolute", "base", "w", axis("0 0 1", 0, 0, of_model=False), sensor("force_torque")),
        ),
    ),
    reads("m::j::s", range(1, 7), ("fx", "fy", "fz", "tx", "ty", "tz"), near=(5e-3, 2e-2)),
)
# ---------------------------------------------------------------------------------------------------- the others
MOVING = [Deed("twist", "m", "1 0.5 0.2 0 0 0")]
EARTH = (
    "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><latitude_deg>48.1</latitude_deg>"
    "<longitude_deg>11.5</longitude_deg><elevation>500</elevation>"
    "<heading_deg>{heading}</heading_deg></spherical_coordinates>"
)
for heading in (0, 90):
    sensors(
        f"gps_heading_{heading}",
        f"GPS at 48.1 N 11.5 E, moving 1 0.5 0.2 m/s, world's heading {heading} deg",
        "1 m north is 8.99e-6 deg",
        (model("m", link("l", inertial(1, 0.01), sensor("gps")), pose="100 50 10 0 0 0"),),
        tuple(
            Row(word, lambda r, i=i, o=o: (r.sensor("m::l::s", i) - o) * k, gazebo=(2e-2, 1e-2), default=(2e-2, 1e-2))
            for word, i, o, k in (("latitude less 48.1, deg x 1e5", 1, 48.1, 1e5), ("longitude less 11.5, deg x 1e5", 2, 11.5, 1e5))
        )
        + reads("m::l::s", range(3, 7), ("altitude", "east", "north", "up"), near=(1e-3, 1e-2)),
        0.6,
        MOVING,
        extra=EARTH.format(heading=heading),
        gravity="0 0 0",
    )
sensors(
    "altimeter",
    "altimeter that starts 2 m high and rises at 0.2 m/s",
    "height over its start",
    (model("m", link("l", inertial(1, 0.01), sensor("altimeter")), pose="0 0 2 0 0 0"),),
    reads("m::l::s", (1, 2, 3), ("height", "speed", "reference"), near=(2e-2, 1e-3), default=(2e-2, 1e-3)),
    0.6,
    MOVING,
    gravity="0 0 0",
)
sensors(
    "magnetometer",
    "magnetometer on a turned link, field 5.5e-6 2.3e-5 -4.2e-5 T",
    "the field in the sensor's frame",
    (model("m", link("l", inertial(1, 0.01), sensor("magnetometer", pose="0 0 0 0 0 0.3")), pose="0 0 2 0.2 0.1 0.5", static=True),),
    tuple(
        Row(f"{c}, T x 1e6", lambda r, i=i: r.sensor("m::l::s", 1 + i) * 1e6, gazebo=(1e-4, 1e-4), default=(1e-4, 1e-4))
        for i, c in enumerate(XYZ)
    ),
    0.6,
    extra="<magnetic_field>5.5645e-6 22.8758e-6 -42.3884e-6</magnetic_field>",
)
for where in (0.6, 5.0):
    sensors(
        f"sonar_{f'{where:g}'.replace('.', '')}",
        f"sonar of 1 m reach, box {where:g} m ahead (its cone points along z of the sensor)",
        "range to the box, or the greatest",
        (
            holder(sensor("sonar", "<sonar><min>0.05</min><max>1.0</max><radius>0.2</radius></sonar>"), "0 0 2 0 1.5707963268 0"),
            solid("box", box(0.2, 0.6, 0.6), 1, 1, f"{where + 0.1} 0 2 0 0 0", static=True),
        ),
        reads("m::l::s", (1,), ("range",), near=(5e-3, 5e-3)),
        0.6,
    )
sensors(
    "logical_camera",
    "logical camera: what stands within its pyramid",
    "poses in the camera's frame",
    (
        holder(
            sensor(
                "logical_camera",
                "<logical_camera><near>0.5</near><far>5</far><horizontal_fov>1.0</horizontal_fov>"
                "<aspect_ratio>1.5</aspect_ratio></logical_camera>",
                pose="0 0 0 0 0 0.2",
            ),
            "0 0 1 0 0 0.3",
        ),
        solid("seen", box(0.2, 0.2, 0.2), 1, 1, "2 1 1 0 0 0.4", static=True),
        solid("behind", box(0.2, 0.2, 0.2), 1, 1, "-2 0 1 0 0 0", static=True),
    ),
    reads("m::l::s.seen", range(1, 8), ("x", "y", "z", "qx", "qy", "qz", "qw"), near=(1e-4, 1e-5))
    + (
        Row(
            "box behind it is told (1) or not (0)",
            lambda r: float("sensor:m::l::s.behind" in r.series),
            law=0.0,
            gazebo=(0, 0),
            default=(0, 0),
        ),
    ),
    0.6,
)
sensors(
    "contact_box",
    "contact sensor of a 2 kg box on the floor",
    "four points bear 19.6 N; the sensor's own collision comes first",
    (
        model(
            "m",
            link(
                "l",
                inertial(2, 0.0133),
                collision(box(0.2, 0.2, 0.2), surface(1.0)),
                sensor("contact", "<contact><collision>c</collision></contact>"),
            ),
            pose="0 0 0.1 0 0 0",
        ),
    ),
    (
        Row(
            "own collision named first (1) or second (2)",
            lambda r: next(
                1.0 if n.startswith("sensor:m::l::s.m::") else 2.0
                for n in list(r.series) + list(r.words)
                if n.startswith("sensor:m::l::s.")
            ),
            gazebo=(0, 0),
            default=(0, 0),
        ),
        Row(
            "force z of the first point on the first body, N",
            lambda r: r.last("sensor:m::l::s.")[11],
            gazebo=(2e-2, 0.05),
            default=(2e-2, 0.05),
        ),
        Row("normal z of the first point", lambda r: r.last("sensor:m::l::s.")[7], gazebo=(1e-3, 0), default=(1e-3, 0)),
    ),
)
sensors(
    "contact_two",
    "contact sensor of a box that lies on another box on the floor",
    "touches the lower one only",
    (
        cube("low", 0.2, 2, "0 0 0.1 0 0 0", surface(1.0)),
        model(
            "m",
            link(
                "l",
                inertial(1, 0.00667),
                collision(box(0.2, 0.2, 0.2), surface(1.0)),
                sensor("contact", "<contact><collision>c</collision></contact>"),
            ),
            pose="0 0 0.3 0 0 0",
        ),
    ),
    (
        Row(
            "own collision named first (1) or second (2)",
            lambda r: next(
                1.0 if n.startswith("sensor:m::l::s.m::") else 2.0
                for n in list(r.series) + list(r.words)
                if n.startswith("sensor:m::l::s.")
            ),
            gazebo=(0, 0),
            default=(0, 0),
        ),
        Row(
            "force z of the first point on the first body, N",
            lambda r: r.last("sensor:m::l::s.")[11],
            gazebo=(0.5, 0.5),
            default=(0.5, 0.5),
        ),
    ),
)
