#!/usr/bin/env python3
"""Writes the person that walks through worlds (walk.dae ...) as Collada files with a skin and an animation.

The files are found under the names of Gazebo's. The models person_standing and person_walking are the same person, still.
Run after a change: ``python3 make_people.py``.
"""

from pathlib import Path

import numpy as np
from ode_sim import math3
from person_body import COLOURS, bones, places, solids
from person_gaits import WALK, animations, standing, stride

HERE = Path(__file__).resolve().parent
_LEFT = (0, 1, 0)
#: Bone -> its x and its y axis at rest, in the axes of the person, as Gazebo's files have them: most bones lie along their y. Skins and
#: animations of those files fit ours by that, and plugins that turn a person count on those of the hips.
BONE_AXES = {
    "Hips": (_LEFT, (0, 0, 1)),
    "LHipJoint": ((-0.66, -0.41, -0.64), (0.30, 0.64, -0.71)),
    "RHipJoint": ((0.68, -0.39, 0.62), (0.30, -0.62, -0.73)),
    "LowerBack": (_LEFT, (0.2, 0, 0.98)),
    "Spine": (_LEFT, (0, 0, 1)),
    "Spine1": (_LEFT, (0, 0, 1)),
    "Neck": (_LEFT, (0.13, 0, 0.99)),
    "Neck1": (_LEFT, (-0.15, 0, 0.99)),
    "Head": (_LEFT, (-0.06, 0, 1)),
    "LeftShoulder": ((0.15, 0.26, -0.95), (-0.20, 0.95, 0.23)),
    "RightShoulder": ((-0.10, 0.34, 0.94), (-0.14, -0.94, 0.32)),
}
for _side, _sign in (("Left", 1), ("Right", -1)):
    BONE_AXES.update({f"{_side}{part}": ((0, -1, 0), (0, 0, -1)) for part in ("UpLeg", "Leg")})
    BONE_AXES.update({f"{_side}Foot": (_LEFT, (0.96, 0, -0.28)), f"{_side}ToeBase": (_LEFT, (1, 0, 0))})
    # Arms hang at rest; Gazebo's files have them stretched out to the sides.
    BONE_AXES.update({f"{_side}{part}": ((0, -1, 0), (0, 0, -1)) for part in ("Arm", "ForeArm", "Hand", "FingerBase", "HandIndex1")})
    BONE_AXES[f"{_side[0]}Thumb"] = ((-0.5 * _sign, -0.71, -0.5), (0.71, 0, -0.71))


def _axes(x, y):
    """Columns x, y, z; y is kept, x made square to it."""
    y = np.array(y, float) / np.linalg.norm(y)
    x = np.array(x, float) - np.dot(x, y) * y
    x /= np.linalg.norm(x)
    return np.column_stack([x, y, np.cross(x, y)])


AXES = {name: _axes(*pair) for name, pair in BONE_AXES.items()}

HEAD = [
    '<?xml version="1.0" encoding="utf-8"?>',
    '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">',
    "<asset><created>2024-01-01T00:00:00</created><modified>2024-01-01T00:00:00</modified>"
    '<unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>',
]


def text_of(rows, digits=4):
    return " ".join(f"{round(float(value), digits) + 0.0:g}" for value in np.asarray(rows).ravel())


def source(name, rows, stride, kind="float"):
    values = " ".join(rows) if kind in ("Name", "IDREF") else text_of(rows)
    parameters = (
        '<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>'
        if stride == 3
        else f'<param name="V" type="{"float4x4" if stride == 16 else kind.lower()}"/>'
    )
    count = np.size(rows)
    return (
        f'<source id="{name}"><{kind}_array id="{name}-array" count="{count}">{values}</{kind}_array><technique_common>'
        f'<accessor source="#{name}-array" count="{count // stride}" stride="{stride}">{parameters}</accessor>'
        "</technique_common></source>"
    )


def matrix(turn, place):
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = turn, place
    return result


def turned(roll, pitch, yaw):
    return np.array(math3.quat_to_matrix(math3.quat_from_rpy(roll, pitch, yaw)))


def local_poses(frame=None):
    """Name -> (4, 4) of each bone in its parent; at rest without a frame."""
    found = {}
    for name, parent, place in bones():
        angles = frame.turns.get(name, (0.0, 0.0, 0.0)) if frame else (0.0, 0.0, 0.0)
        if parent is None:
            facing = turned(0.0, 0.0, frame.facing) if frame else np.eye(3)
            found[name] = matrix(facing @ AXES[name], frame.root if frame else place)
        else:
            found[name] = matrix(AXES[parent].T @ turned(*angles) @ AXES[name], AXES[parent].T @ np.array(place, float))
    return found


