"""Mesh files written by the test, read back."""

import os
import re
import struct
import time
import warnings
import zipfile

import numpy as np
import pytest
from ode_sim import mesh
from ode_sim.description.model import DescriptionError, Mesh

CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
FACES = np.array(
    [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]]
)


def binary_stl(path, header=b"made by a test"):
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *CUBE[face].ravel(), 0) for face in FACES)
    path.write_bytes(header.ljust(80, b" ") + struct.pack("<I", len(FACES)) + records)
    return str(path)


def ascii_stl(path):
    lines = ["solid cube"]
    for face in FACES:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex {} {} {}".format(*CUBE[v]) for v in face] + ["endloop", "endfacet"]
    path.write_text("\n".join(lines + ["endsolid cube"]))
    return str(path)


def obj(path, material=""):
    lines = [material] + ["v {} {} {}".format(*v) for v in CUBE]
    path.write_text("\n".join(lines + ["f {} {} {}".format(*(face + 1)) for face in FACES]))
    return str(path)


DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><created>2020-01-01</created><modified>2020-01-01</modified><unit name="cm" meter="0.01"/>{up}</asset>
  <library_images><image id="img"><init_from>paint.png</init_from></image></library_images>
  <library_effects>
    <effect id="e-red"><profile_COMMON><technique sid="t"><lambert>
      <diffuse><color>1 0 0 1</color></diffuse></lambert></technique></profile_COMMON></effect>
    <effect id="e-paint"><profile_COMMON>
      <newparam sid="surf"><surface type="2D"><init_from>img</init_from></surface></newparam>
      <newparam sid="samp"><sampler2D><source>surf</source></sampler2D></newparam>
      <technique sid="t"><lambert><diffuse><texture texture="samp" texcoord="UV"/></diffuse></lambert></technique>
    </profile_COMMON></effect>
  </library_effects>
  <library_materials>
    <material id="red" name="red"><instance_effect url="#e-red"/></material>
    <material id="paint" name="paint"><instance_effect url="#e-paint"/></material>
  </library_materials>
  <library_geometries>
    <geometry id="tri" name="tri"><mesh>
      <source id="p"><float_array id="pa" count="12">0 0 0 100 0 0 0 100 0 0 0 100</float_array>
        <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/>
        <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
      <source id="uv"><float_array id="uva" count="6">0 0 1 0 0 1</float_array>
        <technique_common><accessor source="#uva" count="3" stride="2"><param name="S" type="float"/>
        <param name="T" type="float"/></accessor></technique_common></source>
      <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
      <triangles material="a" count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles>
      <triangles material="b" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
        <input semantic="TEXCOORD" source="#uv" offset="1" set="0"/><p>0 0 1 1 3 2</p></triangles>
    </mesh></geometry>
  </library_geometries>
  <library_visual_scenes><visual_scene id="s"><node id="n"><translate>0 0 10</translate>
    <instance_geometry url="#tri"><bind_material><technique_common>
      <instance_material symbol="a" target="#red"/><instance_material symbol="b" target="#paint"/>
    </technique_common></bind_material></instance_geometry></node></visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


@pytest.mark.parametrize("write, name", [(binary_stl, "c.stl"), (ascii_stl, "c.STL"), (obj, "c.obj")])
def test_cube_is_welded_and_closed(tmp_path, write, name):
    surface = mesh.load_surface(write(tmp_path / name))
    assert surface.vertices.shape == (8, 3) and surface.triangles.shape == (12, 3)
    properties = mesh.mass_properties(surface)
    assert properties.volume == pytest.approx(1.0)
    assert properties.centroid == pytest.approx([0.5, 0.5, 0.5])
    assert properties.inertia == pytest.approx(np.eye(3) / 6.0)


@pytest.mark.parametrize(
    "change",
    [
        str.upper,
        lambda text: text.replace("\n", "\r\n"),
        lambda text: " ".join(text.split()),
        lambda text: text.replace("0 0 0", "0.0E+00 0e0 -0.0"),
        lambda text: "\n\n  " + text,
        lambda text: text.replace("endsolid", "end of the"),
        lambda text: text.replace("\n", "\n\t"),
    ],
    ids=["capitals", "crlf", "one line", "exponents", "blank lines", "no end", "tabs"],
)
def test_ascii_stl_of_any_hand(tmp_path, change):
    """As Gazebo and RViz read them: words in any case (leqi), numbers as scanf does."""
    ascii_stl(tmp_path / "c.stl")
    text = (tmp_path / "c.stl").read_text()
    file = tmp_path / "d.STL"
    file.write_bytes(change(text).encode())
    assert len(mesh.load_surface(str(file)).triangles) == 12


