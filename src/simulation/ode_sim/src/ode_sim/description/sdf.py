"""SDF 1.0 to 1.7 text to :class:`World`, :class:`Model` and :class:`Light`.

What Gazebo Classic reads with a warning is read here with a :class:`Problem`; what it would crash on, or what leaves no
sensible meaning, raises :class:`DescriptionError`. One bad model of a world is left out, the rest of the world loads.
"""
from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field, replace
from typing import Dict, Iterator, List, Optional, Sequence, Tuple

from ode_sim import math3
from ode_sim.description import materials
from ode_sim.description.finder import ResourceFinder
from ode_sim.description.model import (
    Axis, Box, Capsule, Collision, Cylinder, DescriptionError, Geometry, Heightmap, Inertial, Joint, Light, Link,
    LinkState, Material, Mesh, Model, ModelState, Physics, Plane, Plugin, Polyline, Pose, Problem, Scene, Sensor,
    Source, Sphere, Surface, Visual, World, WorldState)
from ode_sim.description.population import population
from ode_sim.description.sdf_document import first_entity, parse_sdf
from ode_sim.description.sdf_frames import model_frames, relative_to, world_frames
from ode_sim.description.xmlsource import is_true, source_of, text_of

_JOINT_TYPES = {"revolute": 1, "prismatic": 1, "fixed": 0, "ball": 0, "universal": 2, "revolute2": 2, "screw": 1,
                "gearbox": 2, "piston": 1}
_UNKNOWN_JOINTS_OF_OLD = {"hinge": "revolute", "slider": "prismatic", "hinge2": "revolute2"}


@dataclass
class _Parts:
    """A model while it is read: everything in its own frame M, nested models already merged in as ``sub::x``."""

    name: str
    element: ET.Element
    pose: Pose  # of M in whatever it is part of
    links: List[Link] = field(default_factory=list)
    joints: List[Joint] = field(default_factory=list)
    plugins: List[Plugin] = field(default_factory=list)
    frames: Dict[str, Pose] = field(default_factory=dict)  # X_M of links, joints, frames, for relative_to


