"""What the stock models are made of: elements of SDF, shapes, a model of one link, and its files."""

from dataclasses import dataclass, field
from xml.sax.saxutils import escape

from make_meshes import SCALES

GAZEBO_SCRIPT = "file://media/materials/scripts/gazebo.material"


# ---------------------------------------------------------------------------------------------- pieces of SDF


def tag(kind, /, *content, **attributes):
    """One element; content that spans lines is indented."""
    opening = kind + "".join(f' {key}="{value}"' for key, value in attributes.items())
    inside = [str(item) for item in content if item != ""]
    if not inside:
        return f"<{opening}/>"
    if len(inside) == 1 and "<" not in inside[0]:
        return f"<{opening}>{inside[0]}</{kind}>"
    return "\n".join([f"<{opening}>"] + ["  " + line for item in inside for line in item.splitlines()] + [f"</{kind}>"])


def numbers(values):
    return " ".join(f"{value:.10g}" for value in values)


def box(x, y, z):
    return tag("box", tag("size", numbers((x, y, z))))


def cylinder(radius, length):
    return tag("cylinder", tag("radius", radius), tag("length", length))


def sphere(radius):
    return tag("sphere", tag("radius", radius))


def friction(mu, mu2=None):
    return tag("surface", tag("friction", tag("ode", tag("mu", mu), tag("mu2", mu if mu2 is None else mu2))))


def contact(torsional=False, **values):
    rolling = (
        tag("friction", tag("torsional", tag("coefficient", 1.0), tag("use_patch_radius", 0), tag("surface_radius", 0.01)))
        if torsional
        else ""
    )
    return tag("surface", rolling, tag("contact", tag("ode", *(tag(key, value) for key, value in values.items()))))


def script(name, *uris):
    return tag("material", tag("script", *(tag("uri", uri) for uri in uris or (GAZEBO_SCRIPT,)), tag("name", name)))


def colour(r, g, b):
    return tag("material", tag("ambient", numbers((r, g, b, 1))), tag("diffuse", numbers((r, g, b, 1))), tag("specular", "0.1 0.1 0.1 1"))


@dataclass
class Shape:
    """Something that collides, is seen, or both."""

    name: str
    geometry: str
    pose: tuple[float, ...] = ()
    material: str = ""
    surface: str = ""
    collides: bool = True
    seen: bool = True


@dataclass
class Model:
    """One link, as all of the stock models have."""

    title: str
    description: str
    shapes: tuple[Shape, ...]
    static: bool = False
    mass: float | None = None  # kg; None: what SDF takes when nothing is said, 1 kg and unit inertia
    inertia: tuple[float, float, float] = (1.0, 1.0, 1.0)  # kg m^2, the principal ones
    com: tuple[float, float, float] = (0.0, 0.0, 0.0)
    name: str = ""  # of the model in the world; '': as the directory
    link: str = "link"
    pose: tuple[float, ...] = ()
    link_pose: tuple[float, ...] = ()
    mesh: str = ""  # file below meshes/ that is seen
    mesh_pose: tuple[float, ...] = ()
    extra: str = ""  # sensors
    scripts: dict[str, tuple[float, float, float]] = field(default_factory=dict)  # OGRE materials that worlds name


def pose(values):
    return tag("pose", numbers(tuple(values) + (0.0,) * (6 - len(values)))) if values else ""


def box_inertia(mass, x, y, z):
    return (mass * (y * y + z * z) / 12, mass * (x * x + z * z) / 12, mass * (x * x + y * y) / 12)


def model_sdf(directory: str, model: Model) -> str:
    content = []
    if model.mass is not None:
        ixx, iyy, izz = model.inertia
        tensor = (("ixx", ixx), ("ixy", 0), ("ixz", 0), ("iyy", iyy), ("iyz", 0), ("izz", izz))
        content.append(
            tag(
                "inertial",
                pose(model.com) if any(model.com) else "",
                tag("mass", f"{model.mass:.10g}"),
                tag("inertia", *(tag(key, f"{value:.10g}") for key, value in tensor)),
            )
        )
    for shape in model.shapes:
        if shape.collides:
            content.append(tag("collision", pose(shape.pose), tag("geometry", shape.geometry), shape.surface, name=shape.name))
    for shape in model.shapes:
        if shape.seen and not model.mesh:
            content.append(
                tag(
                    "visual",
                    pose(shape.pose),
                    tag("geometry", shape.geometry),
                    shape.material,
                    name=shape.name + "_visual" if len(model.shapes) > 1 else "visual",
                )
            )
    if model.mesh:
        scale = SCALES.get(directory)
        content.append(
            tag(
                "visual",
                pose(model.mesh_pose),
                tag(
                    "geometry",
                    tag("mesh", tag("uri", f"model://{directory}/meshes/{model.mesh}"), tag("scale", numbers(scale)) if scale else ""),
                ),
                name="visual",
            )
        )
    content.append(model.extra)
    link = tag("link", pose(model.link_pose), *content, name=model.link)
    body = tag("model", tag("static", "true") if model.static else "", pose(model.pose), link, name=model.name or directory)
    return '<?xml version="1.0"?>\n' + tag("sdf", body, version="1.5") + "\n"


def model_config(model: Model) -> str:
    author = tag("author", tag("name", "noetic_labs"), tag("email", "noetic-labs@users.noreply.github.com"))
    return (
        '<?xml version="1.0"?>\n'
        + tag(
            "model",
            tag("name", model.title),
            tag("version", "1.0"),
            tag("sdf", "model.sdf", version="1.5"),
            author,
            tag("description", escape(model.description)),
        )
        + "\n"
    )


def ogre_script(materials) -> str:
    blocks = []
    for name, (r, g, b) in materials.items():
        blocks.append(
            f"material {name}\n{{\n  technique\n  {{\n    pass\n    {{\n      ambient {r} {g} {b} 1\n"
            f"      diffuse {r} {g} {b} 1\n      specular 0.1 0.1 0.1 1 5\n    }}\n  }}\n}}\n"
        )
    return "\n".join(blocks)