@pytest.mark.parametrize("header", [b"made by a test", b"solid exported", b"SOLID", b"solid facet normal vertex"])
def test_binary_stl_with_bytes_to_spare(tmp_path, header):
    file = tmp_path / "c.stl"
    binary_stl(file, header)
    file.write_bytes(file.read_bytes() + b"ten bytes!")
    assert len(mesh.load_surface(str(file)).triangles) == 12


@pytest.mark.parametrize("header", [b"made by a test", b"solid exported"])
def test_an_stl_that_is_cut_off_says_so(tmp_path, header):
    file = tmp_path / "c.stl"
    binary_stl(file, header)
    file.write_bytes(file.read_bytes()[:-60])
    with pytest.raises(DescriptionError, match="cut off: it tells of 12 triangles and has 10"):
        mesh.load_surface(str(file))
    ascii_stl(tmp_path / "d.stl")
    text = (tmp_path / "d.stl").read_text()
    file.write_text(text[: text.rindex("vertex") + 9])
    with pytest.raises(DescriptionError, match="is cut off"):
        mesh.load_surface(str(file))


def test_an_obj_from_a_system_where_capitals_do_not_count(tmp_path):
    (tmp_path / "Part.MTL").write_text("NEWMTL a\nKD 1 0.5 0\nKa spectral x.rfl\nTr 0.25\nnewmtl b\nKd 0 0 1\nmap_Kd Textures\\GONE.png\n")
    file = tmp_path / "PART.OBJ"
    file.write_text("mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n")
    first, second = (part.material for part in mesh.load_visual(str(file)))
    assert first.diffuse == (1.0, 0.5, 0.0, 0.75) and second.diffuse == (0.0, 0.0, 1.0, 1.0)


def test_binary_stl_whose_header_says_solid(tmp_path):
    assert len(mesh.load_surface(binary_stl(tmp_path / "c.stl", b"solid exported")).triangles) == 12


def test_scale_and_mirror_keep_the_outside_outside(tmp_path):
    file = binary_stl(tmp_path / "c.stl")
    surface = mesh.load(Mesh(file, scale=(-2.0, 3.0, 0.5)))
    assert surface.vertices.min(axis=0) == pytest.approx([-2.0, 0.0, 0.0])
    a, b, c = (surface.vertices[surface.triangles[:, k]] for k in range(3))
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0 == pytest.approx(3.0)  # signed: faces look outwards


def test_sharp_edges_are_drawn_sharp(tmp_path):
    (part,) = mesh.load_visual(binary_stl(tmp_path / "c.stl"))
    assert len(part.vertices) == 24  # each corner once for each of its three faces
    assert np.abs(part.normals).max(axis=1) == pytest.approx(np.ones(24))


def test_smooth_surfaces_are_drawn_smooth(tmp_path):
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=3)
    file = tmp_path / "ball.stl"
    file.write_bytes(trimesh.exchange.stl.export_stl(ball))
    (part,) = mesh.load_visual(str(file))
    assert len(part.vertices) == len(ball.vertices)
    assert np.einsum("ij,ij->i", part.normals, part.vertices).min() > 0.999


def test_collada_unit_material_texture_and_node_pose(tmp_path):
    (tmp_path / "paint.png").write_bytes(b"only its name matters")
    file = tmp_path / "t.dae"
    file.write_text(DAE.format(up="<up_axis>Z_UP</up_axis>"))
    red, painted = mesh.load_visual(str(file), scale=(2.0, 2.0, 2.0))
    assert red.material.diffuse == (1.0, 0.0, 0.0, 1.0) and red.uv is None
    assert painted.material.texture == str(tmp_path / "paint.png")
    assert painted.uv[painted.triangles[0]] == pytest.approx(np.array([[0, 0], [1, 0], [0, 1]]))
    assert red.vertices[red.triangles[0]] == pytest.approx(np.array([[0, 0, 0.2], [2, 0, 0.2], [0, 2, 0.2]]))


def test_collada_up_axis_is_ignored_as_in_gazebo_classic(tmp_path):
    surfaces = []
    for axis in ("Y_UP", "Z_UP"):
        file = tmp_path / f"{axis}.dae"
        file.write_text(DAE.format(up=f"<up_axis>{axis}</up_axis>"))
        surfaces.append(mesh.load_surface(str(file)).vertices)
    assert np.array_equal(*surfaces)


