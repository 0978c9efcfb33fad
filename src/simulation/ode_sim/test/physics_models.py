"""Hand-made models for the physics tests."""

from ode_sim.description.model import Axis, Box, Collision, Cylinder, Inertial, Joint, Link, Model, Plane, Pose, Sphere, Surface
from ode_sim.math3 import quat_from_rpy, quat_rotate


def box_inertia(mass, size, pose=Pose()):
    x, y, z = size
    return Inertial(mass, pose, mass * (y * y + z * z) / 12, 0, 0, mass * (x * x + z * z) / 12, 0, mass * (x * x + y * y) / 12)


def ground(roll=0.0, pitch=0.0, surface=Surface(mu=100.0, mu2=50.0)):
    """The ground plane, tilted if wanted: by its normal, as the pose of a model does not turn a plane."""
    collision = Collision("plane", Pose(), Plane(quat_rotate(quat_from_rpy(roll, pitch, 0), (0.0, 0.0, 1.0))), surface)
    return Model("ground_plane", Pose(), (Link("link", collisions=(collision,)),), static=True)


def box(name="box", at=(0, 0, 0.05), size=(0.1, 0.1, 0.1), mass=1.0, surface=Surface(), rpy=(0, 0, 0), static=False, **more):
    link = Link("link", inertial=box_inertia(mass, size), collisions=(Collision("box", Pose(), Box(size), surface),), **more)
    return Model(name, Pose(at, quat_from_rpy(*rpy)), (link,), static=static)


def sphere(name="ball", at=(0, 0, 1), radius=0.1, mass=1.0, surface=Surface(), **more):
    i = 0.4 * mass * radius * radius
    link = Link(
        "link", inertial=Inertial(mass, ixx=i, iyy=i, izz=i), collisions=(Collision("ball", Pose(), Sphere(radius), surface),), **more
    )
    return Model(name, Pose(at), (link,))


def pendulum(
    length=0.5, mass=1.0, damping=0.0, friction=0.0, inertia=0.01, name="pendulum", lower=-1e16, upper=1e16, axis=(0, 1, 0), **more
):
    """A link hinged to the world at (0, 0, 2), its centre of mass ``length`` below."""
    link = Link("bob", Pose(), Inertial(mass, Pose((0, 0, -length)), inertia, 0, 0, inertia, 0, inertia))
    joint = Joint("hinge", "revolute", "world", "bob", axes=(Axis(axis, lower, upper, damping=damping, friction=friction),), **more)
    return Model(name, Pose((0, 0, 2)), (link,), (joint,))


def arm(
    links=6,
    bolted=True,
    inertia=None,
    length=0.2,
    mass=1.0,
    effort=100.0,
    velocity=10.0,
    collide=True,
    at=(0, 0, 0),
    name="arm",
    damping=0.0,
    base_size=(0.3, 0.3, 0.1),
):
    """A base with a chain of links upwards, axes z, y, y, y ...; ``inertia``: kg m^2 of every link, None = that of its box."""

    def inertial(size, pose):
        if inertia is None:
            return box_inertia(mass, size, pose)
        return Inertial(mass, pose, inertia, 0, 0, inertia, 0, inertia)

    out, joints = [], []
    out.append(
        Link(
            "base",
            Pose((0, 0, base_size[2] / 2)),
            inertial(base_size, Pose()),
            (Collision("base", Pose(), Box(base_size)),) if collide else (),
        )
    )
    if bolted:
        joints.append(Joint("bolt", "fixed", "world", "base"))
    size, parent = (0.05, 0.05, length), "base"
    for i in range(links):
        middle = Pose((0, 0, length / 2))
        shape = (Collision(f"c{i}", middle, Box(size)),) if collide else ()
        out.append(Link(f"link{i}", Pose((0, 0, base_size[2] + i * length)), inertial(size, middle), shape))
        joints.append(
            Joint(
                f"j{i}",
                "revolute",
                parent,
                f"link{i}",
                axes=(Axis((0, 0, 1) if i == 0 else (0, 1, 0), -3.0, 3.0, effort, velocity, damping),),
            )
        )
        parent = f"link{i}"
    return Model(name, Pose(at), tuple(out), tuple(joints))


