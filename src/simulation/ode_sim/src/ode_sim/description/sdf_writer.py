"""Descriptions as SDF 1.6 text that Gazebo Classic opens: saved worlds, copied models."""

from __future__ import annotations

import math
import os
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from typing import Any

from ode_sim import math3
from ode_sim.description import model as d

_VERSION = "1.6"
_STOCK_SCRIPT = "file://media/materials/scripts/gazebo.material"


def model_text(model: d.Model) -> str:
    """``<sdf>`` with one model at ``model.pose``."""
    root = _root()
    _model(root, model)
    return _text(root)


def light_text(light: d.Light) -> str:
    """``<sdf>`` with one light."""
    root = _root()
    _light(root, light)
    return _text(root)


def world_text(world: d.World) -> str:
    """``<sdf>`` with a world; its ``state`` is written as Gazebo does when it saves."""
    root = _root()
    top = ET.SubElement(root, "world", name=world.name)
    _leaf(top, "gravity", world.gravity)
    _leaf(top, "magnetic_field", world.magnetic_field)
    if any(world.wind):
        _leaf(ET.SubElement(top, "wind"), "linear_velocity", world.wind)
    _physics(top, world.physics)
    scene = ET.SubElement(top, "scene")
    for tag in ("ambient", "background", "shadows", "grid"):
        _leaf(scene, tag, getattr(world.scene, tag))
    if world.scene.fog:
        for tag, value in vars(world.scene.fog).items():
            _leaf(scene, "fog/" + ("type" if tag == "kind" else tag), value)
    if world.scene.sky:
        ET.SubElement(scene, "sky")
    if any(world.spherical_coordinates):
        place = ET.SubElement(top, "spherical_coordinates")
        _leaf(place, "surface_model", "EARTH_WGS84")
        for tag, value in zip(("latitude_deg", "longitude_deg", "elevation", "heading_deg"), world.spherical_coordinates):
            _leaf(place, tag, value)
    for light in world.lights:
        _light(top, light)
    for road in world.scene.roads:
        _road(top, road)
    for model in world.models:
        _model(top, model)
    _plugins(top, world.plugins)
    if world.state is not None:
        _state(top, world.name, world.state)
    return _text(root)


def element_text(element: ET.Element) -> str:
    """A read element as it was written."""
    return ET.tostring(_plain(element), "unicode")


# ---------------------------------------------------------------------------------------------- elements


def _root() -> ET.Element:
    return ET.Element("sdf", version=_VERSION)


def _text(root: ET.Element) -> str:
    ET.indent(root)
    return '<?xml version="1.0"?>\n' + ET.tostring(root, "unicode") + "\n"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "1" if value else "0"
    if isinstance(value, float):
        return f"{value:.10g}"
    if isinstance(value, (tuple, list)):
        return " ".join(_value(item) for item in value)
    return str(value)


def _leaf(parent: ET.Element, path: str, value: Any, default: Any = None) -> None:
    """``value`` at ``path`` (tags with slashes, made where missing) below ``parent``, unless it is the default."""
    if value is None or (default is not None and value == default):
        return
    *above, tag = path.split("/")
    for step in above:
        found = parent.find(step)
        parent = ET.SubElement(parent, step) if found is None else found
    ET.SubElement(parent, tag).text = _value(value)


def _pose(parent: ET.Element, pose: d.Pose) -> None:
    if pose != d.Pose():
        _leaf(parent, "pose", tuple(float(v) for v in (*pose.p, *math3.to_rpy(pose))))


def _model(parent: ET.Element, model: d.Model) -> None:
    if model.actor is not None and model.actor.element is not None:
        _actor(parent, model, model.actor)
        return
    element = ET.SubElement(parent, "model", name=model.name)
    _pose(element, model.pose)
    _leaf(element, "static", model.static, False)
    _leaf(element, "self_collide", model.self_collide, False)
    _leaf(element, "enable_wind", model.enable_wind, False)
    _leaf(element, "allow_auto_disable", model.allow_auto_disable, True)
    for link in model.links:
        _link(element, link)
    for joint in model.joints:
        _joint(element, joint)
    _plugins(element, model.plugins)