class SdfReader:
    """Reads one file or text; collects :attr:`problems` on the way."""

    def __init__(self, finder: Optional[ResourceFinder] = None, base: str = ""):
        """:param base: directory that relative file names are tried in first."""
        self.finder = finder or ResourceFinder()
        self.base = base
        self.problems: List[Problem] = []

    # ------------------------------------------------------------------ values

    def warn(self, element: Optional[ET.Element], message: str, severity: str = "warning") -> None:
        problem = Problem(severity, message, source_of(element) if element is not None else Source())
        if problem not in self.problems:
            self.problems.append(problem)

    def numbers(self, element: Optional[ET.Element], default: Sequence[float]) -> Tuple[float, ...]:
        """As many numbers as ``default`` has; the default (with a warning) when they cannot be read."""
        text = text_of(element)
        if not text:
            return tuple(default)
        try:
            values = tuple(float(word) for word in text.split())
        except ValueError:
            values = ()
        if any(math.isnan(value) for value in values):
            raise DescriptionError(f"{source_of(element)}: '{text}' is not a number; give finite values")
        if len(values) < len(default):
            self.warn(element, f"'{text}' is not {len(default)} number{'s' * (len(default) > 1)}; "
                               f"using {' '.join(f'{v:g}' for v in default)}")
            return tuple(default)
        return values[:len(default)]

    def number(self, parent: Optional[ET.Element], path: str, default: float) -> float:
        return self.numbers(parent.find(path), (default,))[0] if parent is not None else default

    def vector(self, parent: Optional[ET.Element], path: str, default):
        return self.numbers(parent.find(path), default) if parent is not None else tuple(default)

    @staticmethod
    def boolean(parent: ET.Element, path: str, default: bool) -> bool:
        text = text_of(parent.find(path))
        return is_true(text) if text else default

    def rgba(self, parent: Optional[ET.Element], tag: str, default=None):
        element = parent.find(tag) if parent is not None else None
        if element is None or not text_of(element):
            return default
        words = text_of(element).split()
        return self.numbers(element, (0.0, 0.0, 0.0, 1.0)) if len(words) > 3 else \
            (*self.numbers(element, (0.0, 0.0, 0.0)), 1.0)

    def pose(self, element: Optional[ET.Element]) -> Pose:
        """The numbers of a ``<pose>``, whatever frame they are in."""
        text = text_of(element)
        if not text:
            return math3.IDENTITY
        if element.get("rotation_format") == "quat_xyzw":
            values = self.numbers(element, (0.0,) * 6 + (1.0,))
            return Pose(values[:3], math3.quat_normalize(values[3:]))
        if len(text.split()) == 3:
            return Pose(self.numbers(element, (0.0,) * 3))
        values = self.numbers(element, (0.0,) * 6)
        if element.get("degrees") is not None and is_true(element.get("degrees")):
            values = values[:3] + tuple(math.radians(v) for v in values[3:])
        if not all(math.isfinite(value) for value in values):
            raise DescriptionError(f"{source_of(element)}: '{text}' is not a pose; give finite values")
        return math3.from_rpy(*values)

    # ------------------------------------------------------------------ models

    def model(self, element: ET.Element) -> Model:
        parts = self._parts(element)
        static = self.boolean(element, "static", False)
        if not parts.links:
            raise DescriptionError(f"{source_of(element)}: has no <link>; a model needs at least one")
        if not static:
            for link in parts.links:
                self._check_inertial(link)
        return Model(name=parts.name, pose=parts.pose, links=tuple(parts.links), joints=tuple(parts.joints),
                     plugins=tuple(parts.plugins), static=static,
                     self_collide=self.boolean(element, "self_collide", False),
                     allow_auto_disable=self.boolean(element, "allow_auto_disable", True), source=source_of(element))

    @staticmethod
    def _check_inertial(link: Link) -> None:
        if not link.inertial.mass > 0.0 or math.isinf(link.inertial.mass):
            raise DescriptionError(f"{link.source}: mass {link.inertial.mass:g} kg; "
                                   "a link of a model that moves needs a positive, finite mass")

    def _parts(self, element: ET.Element) -> _Parts:
        name = element.get("name") or "__default__"
        parts = _Parts(name, element, self.pose(element.find("pose")))
        nested = [self._parts(child) for child in element.findall("model")]
        for include in element.findall("include"):
            included = self.include(include, getattr(element, "include_chain", ()))
            if included is not None and included.tag == "model":
                nested.append(self._parts(included))
            elif included is not None:
                self.warn(include, "only a model can be included into a model; left out")
        parts.frames = model_frames(self, element, [(sub.name, sub.element, sub.frames) for sub in nested])
        for link in element.findall("link"):
            if any(link.get("name") == other.name for other in parts.links):
                self.warn(link, "a link of this name is there already; this one is left out", "error")
                continue
            parts.links.append(self._link(link, parts.frames))
        for joint in element.findall("joint"):
            if any(joint.get("name") == other.name for other in parts.joints):
                self.warn(joint, "a joint of this name is there already; this one is left out", "error")
            else:
                parts.joints += self._joint(joint, parts, nested)
        for sub in nested:
            self._merge(parts, sub)
        parts.plugins += self.plugins(element)
        for gripper in element.findall("gripper"):
            self.warn(gripper, "the gripper element has no effect here; contact friction holds what is gripped")
        return parts

    @staticmethod
    def _merge(parts: _Parts, sub: _Parts) -> None:
        x_ms = parts.frames[sub.name]

        def scoped(name: str) -> str:
            return name if name == "world" else f"{sub.name}::{name}"

        for link in sub.links:
            parts.links.append(replace(link, name=scoped(link.name), pose=math3.compose(x_ms, link.pose)))
        for joint in sub.joints:
            parts.joints.append(replace(joint, name=scoped(joint.name), parent=scoped(joint.parent),
                                        child=scoped(joint.child)))
        parts.plugins += sub.plugins

    def plugins(self, parent: ET.Element) -> List[Plugin]:
        return [Plugin(name=(p.get("name") or "").strip(), filename=(p.get("filename") or "").strip(), element=p,
                       source=source_of(p)) for p in parent.findall("plugin")]

    # ------------------------------------------------------------------ links

    def _link(self, element: ET.Element, frames: Dict[str, Pose]) -> Link:
        name = element.get("name") or ""
        x_ml = frames[name]

        def in_link(child: ET.Element) -> Pose:
            pose = child.find("pose")
            x = self.pose(pose)
            frame = relative_to(pose)
            if not frame or frame == name:
                return x
            if frame not in frames:
                self.warn(pose, f"there is no frame '{frame}'; using that of link '{name}'")
                return x
            return math3.compose(math3.relative(x_ml, frames[frame]), x)

        collide = element.find("self_collide")
        return Link(
            name=name, pose=x_ml, inertial=self._inertial(element.find("inertial"), in_link),
            collisions=tuple(self._unique(element, "collision", lambda e: self._collision(e, in_link(e)))),
            visuals=tuple(self._unique(element, "visual", lambda e: self._visual(e, in_link(e)))),
            sensors=tuple(self._unique(element, "sensor", lambda e: self._sensor(e, in_link(e)))),
            lights=tuple(self._unique(element, "light", lambda e: replace(self.light(e), pose=in_link(e)))),
            gravity=self.boolean(element, "gravity", True),
            self_collide=is_true(text_of(collide)) if collide is not None else None,
            kinematic=self.boolean(element, "kinematic", False),
            linear_decay=self.number(element, "velocity_decay/linear", 0.0),
            angular_decay=self.number(element, "velocity_decay/angular", 0.0),
            source=source_of(element))

    def _unique(self, parent: ET.Element, tag: str, read) -> Iterator:
        """Children of one kind, with names made unique: Gazebo would drop the second of a name."""
        seen: Dict[str, int] = {}
        for element in parent.findall(tag):
            item = read(element)
            count = seen.get(item.name, 0)
            seen[item.name] = count + 1
            if count:
                self.warn(element, f"the name is used twice in this link; renamed '{item.name}_{count}'")
                item = replace(item, name=f"{item.name}_{count}")
            yield item

    def _inertial(self, element: Optional[ET.Element], in_link) -> Inertial:
        if element is None:
            return Inertial()
        values = {key: self.number(element, "inertia/" + key, default) for key, default in (
            ("ixx", 1.0), ("ixy", 0.0), ("ixz", 0.0), ("iyy", 1.0), ("iyz", 0.0), ("izz", 1.0))}
        return Inertial(mass=self.number(element, "mass", 1.0), pose=in_link(element), **values)

    def _collision(self, element: ET.Element, pose: Pose) -> Collision:
        return Collision(name=element.get("name") or "", pose=pose, geometry=self.geometry(element),
                         surface=self._surface(element.find("surface")),
                         max_contacts=int(self.number(element, "max_contacts", 10)),
                         laser_retro=self.number(element, "laser_retro", 0.0), source=source_of(element))

    def _visual(self, element: ET.Element, pose: Pose) -> Visual:
        return Visual(name=element.get("name") or "", pose=pose, geometry=self.geometry(element),
                      material=self.material(element.find("material")),
                      transparency=self.number(element, "transparency", 0.0),
                      cast_shadows=self.boolean(element, "cast_shadows", True),
                      laser_retro=self.number(element, "laser_retro", 0.0), source=source_of(element))

    def _sensor(self, element: ET.Element, pose: Pose) -> Sensor:
        return Sensor(name=element.get("name") or "", type=(element.get("type") or "").strip(), pose=pose,
                      element=element, update_rate=self.number(element, "update_rate", 0.0),
                      always_on=self.boolean(element, "always_on", False), plugins=tuple(self.plugins(element)),
                      source=source_of(element))

    def _surface(self, element: Optional[ET.Element]) -> Surface:
        if element is None:
            return Surface()
        default = Surface()
        ode = element.find("friction/ode")
        contact = element.find("contact/ode")
        torsion = element.find("friction/torsional/coefficient")
        bitmask = text_of(element.find("contact/collide_bitmask"))
        try:
            collide_bitmask = int(bitmask, 0) if bitmask else default.collide_bitmask
        except ValueError:
            self.warn(element.find("contact/collide_bitmask"), f"'{bitmask}' is no integer; using 65535")
            collide_bitmask = default.collide_bitmask
        return Surface(
            mu=self.number(ode, "mu", default.mu), mu2=self.number(ode, "mu2", default.mu2),
            fdir1=self.vector(ode, "fdir1", default.fdir1),
            slip1=self.number(ode, "slip1", 0.0), slip2=self.number(ode, "slip2", 0.0),
            torsional_mu=self.numbers(torsion, (1.0,))[0] if torsion is not None else None,
            kp=self.number(contact, "kp", default.kp), kd=self.number(contact, "kd", default.kd),
            max_vel=self.number(contact, "max_vel", default.max_vel),
            min_depth=self.number(contact, "min_depth", default.min_depth),
            restitution=self.number(element, "bounce/restitution_coefficient", default.restitution),
            bounce_threshold=self.number(element, "bounce/threshold", default.bounce_threshold),
            collide_bitmask=collide_bitmask,
            collide_without_contact=self.boolean(element, "contact/collide_without_contact", False))

    # ------------------------------------------------------------------ shapes and looks

    def geometry(self, parent: ET.Element) -> Geometry:
        element = parent.find("geometry")
        shape = next((child for child in element if child.tag != "empty"), None) if element is not None else None
        if shape is None:
            return None
        if shape.tag == "box":
            return Box(self._positive(shape, self.vector(shape, "size", (1.0, 1.0, 1.0))))
        if shape.tag == "sphere":
            return Sphere(*self._positive(shape, (self.number(shape, "radius", 1.0),)))
        if shape.tag in ("cylinder", "capsule"):
            kind = Cylinder if shape.tag == "cylinder" else Capsule
            return kind(*self._positive(shape, (self.number(shape, "radius", 1.0), self.number(shape, "length", 1.0))))
        if shape.tag == "plane":
            normal = math3.unit(self.vector(shape, "normal", (0.0, 0.0, 1.0)))
            return Plane(normal if any(normal) else (0.0, 0.0, 1.0), self.vector(shape, "size", (1.0, 1.0)))
        if shape.tag == "mesh":
            return self._mesh(shape)
        if shape.tag == "heightmap":
            uri = text_of(shape.find("uri"))
            return Heightmap(self._file(shape, uri), uri, self.vector(shape, "size", (1.0, 1.0, 1.0)),
                             self.vector(shape, "pos", (0.0, 0.0, 0.0)), int(self.number(shape, "sampling", 2)))
        if shape.tag == "polyline":
            return Polyline(tuple(self.numbers(p, (0.0, 0.0)) for p in shape.findall("point")),
                            self.number(shape, "height", 1.0))
        self.warn(shape, "this kind of geometry is not known here; left out")
        return None

    @staticmethod
    def _positive(shape: ET.Element, sizes: Tuple[float, ...]) -> Tuple[float, ...]:
        if any(size < 0.0 or not math.isfinite(size) for size in sizes):
            raise DescriptionError(f"{source_of(shape)}: size {' '.join(f'{s:g}' for s in sizes)}; "
                                   "sizes must be positive")
        return sizes

    def _mesh(self, shape: ET.Element) -> Mesh:
        uri = text_of(shape.find("uri")) or text_of(shape.find("filename"))
        return Mesh(path=self._file(shape, uri), uri=uri, scale=self.vector(shape, "scale", (1.0, 1.0, 1.0)),
                    submesh=text_of(shape.find("submesh/name")), center=self.boolean(shape, "submesh/center", False))

    def _file(self, element: ET.Element, uri: str) -> str:
        """Absolute path of a mesh or image, '' with a warning if it is not there."""
        found = self.finder.find(uri, os.path.dirname(getattr(element, "file", "")) or self.base) if uri else None
        if found and os.path.isfile(found):
            return found
        self.warn(element, f"cannot find '{uri}' (searched {self.finder.searched(uri)}); this shape is left out")
        return ""

    def material(self, element: Optional[ET.Element]) -> Optional[Material]:
        if element is None:
            return None
        name = text_of(element.find("script/name"))
        known = materials.gazebo_material(name, self.finder) if name else None
        if name and known is None:
            uris = [text_of(uri) for uri in element.findall("script/uri")]
            places = [self.finder.find(uri, self.base) for uri in uris]
            known = materials.script_material(name, [place for place in places if place])
            if known is None:
                self.warn(element, f"there is no material '{name}'"
                          + (f" in {', '.join(uris)}" if uris else "") + "; using white")
        colours = {tag: self.rgba(element, tag) for tag in ("ambient", "diffuse", "specular", "emissive")}
        given = {tag: colour for tag, colour in colours.items() if colour is not None}
        if known is None and not given:
            return Material(name) if name else None
        return replace(known or Material(name), **given)

    def light(self, element: ET.Element) -> Light:
        default = Light(name="")
        return Light(
            name=element.get("name") or "", type=(element.get("type") or "point").strip(),
            pose=self.pose(element.find("pose")), diffuse=self.rgba(element, "diffuse", default.diffuse),
            specular=self.rgba(element, "specular", default.specular),
            direction=self.vector(element, "direction", default.direction),
            range=self.number(element, "attenuation/range", default.range),
            constant=self.number(element, "attenuation/constant", default.constant),
            linear=self.number(element, "attenuation/linear", default.linear),
            quadratic=self.number(element, "attenuation/quadratic", default.quadratic),
            spot=(self.number(element, "spot/inner_angle", 0.0), self.number(element, "spot/outer_angle", 0.0),
                  self.number(element, "spot/falloff", 0.0)),
            cast_shadows=self.boolean(element, "cast_shadows", False), source=source_of(element))

    # ------------------------------------------------------------------ joints

    def _joint(self, element: ET.Element, parts: _Parts, nested: List[_Parts]) -> List[Joint]:
        name = element.get("name") or ""
        kind = (element.get("type") or "").strip()
        kind = _UNKNOWN_JOINTS_OF_OLD.get(kind, kind)
        if kind not in _JOINT_TYPES:
            self.warn(element, f"unknown joint type '{kind}'; use one of {', '.join(_JOINT_TYPES)}; "
                               "the joint is left out", "error")
            return []
        parent, child = (text_of(element.find(tag)) or text_of(element.find(tag + "/link"))
                         for tag in ("parent", "child"))
        known = {link.get("name") for link in parts.element.findall("link")}
        known |= {f"{sub.name}::{link.name}" for sub in nested for link in sub.links}
        for role, link in (("parent", parent), ("child", child)):
            if link not in known and link != "world":
                self.warn(element, f"{role} link '{link}' is not in model '{parts.name}'; the joint is left out", "error")
                return []
        if child == "world" or parent == child:
            self.warn(element, f"cannot join '{parent}' to '{child}'; the joint is left out", "error")
            return []
        pose = element.find("pose")
        reference = relative_to(pose) or child
        if reference not in parts.frames:
            self.warn(pose, f"there is no frame '{reference}'; using that of the child link")
            reference = child
        x_mj = math3.compose(parts.frames[reference], self.pose(pose))
        x_cj = math3.relative(parts.frames[child], x_mj)
        return [Joint(
            name=name, type=kind, parent=parent, child=child, pose=x_cj,
            axes=tuple(self._axes(element, kind, parts.frames, x_mj)),
            limit_erp=self.number(element, "physics/ode/limit/erp", 0.2),
            limit_cfm=self.number(element, "physics/ode/limit/cfm", 0.0),
            provide_feedback=self.boolean(element, "physics/provide_feedback",
                                          self.boolean(element, "physics/ode/provide_feedback", False)),
            implicit_spring_damper=self.boolean(element, "physics/ode/implicit_spring_damper",
                                                self.boolean(element, "physics/ode/cfm_damping", False)),
            fudge_factor=self.number(element, "physics/ode/fudge_factor", 1.0), source=source_of(element))]

    def _axes(self, element: ET.Element, kind: str, frames: Dict[str, Pose], x_mj: Pose) -> Iterator[Axis]:
        tags = ("axis", "axis2")[:_JOINT_TYPES[kind]]
        if kind == "revolute2" and element.find("axis2") is None:
            self.warn(element, "a revolute2 joint needs an <axis2>; using the z axis")
        for tag in tags:
            axis = element.find(tag)
            if axis is None:
                yield Axis()
                continue
            xyz_element = axis.find("xyz")
            xyz = self.numbers(xyz_element, (0.0, 0.0, 1.0))
            if math3.norm(xyz) == 0.0:
                self.warn(axis, "the axis has no length; using 0 0 1")
                xyz = (0.0, 0.0, 1.0)
            expressed_in = (xyz_element.get("expressed_in") or "").strip() if xyz_element is not None else ""
            if not expressed_in and self._in_model_frame(axis):
                expressed_in = "__model__"
            if expressed_in in frames:
                in_model = math3.rotate(frames[expressed_in], xyz)
                xyz = math3.quat_rotate(math3.quat_inverse(x_mj.q), in_model)
            elif expressed_in:
                self.warn(axis, f"there is no frame '{expressed_in}'; using that of the joint")
            lower, upper = self.number(axis, "limit/lower", -1e16), self.number(axis, "limit/upper", 1e16)
            if lower > upper:
                self.warn(axis, f"lower limit {lower:g} is above upper limit {upper:g}; switching the two")
                lower, upper = upper, lower
            yield Axis(xyz=math3.unit(xyz), lower=max(lower, -1e16), upper=min(upper, 1e16),
                       effort=self.number(axis, "limit/effort", -1.0),
                       velocity=self.number(axis, "limit/velocity", -1.0),
                       damping=self.number(axis, "dynamics/damping", 0.0),
                       friction=self.number(axis, "dynamics/friction", 0.0),
                       spring_reference=self.number(axis, "dynamics/spring_reference", 0.0),
                       spring_stiffness=self.number(axis, "dynamics/spring_stiffness", 0.0))

    @staticmethod
    def _in_model_frame(axis: ET.Element) -> bool:
        """How SDF 1.5 and 1.6 say it; up to 1.4 it is always so, and ``parse_sdf`` has inserted the element."""
        return is_true(text_of(axis.find("use_parent_model_frame")))

    # ------------------------------------------------------------------ worlds

    def world(self, element: ET.Element) -> World:
        models: List[Model] = []
        lights: List[Light] = []
        plugins = self.plugins(element)
        frames = world_frames(self, element)

        def add_model(source: ET.Element) -> None:
            try:
                model = self.model(source)
            except DescriptionError as error:
                self.warn(None, f"{error}; model '{source.get('name')}' is left out", "error")
                return
            if any(model.name == other.name for other in models):
                self.warn(source, f"a model named '{model.name}' is there already; this one is left out")
                return
            frame = relative_to(source.find("pose"))
            if frame in frames:
                model = replace(model, pose=math3.compose(frames[frame], model.pose))
            models.append(model)

        for child in element:
            if child.tag == "model":
                add_model(child)
            elif child.tag == "light":
                lights.append(self.light(child))
            elif child.tag == "include":
                included = self.include(child)
                if included is None:
                    continue
                if included.tag == "model":
                    add_model(included)
                elif included.tag == "light":
                    lights.append(self.light(included))
                else:
                    self.warn(child, "actors are not simulated; left out")
            elif child.tag == "population":
                template = child.find("model")
                if template is None and child.find("include") is not None:
                    template = self.include(child.find("include"))
                for copy in population(self, child, template):
                    add_model(copy)
            elif child.tag in ("actor", "road"):
                self.warn(child, f"{child.tag}s are not simulated; left out")
            elif child.tag == "joint":
                self.warn(child, "joints between models of a world file are not simulated; left out")
        state = self._state(element.find("state"))
        for inserted in element.findall("state/insertions/*"):
            if inserted.tag == "model":
                add_model(inserted)
            elif inserted.tag == "light":
                lights.append(self.light(inserted))
        coordinates = element.find("spherical_coordinates")
        default = World()
        return World(
            name=element.get("name") or "default",
            gravity=self.vector(element, "gravity", self.vector(element, "physics/gravity", default.gravity)),
            magnetic_field=self.vector(element, "magnetic_field", default.magnetic_field),
            physics=self._physics(element), scene=self._scene(element.find("scene")), models=tuple(models),
            lights=tuple(lights), plugins=tuple(plugins), state=state,
            spherical_coordinates=(self.number(coordinates, "latitude_deg", 0.0),
                                   self.number(coordinates, "longitude_deg", 0.0),
                                   self.number(coordinates, "elevation", 0.0),
                                   self.number(coordinates, "heading_deg", 0.0)),
            source=source_of(element))

    def _physics(self, world: ET.Element) -> Physics:
        blocks = world.findall("physics")
        if not blocks:
            return Physics()
        block = next((b for b in blocks if is_true(b.get("default", ""))), blocks[0])
        kind = (block.get("type") or "ode").strip()
        if kind != "ode":
            self.warn(block, f"the physics engine is ODE; '{kind}' is simulated by it, its own parameters are ignored")
        default = Physics()
        ode = block.find("ode")
        step = self.number(block, "max_step_size", self.number(block, "dt", default.max_step_size))
        if not 0.0 < step < math.inf:
            self.warn(block, f"max_step_size {step:g} must be positive; using {default.max_step_size:g}")
            step = default.max_step_size
        return Physics(
            max_step_size=step,
            real_time_update_rate=self.number(block, "real_time_update_rate",
                                              self.number(block, "update_rate", default.real_time_update_rate)),
            real_time_factor=self.number(block, "real_time_factor", default.real_time_factor),
            max_contacts=int(self.number(block, "max_contacts", default.max_contacts)),
            solver=text_of(ode.find("solver/type")) or default.solver if ode is not None else default.solver,
            iters=int(self.number(ode, "solver/iters", default.iters)),
            precon_iters=int(self.number(ode, "solver/precon_iters", default.precon_iters)),
            sor=self.number(ode, "solver/sor", default.sor),
            cfm=self.number(ode, "constraints/cfm", default.cfm),
            erp=self.number(ode, "constraints/erp", default.erp),
            contact_max_correcting_vel=self.number(ode, "constraints/contact_max_correcting_vel",
                                                   default.contact_max_correcting_vel),
            contact_surface_layer=self.number(ode, "constraints/contact_surface_layer",
                                              default.contact_surface_layer))

    def _scene(self, element: Optional[ET.Element]) -> Scene:
        if element is None:
            return Scene()
        default = Scene()
        return Scene(ambient=self.rgba(element, "ambient", default.ambient),
                     background=self.rgba(element, "background", default.background),
                     shadows=self.boolean(element, "shadows", True), grid=self.boolean(element, "grid", True),
                     sky=element.find("sky") is not None)

    def _state(self, element: Optional[ET.Element]) -> Optional[WorldState]:
        if element is None:
            return None

        def link_states(model: ET.Element, scope: str) -> Iterator[LinkState]:
            for link in model.findall("link"):
                velocity = self.vector(link, "velocity", (0.0,) * 6)
                yield LinkState(scope + (link.get("name") or ""), self.pose(link.find("pose")),
                                velocity[:3], velocity[3:])
            for sub in model.findall("model"):
                yield from link_states(sub, f"{scope}{sub.get('name')}::")

        time = (text_of(element.find("sim_time")) or "0").split()
        try:
            sim_time = float(time[0]) + (float(time[1]) * 1e-9 if len(time) > 1 else 0.0)
        except ValueError:
            self.warn(element.find("sim_time"), f"'{' '.join(time)}' is no time; starting from 0")
            sim_time = 0.0
        return WorldState(
            sim_time=sim_time, iterations=int(self.number(element, "iterations", 0)),
            models=tuple(ModelState(
                model.get("name") or "", self.pose(model.find("pose")) if model.find("pose") is not None else None,
                self.vector(model, "scale", (1.0, 1.0, 1.0)), tuple(link_states(model, "")))
                for model in element.findall("model")),
            light_poses=tuple((light.get("name") or "", self.pose(light.find("pose")))
                              for light in element.findall("light") if light.find("pose") is not None),
            deletions=tuple(text_of(name) for name in element.findall("deletions/name")))

    # ------------------------------------------------------------------ include, population

    def include(self, include: ET.Element, chain: Tuple[str, ...] = ()) -> Optional[ET.Element]:
        """The model, light or actor that an ``<include>`` stands for, changed as it says; None with a warning.

        :param chain: URIs that led here, outermost first.
        """
        uri = text_of(include.find("uri"))
        if uri in chain:
            self.warn(include, f"'{uri}' includes itself ({' > '.join(chain + (uri,))}); left out", "error")
            return None
        try:
            file = self.finder.find_model_sdf(uri, os.path.dirname(getattr(include, "file", "")) or self.base)
            if file is None:
                self.warn(include, f"cannot find '{uri}' (searched {self.finder.searched(uri)}); left out")
                return None
            with open(file, "rb") as stream:
                element = first_entity(parse_sdf(stream.read(), file))
        except (DescriptionError, OSError) as error:
            self.warn(include, f"{error}; '{uri}' is left out", "error")
            return None
        element.include_chain = chain + (uri,)
        return self._changed(element, include)

    @staticmethod
    def _changed(element: ET.Element, include: ET.Element) -> ET.Element:
        name = text_of(include.find("name"))
        if name:
            element.set("name", name)
        for tag in ("pose", "static"):
            override = include.find(tag)
            if override is not None:
                for old in element.findall(tag):
                    element.remove(old)
                element.insert(0, override)
        element.extend(include.findall("plugin"))
        return element