def shading():
    effects = [
        f'<effect id="{name}-effect"><profile_COMMON><technique sid="common"><lambert>'
        f"<ambient><color>{text_of(rgb)} 1</color></ambient><diffuse><color>{text_of(rgb)} 1</color></diffuse>"
        "</lambert></technique></profile_COMMON></effect>"
        for name, rgb in COLOURS.items()
    ]
    materials = [f'<material id="{name}" name="{name}"><instance_effect url="#{name}-effect"/></material>' for name in COLOURS]
    return ["<library_effects>", *effects, "</library_effects>", "<library_materials>", *materials, "</library_materials>"]


def body():
    """The shape in the axes of the person, and of each corner the bone that it hangs on."""
    at = places()
    vertices, owners, triangles = [], [], {}
    for bone, colour, corners, faces in solids():
        triangles.setdefault(colour, []).append(faces + sum(map(len, vertices)))
        vertices.append(corners + at[bone])
        owners += [bone] * len(corners)
    return np.concatenate(vertices), owners, {colour: np.concatenate(faces) for colour, faces in triangles.items()}


def shape(vertices, triangles):
    lines = [
        '<library_geometries><geometry id="body" name="body"><mesh>',
        source("body-positions", vertices, 3),
        '<vertices id="body-vertices"><input semantic="POSITION" source="#body-positions"/></vertices>',
    ]
    for colour, faces in triangles.items():
        lines.append(
            f'<triangles material="{colour}" count="{len(faces)}"><input semantic="VERTEX" source="#body-vertices" offset="0"/>'
            f"<p>{' '.join(map(str, faces.ravel()))}</p></triangles>"
        )
    return lines + ["</mesh></geometry></library_geometries>"]


def skin(owners):
    names = [name for name, _, _ in bones()]
    at = places()
    inverse = [np.linalg.inv(matrix(AXES[name], at[name])) for name in names]
    return [
        '<library_controllers><controller id="person-skin"><skin source="#body">',
        f"<bind_shape_matrix>{text_of(np.eye(4))}</bind_shape_matrix>",
        source("skin-joints", names, 1, "Name"),
        source("skin-bind", inverse, 16),
        source("skin-weights", [1.0], 1),
        '<joints><input semantic="JOINT" source="#skin-joints"/><input semantic="INV_BIND_MATRIX" source="#skin-bind"/></joints>',
        f'<vertex_weights count="{len(owners)}"><input semantic="JOINT" source="#skin-joints" offset="0"/>'
        '<input semantic="WEIGHT" source="#skin-weights" offset="1"/>',
        f"<vcount>{' '.join('1' for _ in owners)}</vcount>",
        f"<v>{' '.join(f'{names.index(owner)} 0' for owner in owners)}</v>",
        "</vertex_weights></skin></controller></library_controllers>",
    ]


def animation(frames):
    lines = ["<library_animations>"]
    poses = [local_poses(frame) for _, frame in frames]
    times = [time for time, _ in frames]
    rest = local_poses()
    for name, parent, _ in bones():
        rows = np.array([pose[name] for pose in poses])
        if parent is not None and np.abs(rows - rest[name]).max() < 1e-9:
            continue
        key = f"{name}-motion"
        lines += [
            f'<animation id="{key}">',
            source(f"{key}-input", times, 1),
            source(f"{key}-output", rows, 16),
            source(f"{key}-interpolation", ["LINEAR"] * len(times), 1, "Name"),
            f'<sampler id="{key}-sampler"><input semantic="INPUT" source="#{key}-input"/>'
            f'<input semantic="OUTPUT" source="#{key}-output"/>'
            f'<input semantic="INTERPOLATION" source="#{key}-interpolation"/></sampler>',
            f'<channel source="#{key}-sampler" target="{name}/transform"/></animation>',
        ]
    return lines + ["</library_animations>"]


def scene():
    children = {}
    for name, parent, _ in bones():
        children.setdefault(parent, []).append(name)
    rest = local_poses()

    def node(name):
        return (
            f'<node id="{name}" name="{name}" sid="{name}" type="JOINT"><matrix sid="transform">{text_of(rest[name])}</matrix>'
            + "".join(node(child) for child in children.get(name, ()))
            + "</node>"
        )

    bind = "".join(f'<instance_material symbol="{name}" target="#{name}"/>' for name in COLOURS)
    return [
        '<library_visual_scenes><visual_scene id="scene" name="scene">',
        node("Hips"),
        '<node id="person" name="person" type="NODE"><instance_controller url="#person-skin"><skeleton>#Hips</skeleton>'
        f"<bind_material><technique_common>{bind}</technique_common></bind_material></instance_controller></node>",
        "</visual_scene></library_visual_scenes>",
        '<scene><instance_visual_scene url="#scene"/></scene>',
    ]