def _actor(parent: ET.Element, model: d.Model, actor: d.Actor) -> None:
    """As it was written; files by names that are good everywhere."""
    assert actor.element is not None
    element = _plain(actor.element)
    element.set("name", model.name)
    for pose in element.findall("pose"):
        element.remove(pose)
    _pose(element, model.pose)
    paths = {"skin": [actor.skin], "animation": [animation.path for animation in actor.animations]}
    for tag, found in paths.items():
        for entry in element.iter(tag):
            name = entry.find("filename")
            text = (name.text or "").strip() if name is not None else ""
            path = next((path for path in found if "://" not in text and text and path.endswith(os.path.basename(text))), "")
            if name is not None and path:
                name.text = "file://" + path
    parent.append(element)


def _plugins(parent: ET.Element, plugins: Iterable[d.Plugin]) -> None:
    parent.extend(_plain(plugin.element) for plugin in plugins)


def _plain(element: ET.Element) -> ET.Element:
    """A copy of a read element that may be indented."""
    made = ET.Element(element.tag, dict(element.attrib))
    made.text, made.tail = element.text, None
    made.extend(_plain(child) for child in element)
    return made


def _link(parent: ET.Element, link: d.Link) -> None:
    element = ET.SubElement(parent, "link", name=link.name)
    _pose(element, link.pose)
    inertial = ET.SubElement(element, "inertial")
    _pose(inertial, link.inertial.pose)
    _leaf(inertial, "mass", link.inertial.mass)
    for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"):
        _leaf(inertial, "inertia/" + name, getattr(link.inertial, name))
    _leaf(element, "gravity", link.gravity, True)
    _leaf(element, "self_collide", link.self_collide)
    _leaf(element, "enable_wind", link.enable_wind)
    _leaf(element, "kinematic", link.kinematic, False)
    for name, voltage in link.batteries:
        _leaf(ET.SubElement(element, "battery", name=name), "voltage", voltage)
    _leaf(element, "velocity_decay/linear", link.linear_decay, 0.0)
    _leaf(element, "velocity_decay/angular", link.angular_decay, 0.0)
    for collision in link.collisions:
        _collision(element, collision)
    for visual in link.visuals:
        _visual(element, visual)
    _sensors(element, link.sensors)
    for light in link.lights:
        _light(element, light)


def _sensors(parent: ET.Element, sensors: Iterable[d.Sensor]) -> None:
    for sensor in sensors:
        made = _plain(sensor.element)
        for pose in made.findall("pose"):
            made.remove(pose)
        made.set("name", sensor.name)
        made.set("type", sensor.type)
        _pose(made, sensor.pose)
        parent.append(made)


def _collision(parent: ET.Element, collision: d.Collision) -> None:
    element = ET.SubElement(parent, "collision", name=collision.name)
    _pose(element, collision.pose)
    _geometry(element, collision.geometry)
    _leaf(element, "max_contacts", collision.max_contacts, 10)
    _leaf(element, "laser_retro", collision.laser_retro, 0.0)
    surface, usual = collision.surface, d.Surface()
    if surface == usual:
        return
    made = ET.SubElement(element, "surface")
    for path, name in (
        ("friction/ode/", "mu"),
        ("friction/ode/", "mu2"),
        ("friction/ode/", "fdir1"),
        ("friction/ode/", "slip1"),
        ("friction/ode/", "slip2"),
        ("contact/ode/", "kp"),
        ("contact/ode/", "kd"),
        ("contact/ode/", "max_vel"),
        ("contact/ode/", "min_depth"),
        ("contact/", "collide_bitmask"),
        ("contact/", "collide_without_contact"),
    ):
        _leaf(made, path + name, getattr(surface, name), getattr(usual, name))
    if math.isfinite(surface.surface_radius):  # there was a <torsional>
        for path, name in (
            ("coefficient", "torsional_mu"),
            ("use_patch_radius", "use_patch_radius"),
            ("patch_radius", "patch_radius"),
            ("surface_radius", "surface_radius"),
            ("ode/slip", "torsional_slip"),
        ):
            _leaf(made, "friction/torsional/" + path, getattr(surface, name))
    _leaf(made, "bounce/restitution_coefficient", surface.restitution, usual.restitution)
    _leaf(made, "bounce/threshold", surface.bounce_threshold, usual.bounce_threshold)