@pytest.mark.parametrize(
    "faulty",
    [
        "<transparency> </transparency>",
        "<specular><color>white</color></specular>",
        "<emission><color/></emission>",
        "<shininess><float/></shininess>",
        "<ambient><colour>1 0 0 1</colour></ambient>",
        "<index_of_refraction><float>1 2</float></index_of_refraction>",
    ],
)
def test_a_shape_is_there_and_red_though_its_shader_is_faulty_as_in_gazebo(tmp_path, faulty):
    file = tmp_path / "t.dae"
    file.write_text(DAE.format(up="").replace("<diffuse><color>1 0 0", f"{faulty}<diffuse><color>1 0 0"))
    red, painted = mesh.load_visual(str(file))
    assert len(red.triangles) == len(painted.triangles) == 1
    assert red.material.diffuse == (1.0, 0.0, 0.0, 1.0)
    assert len(mesh.load_surface(str(file)).triangles) == 2


@pytest.mark.parametrize(
    "sound, written",
    [
        (b'<node id="n">', b"<node id=\"<STL_BINARY>\" name='<a&b>'>"),  # by Assimp, as in velodyne_description
        (b"<asset>", b"<asset><contributor><author>Tom & Jerry</author></contributor>"),
        (b'<?xml version="1.0"?>', b'<?xml version="1.0" encoding="utf-8"?><!-- M\xfcller -->'),
        (b'name="tri"', b'name="\xb5&_<1"'),
    ],
)
def test_what_an_exporter_did_not_escape_is_read_as_in_gazebo(tmp_path, sound, written):
    file = tmp_path / "t.dae"
    assert sound in DAE.format(up="").encode()
    file.write_bytes(DAE.format(up="").encode().replace(sound, written))
    assert len(mesh.load_visual(str(file))) == 2


def test_a_submesh_of_collada_is_a_node_by_its_name(tmp_path):
    """As in Gazebo; a shape's own name does where no node has it."""
    library = '<library_nodes><node id="b" name="Twig"><instance_geometry url="#tri"/></node></library_nodes>'
    scene = """<node id="a" name="Branch"><translate>1 0 0</translate><node id="d"><instance_geometry url="#tri"/></node></node>
               <node id="c" name="Bark"><instance_node url="#b"/><instance_geometry url="#tri"/></node></visual_scene>"""
    text = re.sub(r"<node .*</visual_scene>", scene, DAE.format(up=""), flags=re.DOTALL)
    text = text.replace("<library_visual_scenes>", library + "<library_visual_scenes>")
    file = tmp_path / "t.dae"
    file.write_text(text)
    for name, corners in (("Branch", [0.01]), ("Bark", [0.0]), ("Twig", [0.0]), ("tri", [0.01, 0.0, 0.0])):
        parts = mesh.load_visual(str(file), submesh=name)
        assert [part.vertices[:, 0].min() for part in parts[::2]] == pytest.approx(corners), name
    with pytest.raises(DescriptionError, match="no submesh 'Root', only Bark, Branch, Twig"):
        mesh.load_visual(str(file), submesh="Root")


def test_a_shader_without_its_colour_leaves_the_shape(tmp_path):
    file = tmp_path / "t.dae"
    file.write_text(DAE.format(up="").replace("<color>1 0 0 1</color>", ""))
    assert len(mesh.load_visual(str(file))) == 2


def test_obj_materials_polygons_and_negative_indices(tmp_path):
    (tmp_path / "m.mtl").write_text("newmtl blue sky\nKd 0 0 1\nd 0.5\n")
    file = tmp_path / "q.obj"
    file.write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl blue sky\nf -4 -3 -2 -1\n")
    (part,) = mesh.load_visual(str(file))
    assert part.material.diffuse == (0.0, 0.0, 1.0, 0.5) and len(part.triangles) == 2
    assert part.normals == pytest.approx(np.tile([0.0, 0.0, 1.0], (4, 1)))


def test_submesh_by_name_centred(tmp_path):
    file = tmp_path / "two.obj"
    file.write_text("o low\nv 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\no high\nv 0 0 5\nv 2 0 5\nv 0 2 5\nf 4 5 6\n")
    assert mesh.load_surface(str(file), submesh="high").vertices[:, 2].min() == 5.0
    centred = mesh.load_surface(str(file), submesh="high", center=True).vertices
    assert centred.min(axis=0) == pytest.approx([-1.0, -1.0, 0.0])
    with pytest.raises(DescriptionError, match="no submesh 'middle', only high, low"):
        mesh.load_surface(str(file), submesh="middle")


