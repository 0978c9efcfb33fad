"""Models of SDF: links, joints, sensors, nested and included models."""

from __future__ import annotations

import math
import os
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from dataclasses import replace

from ode_sim import math3
from ode_sim.description.model import (
    FARTHEST,
    FORCE_TORQUE,
    Collision,
    DescriptionError,
    Inertial,
    Joint,
    Link,
    Model,
    Plugin,
    Pose,
    Sensor,
    Surface,
    Visual,
    quoted,
)
from ode_sim.description.sdf_document import first_entity, parse_sdf
from ode_sim.description.sdf_frames import model_frames, relative_to
from ode_sim.description.sdf_joints import Named, Parts, SdfJoints
from ode_sim.description.sdf_values import LONGEST
from ode_sim.description.xmlsource import clone, fault, is_true, read_bytes, source_of, text_of

#: kg or kg m^2. Homework has inertias of 1e8; far beyond, the solver's products overflow and what touches it is lost too
_HEAVIEST = 1e30
_STIFFEST = 1e30  # springs, dampers, friction: so large that nothing moves, and its product is still a number
_MOST_CONTACTS = 10_000_000
_HEARD = re.compile("topic|namespace|frame", re.IGNORECASE)  # elements of plugins that name what ROS hears
_DEEPEST = 20  # models that include one another


def _told_anew(sub: Parts) -> Parts:
    """With plugins that name links, joints and frames of a model in a model, included or not, as they are called in the outer one.

    A model of a rotor craft tells its plugins of ``rotor_0_joint``, which is ``iris::rotor_0_joint`` there: Gazebo's parser renames what is
    included, and gives plugins of what is written there the inner model.
    What ROS hears stays as it is written: topics, namespaces, frames.
    """
    names = {part.name for parts in (sub.links, sub.joints) for part in parts} - {"world"}

    def renamed(plugin: Plugin) -> Plugin:
        element = clone(plugin.element)
        for each in element.iter():
            if (each.text or "").strip() in names and not _HEARD.search(each.tag):
                each.text = f"{sub.name}::{(each.text or '').strip()}"
            for key, value in each.items():
                if value in names and each is not element:
                    each.set(key, f"{sub.name}::{value}")
        return replace(plugin, element=element)

    sub.plugins = [renamed(plugin) for plugin in sub.plugins]
    return sub


