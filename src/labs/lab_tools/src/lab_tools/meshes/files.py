"""Writers. What they write depends on the shapes alone, so a drawing gives the same file every time."""

import datetime

import collada
import numpy as np
import trimesh
from collada import geometry, material, scene, source

SHARP = np.cos(np.radians(35))  # neighbouring faces that differ by less share a shading normal


def save_stl(path, parts, scale=1.0):
    """Writes the solids `parts` to `path` as one binary STL, lengths times `scale`."""
    mesh = trimesh.util.concatenate(parts)
    mesh.apply_scale(scale)
    mesh.export(path)


def corner_normals(mesh):
    """Shading normals (F, 3, 3), one per corner of each face: smooth over curves, sharp at edges."""
    weighted = mesh.face_normals * mesh.area_faces[:, None]
    normals = np.empty((len(mesh.faces), 3, 3))
    around = mesh.vertex_faces  # (V, most) face indices, padded with -1
    for face, corners in enumerate(mesh.faces):
        for corner, vertex in enumerate(corners):
            near = around[vertex][around[vertex] >= 0]
            near = near[mesh.face_normals[near] @ mesh.face_normals[face] > SHARP]
            normal = weighted[near].sum(axis=0)
            normals[face, corner] = normal / np.linalg.norm(normal)
    return normals


def save_dae(path, coloured, scale=1.0):
    """Writes a COLLADA file in metres, z up, to `path`.

    :param coloured: dict of (red, green, blue) in 0..1 to a list of solids.
    :param scale: metres per unit of the drawing.
    """
    document = collada.Collada()
    document.assetInfo.upaxis = collada.asset.UP_AXIS.Z_UP
    document.assetInfo.unitname, document.assetInfo.unitmeter = "meter", 1.0
    document.assetInfo.created = document.assetInfo.modified = datetime.datetime(2000, 1, 1)
    nodes = []
    for index, (colour, parts) in enumerate(coloured.items()):
        mesh = trimesh.util.concatenate(parts)
        assert isinstance(mesh, trimesh.Trimesh)  # as its parts are
        mesh.apply_scale(scale)
        effect = material.Effect(
            "effect%d" % index,
            [],
            "phong",
            ambient=(*colour, 1.0),
            diffuse=(*colour, 1.0),
            specular=(0.15, 0.15, 0.15, 1.0),
            shininess=20.0,
        )
        paint = material.Material("material%d" % index, "material%d" % index, effect)
        document.effects.append(effect)
        document.materials.append(paint)
        normals = np.round(corner_normals(mesh).reshape(-1, 3), 4)
        normals, normal_index = np.unique(normals, axis=0, return_inverse=True)
        vertices = source.FloatSource("vertices%d" % index, np.round(mesh.vertices, 6).ravel(), ("X", "Y", "Z"))
        directions = source.FloatSource("normals%d" % index, normals.ravel(), ("X", "Y", "Z"))
        shape = geometry.Geometry(document, "geometry%d" % index, "geometry%d" % index, [vertices, directions])
        inputs = source.InputList()
        inputs.addInput(0, "VERTEX", "#" + vertices.id)
        inputs.addInput(1, "NORMAL", "#" + directions.id)
        indices = np.stack([mesh.faces.ravel(), normal_index], axis=1).ravel()
        shape.primitives.append(shape.createTriangleSet(indices, inputs, "paint"))
        document.geometries.append(shape)
        nodes.append(scene.GeometryNode(shape, [scene.MaterialNode("paint", paint, inputs=[])]))
    world = scene.Scene("scene", [scene.Node("part", children=nodes)])
    document.scenes.append(world)
    document.scene = world
    document.write(str(path))
