"""Where files are looked for, and in which order."""

import time

import pytest
from ode_sim.description import DescriptionError, read_model
from ode_sim.description.finder import ResourceFinder, find_ros_package
from ode_sim.description.materials import script_material


def touch(path):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("<model><sdf version='1.6'>model.sdf</sdf></model>" if path.name == "model.config" else "x")
    return str(path)


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in ("GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH", "ROS_PACKAGE_PATH", "ODE_SIM_STOCK_PATH", "CMAKE_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_model_paths_in_gazebos_order(home, monkeypatch):
    monkeypatch.setenv("GAZEBO_MODEL_PATH", f"{home}/first::{home}/second")
    finder = ResourceFinder([home / "exported"], stock=str(home / "stock"))
    assert finder.model_paths == [
        f"{home}/home/.gazebo/models",
        f"{home}/first",
        f"{home}/second",
        f"{home}/exported",
        f"{home}/home/model_editor_models",
        f"{home}/home/building_editor_models",
        f"{home}/stock/models",
    ]
    for folder in ("stock/models", "home/model_editor_models", "exported", "second", "first", "home/.gazebo/models"):
        expected = touch(home / folder / "m/mesh.dae")
        assert finder.find("model://m/mesh.dae") == expected  # each new one hides the ones before


def test_what_was_installed_for_gazebo_into_a_prefix_is_found(home, monkeypatch):
    monkeypatch.setenv("CMAKE_PREFIX_PATH", f"{home}/empty:{home}/prefix")
    model = touch(home / "prefix/share/gazebo-11/models/m/mesh.dae")
    world = touch(home / "prefix/share/gazebo-11/worlds/a.world")
    finder = ResourceFinder(stock="")
    assert finder.find("model://m/mesh.dae") == model and finder.find_world("worlds/a.world") == world
    assert finder.resource_paths == [f"{home}/prefix/share/gazebo-11"]
    assert ResourceFinder(stock="", environment=False).find("model://m/mesh.dae") is None


def test_a_model_uri_with_three_slashes(home):
    expected = touch(home / "models/m/a.dae")
    assert ResourceFinder([home / "models"], stock="").find("model:///m/a.dae") == expected


def test_files_by_path_by_resource_path_and_beside_the_file_that_names_them(home, monkeypatch):
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", f"{home}/r")
    finder = ResourceFinder(stock="")
    absolute = touch(home / "elsewhere/a.world")
    assert finder.find(absolute) == finder.find("file://" + absolute) == absolute
    assert finder.find("worlds/b.world") is None
    in_media = touch(home / "r/media/models/worlds/b.world")
    assert finder.find("worlds/b.world") == in_media
    in_resources = touch(home / "r/worlds/b.world")
    assert finder.find("file://worlds/b.world") == in_resources
    here = touch(home / "worlds/b.world")
    assert finder.find_world("worlds/b.world") == here
    beside = touch(home / "elsewhere/worlds/b.world")
    assert finder.find("worlds/b.world", base=str(home / "elsewhere")) == beside


def test_packages(home, monkeypatch):
    touch(home / "ws/src/group/pkg/package.xml")
    mesh = touch(home / "ws/src/group/pkg/meshes/a b.stl")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{home}/nothing:{home}/ws/src")
    assert find_ros_package("pkg") == f"{home}/ws/src/group/pkg" and find_ros_package("other") is None
    finder = ResourceFinder(stock="")
    assert finder.find("package://pkg/meshes/a%20b.stl") == mesh
    assert finder.find("package://other/meshes/a.stl") is None
    assert finder.explain("package://other/meshes/a.stl") == "there is no ROS package 'other'"
    given = ResourceFinder(stock="", package_path={"other": str(home / "ws/src/group/pkg")}.get)
    assert given.find("package://other/meshes/a%20b.stl") == mesh


def test_a_file_of_a_package_that_is_named_by_another_path_is_told(home, monkeypatch):
    """Worlds saved with a robot name its meshes as the author's machine had them."""
    touch(home / "ws/src/pkg/package.xml")
    touch(home / "ws/src/pkg/meshes/a b.stl")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{home}/ws/src")
    finder = ResourceFinder(stock="")
    told = "no such file; package://pkg/meshes/a%20b.stl is one, on any machine that has the package"
    assert finder.explain("/home/author/ws/src/pkg/meshes/a b.stl") == finder.explain("file:///home/author/pkg/meshes/a%20b.stl") == told
    assert finder.explain("/home/author/ws/src/pkg/meshes/b.stl") == finder.explain("/home/author/meshes/a b.stl") == "no such file"
    assert finder.explain("model://pkg/meshes/a b.stl").endswith(
        f"; the ROS package 'pkg' has it: name its parent in GAZEBO_MODEL_PATH, export GAZEBO_MODEL_PATH=$GAZEBO_MODEL_PATH:{home}/ws/src"
    )
    assert "ROS package" not in finder.explain("model://pkg/meshes/b.stl")


def test_packages_may_be_models(home):
    expected = touch(home / "models/pkg/a.stl")
    assert ResourceFinder([home / "models"], stock="").find("package://pkg/a.stl") == expected


def test_model_directories(home):
    touch(home / "models/m/model.config")
    finder = ResourceFinder([home / "models"], stock="")
    with pytest.raises(ValueError, match="names 'model.sdf', which is not there"):
        finder.find_model_sdf("model://m")
    expected = touch(home / "models/m/model.sdf")
    assert finder.find_model_sdf("model://m") == expected == finder.find_model_sdf("model://m/model.sdf")
    assert finder.find_model_sdf("model://n") is None


def test_stock_directory_from_the_environment(home, monkeypatch):
    touch(home / "s/worlds/empty.world")
    touch(home / "s/models/cone/model.config")
    monkeypatch.setenv("ODE_SIM_STOCK_PATH", str(home / "s"))
    finder = ResourceFinder()
    assert finder.stock_worlds() == ["worlds/empty.world"] and finder.stock_models() == ["cone"]
    assert finder.find_world("worlds/empty.world") == str(home / "s/worlds/empty.world")


@pytest.fixture
def traps(home, monkeypatch):
    """A finder, and a secret beside its folders."""
    touch(home / "secret/a.txt")
    touch(home / "secret/model.config")
    touch(home / "secret/model.sdf")
    touch(home / "models/m/a.txt")
    touch(home / "ws/pkg/package.xml")
    touch(home / "ws/pkg/a.txt")
    touch(home / "r/media/a.txt")
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", f"{home}/r")
    monkeypatch.chdir(home / "r")
    return ResourceFinder(
        [home / "models"], stock="", package_path={"pkg": f"{home}/ws/pkg", "..": f"{home}", ".": f"{home}", "": f"{home}"}.get
    )


@pytest.mark.parametrize(
    "uri",
    [
        "model://../secret/a.txt",
        "model://m/../../secret/a.txt",
        "model:///../secret/a.txt",
        "model://%2e%2e/secret/a.txt",
        "model://m/%2E%2E/..%2fsecret/a.txt",
        "model://..",
        "model://../models/../secret",
        "model:////../secret/a.txt",
        "model://{home}/secret/a.txt",
        "package://pkg/../../secret/a.txt",
        "package://../secret/a.txt",
        "package://./secret/a.txt",
        "package:///secret/a.txt",
        "package://pkg/x/../../../secret/a.txt",
        "package://pkg/{home}/secret/a.txt",
        "package://pkg/%2e%2e/%2e%2e/secret/a.txt",
        "file://media/../../secret/a.txt",
        "file://../secret/a.txt",
        "file://media/%2e%2e/%2e%2e/secret/a.txt",
        "file://model/../../secret/a.txt",
        "http://models/..",
        "https://models/../",
        "model://a\0b",
        "model://" + "x" * 9999,
        "\0",
        "package://pkg/\0",
        "ftp://x/a.txt",
    ],
    ids=lambda uri: uri[:40],
)
def test_no_uri_leads_out_of_its_folder(home, traps, uri):
    assert traps.find(uri.format(home=home), base=str(home / "r")) is None
    assert traps.find_model_sdf(uri.format(home=home)) is None


def test_uris_that_go_up_and_down_inside_their_folder_and_links_are_followed(home, traps):
    assert traps.find("model://m/x/../a.txt") == f"{home}/models/m/a.txt"
    assert traps.find("model://n/../m/a.txt") == f"{home}/models/m/a.txt"
    assert traps.find("package://pkg/x/../a.txt") == f"{home}/ws/pkg/a.txt"
    assert traps.find("file://media/../media/a.txt") == f"{home}/r/media/a.txt"
    (home / "models/linked").symlink_to(home / "secret")
    assert traps.find("model://linked/a.txt") == f"{home}/models/linked/a.txt"
    assert traps.find("model://linked/../m/a.txt") == f"{home}/models/m/a.txt"  # not what lies beside the secret
    assert traps.find("../secret/a.txt") == traps.find(f"file://{home}/secret/a.txt") == f"{home}/secret/a.txt"  # said plainly


@pytest.mark.parametrize(
    "name", ["../../secret/model.sdf", "{home}/secret/model.sdf", "x/../../../secret/model.sdf", "\t", "y" * 9999, ".."], ids=range(6)
)
def test_a_model_config_names_a_file_of_its_model(home, traps, name):
    (home / "models/m/model.config").write_text(f"<model><sdf version='1.6'>{name.format(home=home)}</sdf></model>")
    with pytest.raises(ValueError, match="model.config: names '.*', which is not there") as error:
        traps.find_model_sdf("model://m")
    assert len(str(error.value)) < 400


@pytest.mark.parametrize(
    "text",
    [
        "",
        "<",
        "<model/>",
        "<model>" * 2000,
        "<!DOCTYPE m [<!ENTITY a 'b'>]><model><sdf>&a;</sdf></model>",
        f"<model><sdf version='{'9' * 5000}'>a</sdf></model>",
        "<model><sdf version='x.y'>a</sdf></model>",
        "\0",
        "\udcff",
    ],
    ids=range(9),
)
def test_a_model_config_that_is_none_is_refused_in_one_line(home, traps, text):
    (home / "models/m/model.config").write_text(text, errors="surrogateescape")
    with pytest.raises(DescriptionError, match="model.config") as error:
        traps.find_model_sdf("model://m")
    assert "\n" not in str(error.value) and len(str(error.value)) < 400


# ---------------------------------------------------------------------------------------------- material scripts


def look(folder, text, name="A"):
    (folder / "x.material").write_text(text)
    return script_material(name, [str(folder)])


def test_material_scripts_of_any_shape(tmp_path):
    red = "{ technique { pass { ambient 1 0 0 } } }"
    for text in (
        f"material A {red}",
        f"material A\n\n{red}",
        f'material "A"{red}',
        f"material A: B {red}",
        f"material A:B{red}",
        f"/* material A {{ */ material A /* x */ {red}",
        f"material B {red.replace('1', '0')} material A {red}",
        f"/* open\nmaterial A {red}",
        f"material A {red[:-6]}",
        f"}} material A {red}",
    ):
        assert look(tmp_path, text).ambient == (1.0, 0.0, 0.0, 1.0), text
    for text in (
        "",
        "material A",
        f"// material A {red}",
        f"/* material A {red} */",
        f"material AB {red}",
        f"material B : A {red}",
        f"x {{ material A {red} }}",
    ):
        assert look(tmp_path, text) is None, text
    assert look(tmp_path, f"material A B {red}", "A B").ambient
    assert look(tmp_path, "material A { pass { ambient nan 0 0\n diffuse 1e300 0 0\n specular x\n emissive 1 } }").ambient is None
    assert look(tmp_path, "material A { texture\ntexture a\0b\ntexture " + "x" * 9999 + "\n}").texture == ""


@pytest.mark.parametrize(
    "text",
    [
        "/*" * 400_000,
        "//" * 400_000,
        "\n" * 800_000,
        " " * 800_000,
        "{" * 800_000,
        "material A {" + "}{" * 400_000,
        "material A\n" * 80_000,
    ],
    ids=range(7),
)
def test_material_scripts_take_linear_time(tmp_path, text):
    begin = time.process_time()
    look(tmp_path, text)
    assert time.process_time() - begin < 5.0  # by the square of the length: minutes


TEAM = """
material Team/Base { set $ambient "0.1 0.1 0.1"
  technique { pass { ambient $ambient
    diffuse 1 1 1
    texture_unit { texture team.png } } } }
material Team/Red : Team/Base { technique { pass { diffuse 1 0 0 0.5 } } }
material Team/Dark : Team/Red { set $ambient "0 0 0" }
material Team/Grass : Gazebo/Green { technique { pass { specular 1 1 1 } } }
"""


@pytest.mark.parametrize("folder", ["media/materials/scripts", ""])
def test_materials_on_the_resource_path_are_known_by_their_name_alone(tmp_path, monkeypatch, folder):
    """As Gazebo, which hands every folder of GAZEBO_RESOURCE_PATH and gazebo_media_path to OGRE (RenderEngine::AddResourcePath)."""
    scripts = tmp_path / "field" / folder
    scripts.mkdir(parents=True)
    (scripts / "team.material").write_text(TEAM)
    textures = tmp_path / "field/media/materials/textures"
    textures.mkdir(parents=True)
    (textures / "team.png").write_text("x")
    monkeypatch.setenv("GAZEBO_RESOURCE_PATH", f"/nowhere:{tmp_path / 'field'}")
    for finder in (
        ResourceFinder(stock="/nowhere", package_path=lambda name: None),
        ResourceFinder(environment=False, resource_paths=[tmp_path / "field"], stock="/nowhere", package_path=lambda name: None),
    ):
        robot, problems = read_model(
            '<robot name="r"><link name="a"><inertial><mass value="1"/>'
            '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
            '<visual><geometry><box size="1 1 1"/></geometry></visual></link>'
            '<gazebo reference="a"><material>Team/Red</material></gazebo></robot>',
            finder=finder,
        )
        red = robot.links[0].visuals[0].material
        assert (red.diffuse, red.ambient, red.texture) == ((1, 0, 0, 0.5), (0.1, 0.1, 0.1, 1), str(textures / "team.png")) and not problems
        box = "<visual name='{0}'><geometry><box/></geometry><material><script><name>{0}</name></script></material></visual>"
        model, problems = read_model(
            "<sdf version='1.6'><model name='m'><link name='l'>"
            + "".join(map(box.format, ("Team/Dark", "Team/Grass", "Team/None")))
            + "</link></model></sdf>",
            finder=finder,
        )
        dark, grass, none = (visual.material for visual in model.links[0].visuals)
        assert (dark.ambient, dark.diffuse) == ((0, 0, 0, 1), (1, 0, 0, 0.5))
        assert (grass.diffuse, grass.specular) == ((0, 1, 0, 1), (1, 1, 1, 1)) and none.diffuse is None
        assert len(problems) == 1 and "there is no material 'Team/None'" in str(problems[0])


def test_what_is_no_script_has_no_materials(tmp_path):
    (tmp_path / "folder.material").mkdir()
    (tmp_path / "bytes.material").write_bytes(bytes(range(256)) * 100)
    assert script_material("A", [str(tmp_path), str(tmp_path / "none"), str(tmp_path / "bytes.material"), ""]) is None