def _visual(parent: ET.Element, visual: d.Visual) -> None:
    element = ET.SubElement(parent, "visual", name=visual.name)
    _pose(element, visual.pose)
    _geometry(element, visual.geometry)
    if visual.material is not None:
        _material(element, visual.material)
    _leaf(element, "transparency", visual.transparency, 0.0)
    _leaf(element, "cast_shadows", visual.cast_shadows, True)
    _leaf(element, "laser_retro", visual.laser_retro, 0.0)


def _road(parent: ET.Element, road: d.Visual) -> None:
    element = ET.SubElement(parent, "road", name=road.name)
    assert isinstance(road.geometry, d.Ribbon)
    _leaf(element, "width", road.geometry.width)
    for point in road.geometry.points:
        _leaf(element, "point", point)
    if road.material is not None:
        _material(element, road.material)


def _geometry(parent: ET.Element, shape: d.Geometry) -> None:
    element = ET.SubElement(parent, "geometry")
    if shape is None:
        ET.SubElement(element, "empty")
        return
    made = ET.SubElement(element, type(shape).__name__.lower())
    if isinstance(shape, (d.Mesh, d.Heightmap)):
        _leaf(made, "uri", _uri(shape))
    if isinstance(shape, d.Heightmap):
        _ground(made, shape.layers)
    if isinstance(shape, d.Mesh):
        _leaf(made, "scale", shape.scale, (1.0, 1.0, 1.0))
        if shape.submesh:
            _leaf(made, "submesh/name", shape.submesh)
            _leaf(made, "submesh/center", shape.center)
    elif isinstance(shape, d.Polyline):
        for point in shape.points:
            _leaf(made, "point", point)
        _leaf(made, "height", shape.height)
    else:
        for name in ("size", "pos", "sampling", "radius", "length", "normal"):
            _leaf(made, name, getattr(shape, name, None))


def _ground(made: ET.Element, layers: tuple[d.GroundLayer, ...]) -> None:
    for layer in layers:
        texture = ET.SubElement(made, "texture")
        _leaf(texture, "diffuse", _uri(layer))
        _leaf(texture, "size", layer.size)
    for layer in layers[1:]:
        blend = ET.SubElement(made, "blend")
        _leaf(blend, "min_height", layer.min_height)
        _leaf(blend, "fade_dist", layer.fade)


def _uri(shape: d.Mesh | d.Heightmap | d.GroundLayer) -> str:
    """As it was written, where that names the file wherever it is read."""
    return shape.uri if "://" in shape.uri or not shape.path else "file://" + os.path.abspath(shape.path)


def _material(parent: ET.Element, material: d.Material) -> None:
    element = ET.SubElement(parent, "material")
    if material.name:
        script = ET.SubElement(element, "script")
        folder = _materials_folder(material.texture)
        if material.name.startswith("Gazebo/"):
            _leaf(script, "uri", _STOCK_SCRIPT)
        elif folder:  # where OGRE scripts and their pictures are by convention
            _leaf(script, "uri", f"file://{folder}/scripts")
            _leaf(script, "uri", f"file://{folder}/textures")
        _leaf(script, "name", material.name)
    for tag in ("ambient", "diffuse", "specular", "emissive"):
        _leaf(element, tag, getattr(material, tag))