def still(frame):
    """The shape in the axes of the person, the hips over the origin, as a frame has it."""
    local, world = local_poses(frame), {}
    for name, parent, _ in bones():
        world[name] = local[name] if parent is None else world[parent] @ local[name]
    vertices, triangles = [], {}
    for bone, colour, corners, faces in solids():
        triangles.setdefault(colour, []).append(faces + sum(map(len, vertices)))
        turn = world[bone] @ matrix(AXES[bone].T, np.zeros(3))
        vertices.append(corners @ turn[:3, :3].T + turn[:3, 3])
    points = np.concatenate(vertices)
    points -= [frame.root[0], frame.root[1], points[:, 2].min()]
    return points, {colour: np.concatenate(faces) for colour, faces in triangles.items()}


def mesh_text(vertices, triangles):
    bind = "".join(f'<instance_material symbol="{name}" target="#{name}"/>' for name in COLOURS)
    return "\n".join(
        [
            *HEAD,
            *shading(),
            *shape(vertices, triangles),
            '<library_visual_scenes><visual_scene id="scene" name="scene">',
            '<node id="person" name="person"><instance_geometry url="#body"><bind_material><technique_common>'
            + bind
            + "</technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>",
            '<scene><instance_visual_scene url="#scene"/></scene></COLLADA>',
            "",
        ]
    )


def model_text(name, mesh, y, foot, moments):
    """As the model database has it: 80 kg on a flat foot, looking along -y."""
    ixx, iyy, izz = moments
    body = f"<pose>0 {y} 0.005 0 0 -1.570796</pose><geometry><mesh><uri>model://{name}/meshes/{mesh}.dae</uri></mesh></geometry>"
    return "\n".join(
        [
            '<?xml version="1.0"?>',
            '<sdf version="1.5">',
            f'  <model name="{name}">',
            '    <link name="link">',
            f"      <inertial><pose>0 {y} 0.95 0 0 0</pose><mass>80</mass><inertia><ixx>{ixx}</ixx><ixy>0</ixy><ixz>0</ixz><iyy>{iyy}</iyy>"
            f"<iyz>0</iyz><izz>{izz}</izz></inertia></inertial>",
            f'      <collision name="bottom"><pose>0 {y} 0.01 0 0 0</pose><geometry><box><size>{foot}</size></box></geometry></collision>',
            f'      <collision name="person">{body}</collision>',
            f'      <visual name="visual">{body}</visual>',
            "    </link>",
            "  </model>",
            "</sdf>",
            "",
        ]
    )


def still_models():
    """The two of the model database, see :func:`files`."""
    found = {}
    for name, mesh, frame, y, foot, moments in (
        ("person_standing", "standing", standing(0.4), -0.1, "0.5 0.35 0.02", (24.88, 25.73, 2.48)),
        ("person_walking", "walking", stride(WALK, 0.04, 0.0), 0, "0.35 0.75 0.02", (27.82, 24.88, 4.57)),
    ):
        folder = f"../../models/{name}/"
        found[f"{folder}meshes/{mesh}.dae"] = mesh_text(*still(frame))
        found[f"{folder}model.sdf"] = model_text(name, mesh, y, foot, moments)
        found[f"{folder}model.config"] = "\n".join(
            [
                '<?xml version="1.0"?>',
                "<model>",
                f"  <name>{name.replace('_', ' ')}</name>",
                '  <sdf version="1.5">model.sdf</sdf>',
                f"  <description>A person, {mesh}, that does not move.</description>",
                "</model>",
                "",
            ]
        )
    return found


def files():
    """Name of each file, seen from this directory -> its text."""
    vertices, owners, triangles = body()
    common = HEAD + shading() + shape(vertices, triangles) + skin(owners)
    people = {f"{name}.dae": "\n".join(common + animation(frames) + scene() + ["</COLLADA>", ""]) for name, frames in animations().items()}
    return {**people, **still_models()}


if __name__ == "__main__":
    for name, text in files().items():
        (HERE / name).parent.mkdir(parents=True, exist_ok=True)
        (HERE / name).write_text(text)
