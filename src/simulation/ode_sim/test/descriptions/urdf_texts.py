"""Robots of a few links as text, and what is asked of what is read from it."""

from ode_sim.description import ResourceFinder, read_urdf

FINDER = ResourceFinder(environment=False, stock="/nowhere", package_path=lambda name: None)
INERTIA = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'


def link(name, mass=1.0, body=""):
    inertial = f'<inertial><mass value="{mass}"/>{INERTIA}</inertial>' if mass is not None else ""
    return f'<link name="{name}">{inertial}{body}</link>'


def joint(name, parent, child, kind="fixed", xyz="0 0 0", rpy="0 0 0", body=""):
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{xyz}" rpy="{rpy}"/>{body}</joint>'
    )


def box(tag="collision", name=None, xyz="0 0 0"):
    named = f' name="{name}"' if name else ""
    return f'<{tag}{named}><origin xyz="{xyz}"/><geometry><box size="1 2 3"/></geometry></{tag}>'


LIMIT = '<limit lower="-1" upper="2" effort="3" velocity="4"/>'


def convert(*parts, file=""):
    return read_urdf('<robot name="r">' + "".join(parts) + "</robot>", finder=FINDER, file=file)


def names(items):
    return [item.name for item in items]


def one(items, name):
    (found,) = [item for item in items if item.name == name]
    return found


def messages(problems):
    return "\n".join(str(problem) for problem in problems)