def _materials_folder(texture: str) -> str | None:
    folder, last = os.path.split(os.path.dirname(texture))
    return folder if last == "textures" and os.path.isdir(os.path.join(folder, "scripts")) else None


def _light(parent: ET.Element, light: d.Light) -> None:
    element = ET.SubElement(parent, "light", name=light.name, type=light.type)
    _pose(element, light.pose)
    for tag in ("diffuse", "specular", "direction", "cast_shadows"):
        _leaf(element, tag, getattr(light, tag))
    for tag in ("range", "constant", "linear", "quadratic"):
        _leaf(element, "attenuation/" + tag, getattr(light, tag))
    if light.type == "spot":
        for tag, value in zip(("inner_angle", "outer_angle", "falloff"), light.spot):
            _leaf(element, "spot/" + tag, value)


def _joint(parent: ET.Element, joint: d.Joint) -> None:
    element = ET.SubElement(parent, "joint", name=joint.name, type=joint.type)
    _pose(element, joint.pose)
    _leaf(element, "parent", joint.parent)
    _leaf(element, "child", joint.child)
    for tag, axis in zip(("axis",) if joint.type == "screw" else ("axis", "axis2"), joint.axes):
        made = ET.SubElement(element, tag)
        _leaf(made, "xyz", axis.xyz)
        for name, path in (
            ("lower", "limit/"),
            ("upper", "limit/"),
            ("effort", "limit/"),
            ("velocity", "limit/"),
            ("damping", "dynamics/"),
            ("friction", "dynamics/"),
            ("spring_reference", "dynamics/"),
            ("spring_stiffness", "dynamics/"),
        ):
            _leaf(made, path + name, getattr(axis, name), getattr(d.Axis(), name))
    usual = d.Joint("", "", "", "")
    for path, name in (
        ("physics/ode/limit/erp", "limit_erp"),
        ("physics/ode/limit/cfm", "limit_cfm"),
        ("physics/ode/provide_feedback", "provide_feedback"),
        ("physics/ode/implicit_spring_damper", "implicit_spring_damper"),
        ("physics/ode/fudge_factor", "fudge_factor"),
    ):
        _leaf(element, path, getattr(joint, name), getattr(usual, name))
    for name in {"screw": ("thread_pitch",), "gearbox": ("gearbox_ratio", "gearbox_reference_body")}.get(joint.type, ()):
        _leaf(element, name, getattr(joint, name))
    _sensors(element, joint.sensors)


def _physics(parent: ET.Element, physics: d.Physics) -> None:
    element = ET.SubElement(parent, "physics", type="ode")
    for tag in ("max_step_size", "real_time_factor", "real_time_update_rate", "max_contacts"):
        _leaf(element, tag, getattr(physics, tag))
    _leaf(element, "ode/solver/type", physics.solver)
    for tag in ("iters", "precon_iters", "sor"):
        _leaf(element, "ode/solver/" + tag, getattr(physics, tag))
    for tag in ("cfm", "erp", "contact_max_correcting_vel", "contact_surface_layer"):
        _leaf(element, "ode/constraints/" + tag, getattr(physics, tag))


def _state(parent: ET.Element, world: str, state: d.WorldState) -> None:
    element = ET.SubElement(parent, "state", world_name=world)
    nanoseconds = round(state.sim_time * 1e9)
    _leaf(element, "sim_time", "{} {}".format(*divmod(nanoseconds, 1_000_000_000)))
    _leaf(element, "iterations", state.iterations)
    for model in state.models:
        made = ET.SubElement(element, "model", name=model.name)
        _pose(made, model.pose or d.Pose())
        for link in model.links:
            of_link = ET.SubElement(made, "link", name=link.name)
            _pose(of_link, link.pose)
            _leaf(of_link, "velocity", tuple(float(v) for v in (*link.linear, *link.angular)))