def gripper(effort=20.0, height=0.3, mu=1.0, lift_effort=200.0):
    """Two fingers under a carriage that slides up and down a mast bolted to the world. Fingers close along y."""
    rubber = Surface(mu=mu, mu2=mu)
    size = (0.02, 0.01, 0.06)
    carriage = Link("carriage", Pose((0, 0, height)), box_inertia(1.0, (0.2, 0.2, 0.02)))
    links, joints = [carriage], [Joint("lift", "prismatic", "world", "carriage", axes=(Axis((0, 0, 1), -1.0, 1.0, lift_effort, 1.0),))]
    for name, side in (("left", 1.0), ("right", -1.0)):
        links.append(
            Link(name, Pose((0, side * 0.1, height - 0.06)), box_inertia(0.05, size), (Collision("pad", Pose(), Box(size), rubber),))
        )
        joints.append(Joint(name, "prismatic", "carriage", name, axes=(Axis((0, -side, 0), 0.0, 0.1, effort, 0.5),)))
    return Model("gripper", Pose(), tuple(links), tuple(joints))


def diff_drive(wheel_radius=0.05, track=0.3, mass=5.0, at=(0, 0, 0), name="robot", mu=1.0):
    """A round robot on two wheels (axes y) and two frictionless casters."""
    rubber, slick = Surface(mu=mu, mu2=mu), Surface(mu=0.0, mu2=0.0)
    base = Link(
        "base",
        Pose((0, 0, wheel_radius + 0.02)),
        box_inertia(mass, (0.3, 0.25, 0.1)),
        (
            Collision("body", Pose((0, 0, 0.03)), Cylinder(0.14, 0.06)),
            Collision("front", Pose((0.12, 0, -wheel_radius)), Sphere(0.02), slick),
            Collision("back", Pose((-0.12, 0, -wheel_radius)), Sphere(0.02), slick),
        ),
    )
    links, joints = [base], []
    turned = Pose(q=quat_from_rpy(1.5707963267948966, 0, 0))
    for side, y in (("left", track / 2), ("right", -track / 2)):
        i = 0.3 * wheel_radius**2 / 2
        links.append(
            Link(
                side,
                Pose((0, y, wheel_radius)),
                Inertial(0.3, Pose(), i / 1.7, 0, 0, i, 0, i / 1.7),
                (Collision("tyre", turned, Cylinder(wheel_radius, 0.03), rubber),),
            )
        )
        joints.append(Joint(side, "revolute", "base", side, axes=(Axis((0, 1, 0)),)))
    return Model(name, Pose(at), tuple(links), tuple(joints))


def car_urdf(rear_steering=False, wheelbase=0.5, track=0.3, radius=0.06, chassis=6.0, extra=""):
    """URDF of a car: chassis ``base``, a knuckle (``<corner>_steer``, about z) and a wheel (``<corner>_wheel``, about y) at the
    steered corners, wheels alone at the others; corners are front_left ... rear_right. ``extra``: more links and joints."""

    def body(name, mass, tensor, collision=""):
        ixx, iyy, izz = tensor
        return (
            f'<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="{ixx}" iyy="{iyy}" izz="{izz}" ixy="0" '
            f'ixz="0" iyz="0"/></inertial>{collision}</link>'
        )

    shape = f'<collision><origin xyz="0 0 0.04"/><geometry><box size="{wheelbase} {track - 0.08} 0.06"/></geometry></collision>'
    out = [body("base", chassis, (0.07, 0.16, 0.2), shape)]
    tyre = f'<collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="{radius}" length="0.03"/></geometry></collision>'
    for end, x in (("front", wheelbase / 2), ("rear", -wheelbase / 2)):
        for side, y in (("left", track / 2), ("right", -track / 2)):
            name, parent, xyz = f"{end}_{side}", "base", f"{x} {y} 0"
            if end == "front" or rear_steering:
                out.append(body(f"{name}_knuckle", 0.2, (2e-4, 2e-4, 2e-4)))
                out.append(
                    f'<joint name="{name}_steer" type="revolute"><parent link="base"/><child link="{name}_knuckle"/>'
                    f'<origin xyz="{xyz}"/><axis xyz="0 0 1"/><limit lower="-0.8" upper="0.8" effort="20" velocity="5"/></joint>'
                )
                parent, xyz = f"{name}_knuckle", "0 0 0"
            out.append(body(f"{name}_tyre", 0.4, (4e-4, 7e-4, 4e-4), tyre))
            out.append(
                f'<joint name="{name}_wheel" type="continuous"><parent link="{parent}"/><child link="{name}_tyre"/>'
                f'<origin xyz="{xyz}"/><axis xyz="0 1 0"/><limit effort="10" velocity="100"/></joint>'
            )
    return f'<robot name="car">{"".join(out)}{extra}</robot>'
