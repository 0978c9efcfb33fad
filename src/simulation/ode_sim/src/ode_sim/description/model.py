"""The one description that every reader (URDF, SDF) produces and every consumer (physics, rendering, sensors) takes.

Conventions: SI units, REP-103 axes. A :class:`~ode_sim.math3.Pose` ``X_AB`` gives the pose of frame B measured and
expressed in A; ``p`` is ``p_AB`` in metres, ``q`` the unit quaternion of ``R_AB`` in the order x, y, z, w.
All records are frozen; they remember where they were written (:class:`Source`) so that a message can name file,
line and element. Defaults are those of sdformat 1.7 and Gazebo Classic's ODE engine.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

from ode_sim.errors import DescriptionError, Source, one_line, quoted  # noqa: F401  (part of the description)
from ode_sim.math3 import Pose, Quat, Vec3  # noqa: F401  (part of the description)

#: m. Nothing may lie farther from what it is placed in, or be larger: single precision is at its end there, and far
#: beyond so is the collision space of ODE.
FARTHEST = 1e7


@dataclass(frozen=True)
class Problem:
    """Something a reader noticed and went on (``warning``) or had to leave out (``error``)."""

    severity: str  # "note" (worth a line only to who looks for it) | "warning" | "error"
    message: str
    source: Source = Source()

    def __post_init__(self) -> None:
        object.__setattr__(self, "message", one_line(self.message))

    def __str__(self) -> str:
        return self.source.before(self.message)


# ---------------------------------------------------------------------------------------------- geometry


@dataclass(frozen=True)
class Box:
    size: Vec3 = (1.0, 1.0, 1.0)


@dataclass(frozen=True)
class Sphere:
    radius: float = 1.0


@dataclass(frozen=True)
class Cylinder:
    """Axis along z, centred on the origin."""

    radius: float = 1.0
    length: float = 1.0


@dataclass(frozen=True)
class Capsule:
    """Axis along z; ``length`` is that of the cylindrical part."""

    radius: float = 1.0
    length: float = 1.0


@dataclass(frozen=True)
class Plane:
    """Infinite for collision; ``size`` (x, y) is what is drawn."""

    normal: Vec3 = (0.0, 0.0, 1.0)
    size: tuple[float, float] = (1.0, 1.0)


@dataclass(frozen=True)
class Mesh:
    """``path`` is a resolved absolute file name ('' when it could not be found; ``uri`` says what was asked for)."""

    path: str
    uri: str = ""
    scale: Vec3 = (1.0, 1.0, 1.0)
    submesh: str = ""
    center: bool = False


@dataclass(frozen=True)
class GroundLayer:
    """One of the pictures on a height map, from the lowest ground up: an absolute image file ('': the ``colour`` 0..1 stands in for it),
    as wide as ``size`` m. It begins at ``min_height`` m above the map's lowest ground and covers what is below it from ``fade`` m higher
    on."""

    path: str
    size: float = 10.0
    min_height: float = 0.0
    fade: float = 0.0
    colour: tuple[float, float, float] = (1.0, 1.0, 1.0)
    uri: str = ""


@dataclass(frozen=True)
class Heightmap:
    path: str
    uri: str = ""
    size: Vec3 = (1.0, 1.0, 1.0)
    pos: Vec3 = (0.0, 0.0, 0.0)
    sampling: int = 2
    layers: tuple[GroundLayer, ...] = ()


@dataclass(frozen=True)
class Polyline:
    """Extruded along z from 0 to ``height``."""

    points: tuple[tuple[float, float], ...] = ()
    height: float = 1.0


@dataclass(frozen=True)
class Ribbon:
    """A strip of that width (m) along ``points``, seen from above. Roads are drawn as ribbons; nothing collides with one."""

    points: tuple[Vec3, ...] = ()
    width: float = 1.0


Geometry = Box | Sphere | Cylinder | Capsule | Plane | Mesh | Heightmap | Polyline | Ribbon | None

# ---------------------------------------------------------------------------------------------- looks

Rgba = tuple[float, float, float, float]


@dataclass(frozen=True)
class TextureUnit:
    """How an image lies on a surface. ``matrix`` a b c d e f takes the surface's texture coordinates, of which v runs downwards in the
    image, to (a u + b v + c, d u + e v + f). Beyond the image, ``address``: wrap, mirror, clamp or border (nothing). ``smooth``: between
    its pixels."""

    matrix: tuple[float, ...] = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
    address: str = "wrap"
    smooth: bool = True


@dataclass(frozen=True)
class Material:
    """Colours 0..1; ``None`` = not given. ``name`` is a Gazebo script name such as ``Gazebo/Red`` (already resolved into
    the colours where known); ``texture`` an absolute image file, '' if none."""

    name: str = ""
    ambient: Rgba | None = None
    diffuse: Rgba | None = None
    specular: Rgba | None = None
    emissive: Rgba | None = None
    texture: str = ""
    shininess: float = 0.0  # exponent of the highlight that ``specular`` makes; 0: there is none, as of an SDF's colours in Gazebo 11
    texture_unit: TextureUnit = TextureUnit()
    lighting: bool = True  # else it is white, or its texture, whatever shines
    #: with what is behind: "" by the colours' alpha, not the texture's; else OGRE's alpha_blend (by both), add, modulate, colour_blend, or
    #: replace (not at all)
    blend: str = ""
    alpha_above: float | None = None  # only pixels of a greater alpha are drawn


@dataclass(frozen=True)
class Visual:
    name: str
    pose: Pose  # X_LV, in the link frame
    geometry: Geometry
    material: Material | None = None  # None: the mesh's own, or white
    transparency: float = 0.0
    cast_shadows: bool = True
    laser_retro: float = 0.0
    source: Source = Source()


# ---------------------------------------------------------------------------------------------- physics


@dataclass(frozen=True)
class Surface:
    mu: float = 1.0
    mu2: float = 1.0
    fdir1: Vec3 = (0.0, 0.0, 0.0)
    slip1: float = 0.0
    slip2: float = 0.0
    torsional_mu: float = 1.0  # of friction against turning about the normal
    torsional_slip: float = 0.0  # rad/s for one N m
    use_patch_radius: bool = True  # else the radius of the patch follows from surface_radius and the depth; where both surfaces say so
    patch_radius: float = 0.0  # m; 0: touches in a point, and turns freely
    surface_radius: float = math.inf  # m, of the curvature where it touches; infinite: flat
    kp: float = 1e12
    kd: float = 1.0
    max_vel: float = 0.01
    min_depth: float = 0.0
    restitution: float = 0.0
    bounce_threshold: float = 1e5
    collide_bitmask: int = 0xFFFF
    collide_without_contact: bool = False


@dataclass(frozen=True)
class Collision:
    name: str
    pose: Pose  # X_LC, in the link frame
    geometry: Geometry
    surface: Surface = Surface()
    max_contacts: int = 10
    laser_retro: float = 0.0
    source: Source = Source()


@dataclass(frozen=True)
class Inertial:
    """``pose`` is X_LI: its origin is the centre of mass, its axes those of the tensor (kg m^2 about the CoM)."""

    mass: float = 1.0
    pose: Pose = Pose()
    ixx: float = 1.0
    ixy: float = 0.0
    ixz: float = 0.0
    iyy: float = 1.0
    iyz: float = 0.0
    izz: float = 1.0


@dataclass(frozen=True)
class Plugin:
    """``filename`` and ``name`` have surrounding white space removed. ``element`` is the whole ``<plugin>`` element."""

    name: str
    filename: str
    element: ET.Element = field(compare=False)
    source: Source = Source()


FORCE_TORQUE = "force_torque"  # the one type of sensor that a joint has, and no link


@dataclass(frozen=True)
class Sensor:
    """``type`` as in SDF (camera, depth, multicamera, ray, gpu_ray, imu, contact, force_torque ...). ``element`` is the
    whole ``<sensor>`` element in SDF form: each sensor reads its own block from it."""

    name: str
    type: str
    pose: Pose  # X_LS, in the link frame; of a joint's sensor X_JS, in the joint frame
    element: ET.Element = field(compare=False)
    update_rate: float = 0.0  # Hz of sim time, 0 = every step
    always_on: bool = False
    plugins: tuple[Plugin, ...] = ()
    source: Source = Source()


@dataclass(frozen=True)
class Light:
    name: str
    type: str = "point"  # point | directional | spot
    pose: Pose = Pose()
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    direction: Vec3 = (0.0, 0.0, -1.0)
    range: float = 10.0
    constant: float = 1.0
    linear: float = 1.0
    quadratic: float = 0.0
    spot: Vec3 = (0.0, 0.0, 0.0)  # inner angle, outer angle (rad), falloff
    cast_shadows: bool = False
    source: Source = Source()


@dataclass(frozen=True)
class Link:
    name: str
    pose: Pose = Pose()  # X_ML, in the model frame
    inertial: Inertial = Inertial()
    collisions: tuple[Collision, ...] = ()
    visuals: tuple[Visual, ...] = ()
    sensors: tuple[Sensor, ...] = ()
    lights: tuple[Light, ...] = ()
    gravity: bool = True
    self_collide: bool | None = None  # None: the model's
    kinematic: bool = False
    enable_wind: bool | None = None  # None: the model's
    batteries: tuple[tuple[str, float], ...] = ()  # names and voltages, V; plugins in C++ make something of them
    linear_decay: float = 0.0
    angular_decay: float = 0.0
    source: Source = Source()


@dataclass(frozen=True)
class Axis:
    """``xyz`` is a unit vector expressed in the joint frame. Angles rad, lengths m; effort N m or N; -1 = unlimited."""

    xyz: Vec3 = (0.0, 0.0, 1.0)
    lower: float = -1e16
    upper: float = 1e16
    effort: float = -1.0
    velocity: float = -1.0
    damping: float = 0.0
    friction: float = 0.0
    spring_reference: float = 0.0
    spring_stiffness: float = 0.0


@dataclass(frozen=True)
class Mimic:
    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True)
class Joint:
    """``type``: revolute (URDF continuous is revolute with +-1e16), prismatic, fixed, ball, universal, revolute2,
    screw, gearbox. ``pose`` is X_CJ, the joint frame in the **child** link frame. ``parent`` may be ``world``."""

    name: str
    type: str
    parent: str
    child: str
    pose: Pose = Pose()
    axes: tuple[Axis, ...] = ()
    limit_erp: float = 0.2
    limit_cfm: float = 0.0
    provide_feedback: bool = False
    implicit_spring_damper: bool = False
    fudge_factor: float = 1.0
    thread_pitch: float = 1.0  # of a screw, rad/m: by an angle the child goes -angle / thread_pitch along the axis
    gearbox_ratio: float = 1.0  # the child turns at -gearbox_ratio times the rate of the parent, each about its own axis
    gearbox_reference_body: str = ""  # link that both turn in
    mimic: Mimic | None = None  # from URDF; Gazebo drops it, a plugin may ask for it
    urdf_type: str = ""  # 'continuous' is told from 'revolute' by this; '' when the source was SDF
    sensors: tuple[Sensor, ...] = ()  # force_torque alone
    source: Source = Source()


@dataclass(frozen=True)
class Waypoint:
    time: float  # s
    pose: Pose  # in the world


@dataclass(frozen=True)
class Trajectory:
    """``type`` names the animation that is played on the way; without waypoints the actor is where that has it."""

    id: int
    type: str
    waypoints: tuple[Waypoint, ...] = ()
    tension: float = 0.0  # 0: a smooth curve, 1: straight from point to point


@dataclass(frozen=True)
class ActorAnimation:
    """``path`` is a resolved absolute file name. ``interpolate_x``: it goes on with the way walked, not with time."""

    name: str
    path: str
    scale: float = 1.0
    interpolate_x: bool = False


@dataclass(frozen=True)
class ActorScript:
    loop: bool = True
    delay_start: float = 0.0  # s
    auto_start: bool = True
    trajectories: tuple[Trajectory, ...] = ()


@dataclass(frozen=True)
class Actor:
    """What makes a model an ``<actor>``: it moves by a script. ``skin`` is a resolved file name, '' if none. ``element`` is the
    whole ``<actor>`` element."""

    skin: str = ""
    scale: float = 1.0
    animations: tuple[ActorAnimation, ...] = ()
    script: ActorScript = ActorScript()
    element: ET.Element | None = field(default=None, compare=False)


@dataclass(frozen=True)
class Model:
    name: str
    pose: Pose = Pose()  # X_WM
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[Plugin, ...] = ()
    static: bool = False
    self_collide: bool = False
    enable_wind: bool = False
    allow_auto_disable: bool = True
    actor: Actor | None = None  # its first link is the model's frame, then the bones of its skin
    source: Source = Source()

    @property
    def parts(self) -> tuple[Link | Joint, ...]:
        """Links and joints: what may have sensors."""
        return (*self.links, *self.joints)


@dataclass(frozen=True)
class Physics:
    max_step_size: float = 0.001  # s
    real_time_update_rate: float = 1000.0  # Hz of wall time, 0 = as fast as possible
    real_time_factor: float = 1.0  # stored, not enforced (as Gazebo Classic)
    max_contacts: int = 20
    solver: str = "quick"
    iters: int = 50
    precon_iters: int = 0
    sor: float = 1.3
    cfm: float = 0.0
    erp: float = 0.2
    contact_max_correcting_vel: float = 100.0
    contact_surface_layer: float = 0.001


@dataclass(frozen=True)
class LinkState:
    name: str
    pose: Pose  # X_WL
    linear: Vec3 = (0.0, 0.0, 0.0)
    angular: Vec3 = (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class ModelState:
    name: str
    pose: Pose | None = None  # X_WM
    scale: Vec3 = (1.0, 1.0, 1.0)
    links: tuple[LinkState, ...] = ()


@dataclass(frozen=True)
class WorldState:
    """The first ``<state>`` of a world file."""

    sim_time: float = 0.0
    iterations: int = 0
    models: tuple[ModelState, ...] = ()
    light_poses: tuple[tuple[str, Pose], ...] = ()
    deletions: tuple[str, ...] = ()


@dataclass(frozen=True)
class Fog:
    """``kind``: linear from ``start`` to ``end`` (m along the optical axis), or exp or exp2 of ``density`` (1/m); else there is none."""

    kind: str = ""
    color: Rgba = (1.0, 1.0, 1.0, 1.0)
    start: float = 1.0
    end: float = 100.0
    density: float = 1.0

    def __bool__(self) -> bool:
        return self.kind in ("exp", "exp2") or (self.kind == "linear" and self.end > self.start)


@dataclass(frozen=True)
class Scene:
    ambient: Rgba = (0.4, 0.4, 0.4, 1.0)
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
    shadows: bool = True
    grid: bool = True
    sky: bool = False
    fog: Fog = Fog()
    roads: tuple[Visual, ...] = ()  # ribbons, in the world frame

    @property
    def behind_all(self) -> tuple[float, float, float]:
        """The colour where nothing is; of a sky in place of Gazebo's moving clouds."""
        return (0.55, 0.70, 0.90) if self.sky else self.background[:3]


@dataclass(frozen=True)
class World:
    name: str = "default"
    gravity: Vec3 = (0.0, 0.0, -9.8)
    magnetic_field: Vec3 = (5.5645e-6, 22.8758e-6, -42.3884e-6)
    wind: Vec3 = (0.0, 0.0, 0.0)  # m/s; nothing is blown by it but what plugins blow
    physics: Physics = Physics()
    scene: Scene = Scene()
    models: tuple[Model, ...] = ()
    lights: tuple[Light, ...] = ()
    plugins: tuple[Plugin, ...] = ()
    state: WorldState | None = None
    spherical_coordinates: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)  # lat, lon (deg), elevation (m), heading (deg)
    source: Source = Source()