def test_a_submesh_of_obj_is_a_group_too(tmp_path):
    """As of car bodies that name their wheels so."""
    file = tmp_path / "car.obj"
    file.write_text("v 0 0 0\nv 2 0 0\nv 0 2 0\ng body paint\nf 1 2 3\nv 0 0 5\nv 2 0 5\nv 0 2 5\ng wheel\nf 4 5 6\no roof\nf 1 3 4\n")
    for name, corners in (("body", [0, 0, 0]), ("wheel", [5, 5, 5]), ("roof", [0, 0, 5]), ("car.obj", [0, 0, 0, 5, 5, 5])):
        assert sorted(mesh.load_surface(str(file), submesh=name).vertices[:, 2]) == corners, name


def test_read_once_until_the_file_changes(tmp_path):
    file = tmp_path / "c.stl"
    first = mesh.load_surface(binary_stl(file))
    assert mesh.load_surface(str(file)) is first
    file.write_bytes(file.read_bytes()[:80] + struct.pack("<I", 1) + file.read_bytes()[84:134])
    assert len(mesh.load_surface(str(file)).triangles) == 1
    with pytest.raises(ValueError):
        first.vertices[0, 0] = 9.0  # shared between callers


@pytest.mark.parametrize(
    "name, content",
    [
        ("a.stl", b""),
        ("b.stl", b"\0" * 84),
        ("c.stl", b"solid x\nvertex 1 2\n"),
        ("d.stl", b"random words"),
        ("e.dae", b"<COLLADA/>"),
        ("f.dae", b"nothing"),
        ("g.obj", b"f 1 2 3\n"),
        ("h.obj", b"v a b c\n"),
        ("i.step", b"ISO-10303-21;"),
        ("j.stl", b"x" * 80 + struct.pack("<I", 5) + b"cut off"),
        ("k.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ],
)
def test_a_broken_file_is_one_line_that_names_it(tmp_path, name, content):
    file = tmp_path / name
    file.write_bytes(content)
    with pytest.raises(DescriptionError) as caught:
        mesh.load_surface(str(file))
    assert str(file) in str(caught.value) and "\n" not in str(caught.value)


def test_a_missing_file_is_named():
    with pytest.raises(DescriptionError, match="nowhere/a.stl"):
        mesh.load(Mesh(path="", uri="nowhere/a.stl"))


# ---------------------------------------------------------------------------------------------- traps


def refused(path):
    begin = time.process_time()
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        with pytest.raises(DescriptionError) as error:
            mesh.load_surface(str(path))
        with pytest.raises(DescriptionError):
            mesh.load_visual(str(path))
    assert time.process_time() - begin < 1.5
    line = str(error.value)
    assert str(path) in line and "\n" not in line and len(line) < 400
    return line


def doctype(entities):
    return DAE.format(up="").replace("<COLLADA", f"<!DOCTYPE COLLADA [{entities}]>\n<COLLADA", 1)


BOMB = "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10 if i else "ha" * 50}">' for i in range(10))
NESTED = "<node>" * 500 + "</node>" * 500
DOUBLING = "".join(
    f'<node id="n{i}"><instance_node url="#n{i - 1}"/><instance_node url="#n{i - 1}"/></node>'
    if i
    else '<node id="n0"><instance_geometry url="#tri"/></node>'
    for i in range(40)
)


@pytest.mark.parametrize(
    "text, message",
    [
        (doctype(BOMB).replace("2020-01-01", "&a9;", 1), "declares the entity 'a0'"),
        (doctype('<!ENTITY a SYSTEM "file:///etc/hostname">').replace("2020-01-01", "&a;", 1), "declares the entity 'a'"),
        (doctype('<!ENTITY % a SYSTEM "file:///etc/hostname"> %a;'), "declares the entity 'a'"),
        (
            DAE.format(up="").replace("<library_geometries>", f"<library_nodes>{NESTED}</library_nodes><library_geometries>"),
            "nests more than 100 elements deep",
        ),
        (
            DAE.format(up="").replace("<library_geometries>", f"<library_nodes>{DOUBLING}</library_nodes><library_geometries>"),
            "its nodes stand for each other more than 50000 times",
        ),
        (
            DAE.format(up="").replace(
                "<library_geometries>", '<library_nodes><node id="n"><instance_node url="#n"/></node></library_nodes><library_geometries>'
            ),
            "node 'n' stands for itself",
        ),
        (doctype(BOMB).replace('<node id="n">', '<node id="<n>">'), "declares the entity 'a0'"),
        (DAE.format(up="").replace("<asset>", '<asset a="<">' + "<a b=" * 300_000 + "<a" + " " * 300_000), "is broken, "),
    ],
    ids=["bomb", "xxe", "parameter", "deep", "doubling", "circle", "bomb to be mended", "long to mend"],
)
def test_a_collada_file_that_is_a_trap_is_refused_at_once(tmp_path, text, message):
    path = tmp_path / "trap.dae"
    path.write_text(text)
    assert message in refused(path)


def test_a_zip_bomb_is_no_collada_file(tmp_path):
    path = tmp_path / "a.dae"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.dae", b" " * 100_000_000)
    assert "is a zip archive" in refused(path)
    path.write_bytes(DAE.format(up="").encode() + path.read_bytes())  # XML and archive at once
    assert "is a zip archive" in refused(path)


def stl(points, count=None):
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *points[3 * i : 3 * i + 9], 0) for i in range(0, len(points) // 3, 3))
    return b" " * 80 + struct.pack("<I", len(points) // 9 if count is None else count) + records


@pytest.mark.parametrize(
    "name, content",
    [
        ("inf.stl", stl([float("inf")] * 9)),
        ("nan.stl", stl([float("nan")] * 9)),
        ("far.stl", stl([3e38, 0, 0, 0, 3e38, 0, 0, 0, -3e38])),
        ("count.stl", stl([0.0] * 9, 4_000_000_000)),
        ("word.stl", b"solid x\nvertex 1 2 z\nvertex 1 2 3\nvertex 1 2 3\n"),
        ("short.stl", b"solid x\nvertex 1 2\nvertex 1\nvertex 1 2 3\n"),
        ("tiny.stl", stl([5e-324, 0, 0, 0, 1e-45, 0, 0, 0, 0])),
        ("far.obj", b"v 1e300 0 0\nv 0 1e300 0\nv 0 0 -1e308\nf 1 2 3\n"),
        ("inf.obj", b"v 1e999 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\n"),
        ("index.obj", b"v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 99999999999999999999999\n"),
        ("ragged.obj", b"v 1\nv 0 1\nv 0 0 1\nf 1 2 3\n"),
        ("vt.obj", b"v 1\nv 0 1\nv 0 0 1\nvt\nf 1/1 2/9 3/7\n"),
        ("words.obj", b"newmtl\nusemtl\nmtllib\no\nf\nv\nvt\nvn\n"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_numbers_that_are_none_or_too_large_are_refused_without_a_warning(tmp_path, name, content):
    path = tmp_path / name
    path.write_bytes(content)
    refused(path)


def test_normals_that_are_no_use_are_computed(tmp_path):
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nvt inf 0\nf 1/1/1 2/1/1 3/1/1\n")
    (part,) = mesh.load_visual(str(path))
    assert np.allclose(part.normals, [0, 0, 1]) and part.uv is None


@pytest.mark.parametrize("scale", [(1e-300, 1, 1), (0, 0, 0), (1e7, 1e7, 1e7), (-1, 1e3, 1e-1)])
def test_no_scale_is_worth_a_warning(tmp_path, scale):
    path = obj(tmp_path / "a.obj")
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        (part,) = mesh.load_visual(path, scale)
        if 0 not in scale and 1e-300 not in scale:
            assert np.isfinite(part.normals).all() and len(mesh.load_surface(path, scale).triangles) == 12


@pytest.mark.parametrize("scale", [(1, 1, float("inf")), (float("nan"), 1, 1), (-1e300, 1, 1)])
def test_a_scale_that_is_none_is_refused(tmp_path, scale):
    path = obj(tmp_path / "a.obj")
    for load in (mesh.load_surface, mesh.load_visual):
        with pytest.raises(DescriptionError, match="a.obj: scale .* makes sense"):
            load(path, scale)


def test_files_that_are_too_large_are_refused(tmp_path, monkeypatch):
    from ode_sim import mesh_files

    path = tmp_path / "a.stl"
    binary_stl(path)
    monkeypatch.setattr(mesh_files, "MOST_TRIANGLES", 11)
    assert "triangles; reduce them" in refused(path)
    monkeypatch.setattr(mesh_files, "MOST_BYTES", 100)
    path.write_bytes(path.read_bytes() + b" ")
    assert "is larger than" in refused(path)
    os.mkfifo(tmp_path / "pipe.obj")
    assert "is no file" in refused(tmp_path / "pipe.obj")


def test_materials_of_a_mesh_may_be_rubbish(tmp_path):
    (tmp_path / "m.mtl").write_bytes(b"newmtl\nKd\nnewmtl a\nmap_Kd\n")
    path = tmp_path / "a.obj"
    path.write_text("mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(mesh.load_visual(str(path))) == 1