class SdfModels(SdfJoints):
    """Reads ``<model>`` and what an ``<include>`` stands for."""

    #: elements of all included and multiplied models: two of them that include the next one twice grow without end
    MOST_COPIED = 1_000_000
    _copied = 0

    def room_for(self, elements: int) -> bool:
        """Whether so many more elements may be included or copied; they are counted."""
        if self._copied + elements > self.MOST_COPIED:
            return False
        self._copied += elements
        return True

    def model(self, element: ET.Element) -> Model:
        """The model of ``element``, a ``<model>``. :raises DescriptionError: it has no link."""
        parts = self._parts(element)
        if not parts.links:
            raise fault(element, "has no <link>; a model needs at least one")
        static = self.boolean(element, "static", False) or len(parts.still) == len(parts.links)
        for i, link in enumerate(parts.links):
            parts.links[i] = self._with_checked_inertial(link, static or link.name in parts.still)
        if not static:  # what of it never moves hangs from the world
            parts.joints += [
                Joint(f"{link.name}::static", "fixed", "world", link.name, source=link.source)
                for link in parts.links
                if link.name in parts.still
            ]
        return Model(
            name=parts.name,
            pose=parts.pose,
            links=tuple(parts.links),
            joints=tuple(parts.joints),
            plugins=tuple(parts.plugins),
            static=static,
            self_collide=self.boolean(element, "self_collide", False),
            enable_wind=self.boolean(element, "enable_wind", False),
            allow_auto_disable=self.boolean(element, "allow_auto_disable", True),
            source=source_of(element),
        )

    def _with_checked_inertial(self, link: Link, static: bool) -> Link:
        """What never moves may have any mass, as saved worlds do; what moves needs one that ODE can use."""
        i = link.inertial
        values = (i.mass, i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz)
        finite = all(math.isfinite(v) for v in values)
        largest = max(abs(v) for v in values)
        if finite and i.mass > 0.0 and largest <= _HEAVIEST:
            return link
        if static:
            return replace(link, inertial=Inertial())
        raise DescriptionError(
            "mass and inertia must be finite numbers"
            if not finite
            else f"a mass or inertia of {largest:g}; what is heavier than {_HEAVIEST:g} would spoil the motion of all it touches"
            if largest > _HEAVIEST
            else f"mass {i.mass:g} kg; a link of a model that moves needs a positive mass",
            link.source,
        )

    def _parts(self, element: ET.Element) -> Parts:
        name = element.get("name") or "__default__"
        parts = Parts(name, element, self.pose(element.find("pose")))
        if element.get("placement_frame") or element.find("placement_frame") is not None:
            self.warn(element, "placement_frame is of SDF 1.8, Gazebo 11 does not know it: the pose is that of the model's own frame")
        nested = [_told_anew(self._parts(child)) for child in element.findall("model")]
        for include in element.findall("include"):
            included = self.include(include, getattr(element, "include_chain", ()))
            if included is not None and included.tag == "model":
                nested.append(_told_anew(self._parts(included)))
            elif included is not None:
                self.warn(include, "only a model can be included into a model; left out")
        nested = list(self._other_names(nested))
        parts.frames = model_frames(self, element, [(sub.name, sub.element, sub.frames) for sub in nested])
        for link in self._named_once(element, "link"):
            parts.links.append(self._link(link, parts.frames))
        known = {link.name for link in parts.links} | {f"{sub.name}::{link.name}" for sub in nested for link in sub.links}
        for joint in self._named_once(element, "joint"):
            parts.joints += self.joint(joint, parts, known)
        for sub in nested:
            if self.boolean(sub.element, "static", False):
                sub.still = {link.name for link in sub.links}
            self._merge(parts, sub)
        parts.plugins += self.plugins(element)
        for gripper in element.findall("gripper"):
            self.warn(gripper, "the gripper element has no effect here; contact friction holds what is gripped")
        return parts

    def _other_names(self, nested: list[Parts]) -> Iterator[Parts]:
        """Models in a model without those whose name another one before them has."""
        names: set[str] = set()
        for sub in nested:
            if sub.name in names:
                self.warn(sub.element, f"a model named '{quoted(sub.name)}' is there already; this one is left out", "error")
                continue
            names.add(sub.name)
            yield sub

    def _named_once(self, parent: ET.Element, tag: str) -> Iterator[ET.Element]:
        """Children of one kind without those whose name another one before them has."""
        names: set[str | None] = set()
        for element in parent.findall(tag):
            if element.get("name") in names:
                self.warn(element, f"a {tag} of this name is there already; this one is left out", "error")
                continue
            names.add(element.get("name"))
            yield element

    @staticmethod
    def _merge(parts: Parts, sub: Parts) -> None:
        x_ms = parts.frames[sub.name]

        def scoped(name: str) -> str:
            return name if name in ("", "world") else f"{sub.name}::{name}"

        for link in sub.links:
            parts.links.append(replace(link, name=scoped(link.name), pose=math3.compose(x_ms, link.pose)))
        parts.still |= {scoped(name) for name in sub.still}
        for joint in sub.joints:
            parts.joints.append(
                replace(
                    joint,
                    name=scoped(joint.name),
                    parent=scoped(joint.parent),
                    child=scoped(joint.child),
                    gearbox_reference_body=scoped(joint.gearbox_reference_body),
                )
            )
        parts.plugins += sub.plugins

    def plugins(self, parent: ET.Element) -> list[Plugin]:
        """The ``<plugin>``s that are children of ``parent``."""
        return [
            Plugin(name=(p.get("name") or "").strip(), filename=(p.get("filename") or "").strip(), element=p, source=source_of(p))
            for p in parent.findall("plugin")
        ]

    # ------------------------------------------------------------------ links

    def _link(self, element: ET.Element, frames: dict[str, Pose]) -> Link:
        name = element.get("name") or ""
        x_ml = frames[name]

        def in_link(child: ET.Element) -> Pose:
            return self._pose_in(element, x_ml, child, frames)

        for plugin in self.plugins(element):
            self.warn(
                plugin.element,
                f"{quoted(plugin.filename)}: a plugin inside a link is never started; write it into the "
                "model, or into a sensor (in a URDF: <gazebo> without reference)",
            )
        collide, blown = element.find("self_collide"), element.find("enable_wind")
        return Link(
            name=name,
            pose=x_ml,
            inertial=self._inertial(element.find("inertial"), in_link),
            collisions=tuple(self._unique(element, "collision", lambda e: self._collision(e, in_link(e)))),
            visuals=tuple(self._unique(element, "visual", lambda e: self._visual(e, in_link(e)))),
            sensors=tuple(self._unique(element, "sensor", lambda e: self._sensor(e, in_link(e), of_joint=False))),
            lights=tuple(self._unique(element, "light", lambda e: replace(self.light(e), pose=in_link(e)))),
            gravity=self.boolean(element, "gravity", True),
            self_collide=is_true(text_of(collide)) if collide is not None else None,
            kinematic=self.boolean(element, "kinematic", False),
            enable_wind=is_true(text_of(blown)) if blown is not None else None,
            batteries=tuple((e.get("name") or "", self.number(e, "voltage", 0.0)) for e in element.findall("battery")),
            linear_decay=self.number(element, "velocity_decay/linear", 0.0, most=_STIFFEST),
            angular_decay=self.number(element, "velocity_decay/angular", 0.0, most=_STIFFEST),
            source=source_of(element),
        )

    def _pose_in(self, owner: ET.Element, x_mo: Pose, child: ET.Element, frames: dict[str, Pose]) -> Pose:
        """X_OC of what a link or joint O has, which may be written relative to another frame."""
        pose = child.find("pose")
        x = self.pose(pose)
        frame = relative_to(pose)
        if not frame or frame == owner.get("name"):
            return x
        if frame not in frames:
            self.warn(pose, f"there is no frame '{quoted(frame)}'; using that of {owner.tag} '{quoted(owner.get('name'))}'")
            return x
        return math3.compose(math3.relative(x_mo, frames[frame]), x)

    def _unique(self, parent: ET.Element, tag: str, read: Callable[[ET.Element], Named]) -> Iterator[Named]:
        """Children of one kind, with names made unique: Gazebo would drop the second of a name."""
        items = []
        for element in parent.findall(tag):
            try:
                items.append((element, read(element)))
            except DescriptionError as error:  # the link is there without it, as in Gazebo
                self.warn(
                    error.source,
                    f"{error.message}; {tag} '{quoted(element.get('name'))}' of {parent.tag} '{quoted(parent.get('name'))}' is left out",
                )
        given = {item.name for _, item in items}
        seen: dict[str, int] = {}
        for element, item in items:
            count = seen.get(item.name, 0)
            if count:
                while f"{item.name}_{count}" in given:  # so is one that somebody else has
                    count += 1
                self.warn(element, f"the name is used twice in this {parent.tag}; renamed '{quoted(item.name)}_{count}'", "note")
            seen[item.name] = count + 1
            yield replace(item, name=f"{item.name}_{count}") if count else item

    def _inertial(self, element: ET.Element | None, in_link: Callable[[ET.Element], Pose]) -> Inertial:
        if element is None:
            return Inertial()
        values = {
            key: self.number(element, "inertia/" + key, default, nan=True)
            for key, default in (("ixx", 1.0), ("ixy", 0.0), ("ixz", 0.0), ("iyy", 1.0), ("iyz", 0.0), ("izz", 1.0))
        }
        try:
            pose = in_link(element)
        except DescriptionError as error:
            self.warn(error.source, f"{error.message}; the centre of mass is at the origin of the link")
            pose = math3.IDENTITY
        if is_true(element.get("auto") or ""):
            self.warn(element, "auto is of SDF 1.11; nothing is computed, write <mass> and <inertia>")
        return Inertial(mass=self.number(element, "mass", 1.0, nan=True), pose=pose, **values)

    def _collision(self, element: ET.Element, pose: Pose) -> Collision:
        return Collision(
            name=element.get("name") or "",
            pose=pose,
            geometry=self.geometry(element),
            surface=self._surface(element.find("surface")),
            max_contacts=self.whole(element, "max_contacts", 10, 0, _MOST_CONTACTS),
            laser_retro=self.number(element, "laser_retro", 0.0, most=1e30),
            source=source_of(element),
        )

    def _visual(self, element: ET.Element, pose: Pose) -> Visual:
        for plugin in self.plugins(element):
            self.warn(plugin.element, f"{quoted(plugin.filename)}: plugins of a visual have no effect; it is drawn without")
        return Visual(
            name=element.get("name") or "",
            pose=pose,
            geometry=self.geometry(element),
            material=self.material(element.find("material")),
            transparency=self.number(element, "transparency", 0.0, most=FARTHEST),
            cast_shadows=self.boolean(element, "cast_shadows", True),
            laser_retro=self.number(element, "laser_retro", 0.0, most=1e30),
            source=source_of(element),
        )

    def _sensor(self, element: ET.Element, pose: Pose, of_joint: bool) -> Sensor:
        kind = (element.get("type") or "").strip()
        if (kind == FORCE_TORQUE) != of_joint:
            raise fault(
                element,
                f"a sensor of type {quoted(kind) or '(none)'} belongs into a "
                + (
                    f"<link>; a joint takes {FORCE_TORQUE} alone"
                    if of_joint
                    else '<joint> (in a URDF: <gazebo reference="the joint\'s name">)'
                ),
            )
        for path, words in (("frame", ("child", "parent", "sensor")), ("measure_direction", ("child_to_parent", "parent_to_child"))):
            said = element.find(f"{FORCE_TORQUE}/{path}")
            if said is not None and text_of(said) not in words:
                self.warn(said, f"'{quoted(text_of(said))}' is none of {', '.join(words)}; {words[0]} is taken")
                said.text = words[0]
        return Sensor(
            name=element.get("name") or "",
            type=kind,
            pose=pose,
            element=element,
            update_rate=self.number(element, "update_rate", 0.0),
            always_on=self.boolean(element, "always_on", False),
            plugins=tuple(self.plugins(element)),
            source=source_of(element),
        )

    def _surface(self, element: ET.Element | None) -> Surface:
        if element is None:
            return Surface()
        default = Surface()
        ode = element.find("friction/ode")
        contact = element.find("contact/ode")
        torsion = element.find("friction/torsional")
        bitmask = text_of(element.find("contact/collide_bitmask"))
        try:
            collide_bitmask = int(bitmask, 0) if bitmask else default.collide_bitmask
        except ValueError:
            self.warn(element.find("contact/collide_bitmask"), f"'{quoted(bitmask)}' is no integer; using 65535")
            collide_bitmask = default.collide_bitmask
        return Surface(
            mu=self.number(ode, "mu", default.mu),
            mu2=self.number(ode, "mu2", default.mu2),
            fdir1=self.vector(ode, "fdir1", default.fdir1, most=LONGEST),
            slip1=self.number(ode, "slip1", 0.0),
            slip2=self.number(ode, "slip2", 0.0),
            torsional_mu=self.number(torsion, "coefficient", default.torsional_mu),
            torsional_slip=self.number(torsion, "ode/slip", 0.0),
            use_patch_radius=self.boolean(torsion, "use_patch_radius", True) if torsion is not None else True,
            patch_radius=self.number(torsion, "patch_radius", 0.0),
            surface_radius=self.number(torsion, "surface_radius", 0.0) if torsion is not None else default.surface_radius,
            kp=self.number(contact, "kp", default.kp),
            kd=self.number(contact, "kd", default.kd),
            max_vel=self.number(contact, "max_vel", default.max_vel),
            min_depth=self.number(contact, "min_depth", default.min_depth),
            restitution=self.number(element, "bounce/restitution_coefficient", default.restitution),
            bounce_threshold=self.number(element, "bounce/threshold", default.bounce_threshold),
            collide_bitmask=collide_bitmask,
            collide_without_contact=self.boolean(element, "contact/collide_without_contact", False),
        )

    # ------------------------------------------------------------------ joints

    # ------------------------------------------------------------------ include

    def include(self, include: ET.Element, chain: tuple[str, ...] = ()) -> ET.Element | None:
        """The model, light or actor that an ``<include>`` stands for, changed as it says; None with a warning.

        :param chain: URIs that led here, outermost first.
        """
        uri = text_of(include.find("uri"))
        if uri in chain or len(chain) >= _DEEPEST:
            what = "includes itself" if uri in chain else f"lies more than {_DEEPEST} models deep"
            self.warn(include, f"'{quoted(uri)}' {what} ({quoted(' > '.join(chain + (uri,)), 200)}); left out", "error")
            return None
        try:
            file = self.finder.find_model_sdf(uri, os.path.dirname(getattr(include, "file", "")) or self.base)
            if file is None:
                self.warn_missing(include, uri, "left out")
                return None
            root = parse_sdf(read_bytes(file), file)
            self.warn_of_text(root)
            element = first_entity(root)
        except DescriptionError as error:
            self.warn(include, f"{error}; '{quoted(uri)}' is left out", "error")
            return None
        if not self.room_for(sum(1 for _ in element.iter())):
            self.warn(include, f"the models included here have more than {self.MOST_COPIED} elements; '{quoted(uri)}' is left out", "error")
            return None
        if include.find("placement_frame") is not None or is_true(include.get("merge") or ""):
            what = "placement_frame is of SDF 1.8" if include.find("placement_frame") is not None else "merge is of SDF 1.9"
            self.warn(include, f"{what}, Gazebo 11 does not know it: the model is placed by its own frame, as a model of its own")
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
