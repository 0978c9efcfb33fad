"""Words of SDF for the scenes: each function returns the text of one element."""

from __future__ import annotations

import math


def _elements(**values) -> str:
    return "".join(f"<{name}>{value}</{name}>" for name, value in values.items() if value is not None)


def _within(path: str, text: str) -> str:
    for name in reversed(path.split("/")):
        text = f"<{name}>{text}</{name}>" if text else ""
    return text


def world(*parts: str, gravity: str = "0 0 -9.8", physics: str = "", step: float = 0.001, version: str = "1.6", extra: str = "") -> str:
    """A world of real Gazebo's own settings, but for what `physics` (children of its <physics>) says."""
    physics = (
        f"<physics type='ode'><max_step_size>{step}</max_step_size><real_time_factor>1</real_time_factor>"
        f"<real_time_update_rate>0</real_time_update_rate>{physics}</physics>"
    )
    return (
        f"<?xml version='1.0'?>\n<sdf version='{version}'><world name='default'><gravity>{gravity}</gravity>{physics}{extra}\n"
        + "\n".join(parts)
        + "\n</world></sdf>\n"
    )


def box(x: float, y: float, z: float) -> str:
    return f"<box><size>{x:.9g} {y:.9g} {z:.9g}</size></box>"


def sphere(radius: float) -> str:
    return f"<sphere><radius>{radius:.9g}</radius></sphere>"


def cylinder(radius: float, length: float) -> str:
    return f"<cylinder><radius>{radius:.9g}</radius><length>{length:.9g}</length></cylinder>"


def mesh(name: str) -> str:
    return f"<mesh><uri>file://{{folder}}/{name}</uri></mesh>"


def surface(mu=None, mu2=None, fdir1=None, slip1=None, slip2=None, e=None, threshold=None, torsional=None, collide="", **contact) -> str:
    """`contact`: kp, kd, max_vel, min_depth, soft_cfm, soft_erp; `torsional` and `collide`: text of elements."""
    friction = _within("ode", _elements(mu=mu, mu2=mu if mu2 is None else mu2, fdir1=fdir1, slip1=slip1, slip2=slip2))
    friction += _within("torsional", torsional or "")
    bounce = _elements(restitution_coefficient=e, threshold=threshold)
    return _within("friction", friction) + _within("bounce", bounce) + _within("contact", collide + _within("ode", _elements(**contact)))


def collision(shape: str, surfaces: str = "", pose: str = "", name: str = "c", more: str = "") -> str:
    place = f"<pose>{pose}</pose>" if pose else ""
    face = f"<surface>{surfaces}</surface>" if surfaces else ""
    return f"<collision name='{name}'>{place}<geometry>{shape}</geometry>{face}{more}</collision>"


def inertial(mass: float, moments, pose: str = "") -> str:
    x, y, z = (moments,) * 3 if isinstance(moments, (int, float)) else moments
    place = f"<pose>{pose}</pose>" if pose else ""
    return (
        f"<inertial>{place}<mass>{mass:.9g}</mass><inertia><ixx>{x:.9g}</ixx><iyy>{y:.9g}</iyy><izz>{z:.9g}</izz><ixy>0</ixy><ixz>0</ixz>"
        "<iyz>0</iyz></inertia></inertial>"
    )


def box_moments(mass: float, x: float, y: float, z: float):
    return tuple(mass / 12 * (b * b + c * c) for b, c in ((y, z), (x, z), (x, y)))


def cylinder_moments(mass: float, radius: float, length: float):
    across = mass * (3 * radius * radius + length * length) / 12
    return across, across, mass * radius * radius / 2


def link(name: str, *parts: str, pose: str = "") -> str:
    place = f"<pose>{pose}</pose>" if pose else ""
    return f"<link name='{name}'>{place}{''.join(parts)}</link>"


def model(name: str, *parts: str, pose: str = "", static: bool = False) -> str:
    place = f"<pose>{pose}</pose>" if pose else ""
    return f"<model name='{name}'>{'<static>1</static>' if static else ''}{place}{''.join(parts)}</model>"


def axis(
    xyz: str, lower: float = -1e16, upper: float = 1e16, name: str = "axis", limit: str = "", of_model: bool = True, **dynamics
) -> str:
    """`dynamics`: damping, friction, spring_reference, spring_stiffness; `limit`: more children of <limit>."""
    frame = "<use_parent_model_frame>1</use_parent_model_frame>" if of_model else ""
    values = {"damping": 0, "friction": 0, **dynamics}
    return (
        f"<{name}><xyz>{xyz}</xyz>{frame}<limit><lower>{lower:.9g}</lower><upper>{upper:.9g}</upper>{limit}</limit>"
        f"<dynamics>{_elements(**values)}</dynamics></{name}>"
    )


def joint(name: str, kind: str, parent: str, child: str, *parts: str, pose: str = "") -> str:
    place = f"<pose>{pose}</pose>" if pose else ""
    return f"<joint name='{name}' type='{kind}'>{place}<parent>{parent}</parent><child>{child}</child>{''.join(parts)}</joint>"


def ground(mu: float = 100, mu2: float = 50) -> str:
    """The stock ground_plane's collision."""
    plane = "<plane><normal>0 0 1</normal><size>200 200</size></plane>"
    return model("ground", link("l", collision(plane, surface(mu, mu2))), static=True)


def solid(name: str, shape: str, mass: float, moments, pose: str, surfaces: str = "", static: bool = False, more: str = "") -> str:
    """A model of one link with one collision."""
    return model(name, link("l", inertial(mass, moments), collision(shape, surfaces), more), pose=pose, static=static)


def cube(name: str, side: float, mass: float, pose: str, surfaces: str = "", more: str = "") -> str:
    return solid(name, box(side, side, side), mass, mass * side * side / 6, pose, surfaces, more=more)


def ball(name: str, radius: float, mass: float, pose: str, surfaces: str = "", more: str = "") -> str:
    return solid(name, sphere(radius), mass, 0.4 * mass * radius * radius, pose, surfaces, more=more)


def on_slope(angle: float, along: float, height: float, x: float = 0.0, y: float = 0.0, z: float = 3.0, yaw: float = 0.0) -> str:
    """The pose of a body `along` (m, downhill) and `height` (m, off the middle) on a board at (x, y, z) that is tilted by `angle` (rad)."""
    ahead = along * math.cos(angle) + height * math.sin(angle)
    up = -along * math.sin(angle) + height * math.cos(angle)
    return f"{x + ahead * math.cos(yaw):.9g} {y + ahead * math.sin(yaw):.9g} {z + up:.9g} 0 {angle:.9g} {yaw:.9g}"


def board(
    name: str, angle: float, surfaces: str = "", size: str = "6 1 0.2", x: float = 0.0, y: float = 0.0, z: float = 3.0, yaw: float = 0.0
) -> str:
    shape = f"<box><size>{size}</size></box>"
    return model(name, link("l", collision(shape, surfaces or surface(1.0))), pose=f"{x} {y} {z} 0 {angle:.9g} {yaw:.9g}", static=True)
