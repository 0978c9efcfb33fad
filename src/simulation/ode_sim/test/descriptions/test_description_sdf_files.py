"""SDF that includes other files, nests models, is a saved world or a text to spawn."""

import math

import pytest
from ode_sim import math3
from ode_sim.description import (
    DescriptionError,
    Entity,
    ResourceFinder,
    load_world,
    read_light,
    read_model,
    read_sdf_model,
    root_kind,
    xmlsource,
)
from ode_sim.description.model import Box, Cylinder, Inertial, Plane, Ribbon, Sphere
from sdf_texts import MODEL, finder, model, models, names, text, world

# ---------------------------------------------------------------------------------------------- include, nesting


def test_include_changes_what_it_says(models, finder):
    models("thing", MODEL.format(name="Thing"))
    w, problems = world(
        """<include><uri>model://thing</uri></include>
        <include><uri>model://thing</uri><name>other</name><pose>1 0 0 0 0 0</pose><static>true</static>
        <plugin name="more" filename="libmore.so"/></include>""",
        finder,
    )
    first, other = w.models
    assert (first.name, first.pose.p, first.static, names(first.plugins)) == ("Thing", (9.0, 9.0, 9.0), False, ["own"])
    assert (other.name, other.pose.p, other.static, names(other.plugins)) == ("other", (1.0, 0.0, 0.0), True, ["own", "more"])
    assert not problems


def test_plugins_of_an_included_model_name_its_parts_as_they_are_called_there(models, finder):
    """As of the ArduPilot plugin, two models deep; topics and frames are what ROS hears, and stay."""
    models(
        "rotor",
        """<sdf version="1.6"><model name="iris"><link name="base"/><link name="blade"/><joint name="spin" type="revolute">
        <parent>base</parent><child>blade</child><axis><xyz>0 0 1</xyz></axis></joint><plugin name="base" filename="libown.so">
        <control joint="spin"><jointName> spin </jointName></control><topicName>base</topicName><frameName>base</frameName>
        <other>bases</other></plugin></model></sdf>""",
    )
    models(
        "craft",
        """<sdf version="1.6"><model name="craft"><include><uri>model://rotor</uri></include>
        <plugin name="fly" filename="libfly.so"><linkName>iris::blade</linkName></plugin></model></sdf>""",
    )
    w, problems = world(
        "<model name='out'><include><uri>model://craft</uri></include></model><include><uri>model://craft</uri></include>", finder
    )
    out, craft = w.models
    assert names(out.joints) == ["craft::iris::spin"] and names(out.plugins) == names(craft.plugins) == ["base", "fly"] and not problems
    for model_, scope in ((out, "craft::iris::"), (craft, "iris::")):
        own, fly = (plugin.element for plugin in model_.plugins)
        assert own.find("control").get("joint") == own.findtext("control/jointName") == scope + "spin"
        assert own.get("name") == own.findtext("topicName") == own.findtext("frameName") == "base" and own.findtext("other") == "bases"
        assert fly.findtext("linkName") == scope + "blade"


def test_a_second_model_of_a_name_in_a_model_is_told(models, finder):
    models("table", "<sdf version='1.6'><model name='table'><link name='l'/></model></sdf>")
    table = "<include><uri>model://table</uri>{}</include>"
    nested = "<model name='table'><link name='l'/></model>"
    for body in (table.format("") + table.format("<pose>3 0 0 0 0 0</pose>"), nested + nested, nested + table.format("")):
        w, problems = world(f"<model name='top'>{body}</model>", finder)
        assert names(w.models[0].links) == ["table::l"]
        assert "a model named 'table' is there already; this one is left out" in text(problems) and len(problems) == 1


def test_plugins_of_a_model_in_a_model_name_the_parts_of_their_own(finder):
    """Gazebo gives them the inner model, whose parts they name as it does; the outer one has parts of the same names."""
    arm = """<model name="{}"><link name="base"/><link name="tip"/><joint name="j" type="revolute"><parent>base</parent><child>tip</child>
        <axis><xyz>0 0 1</xyz></axis></joint>{}<plugin name="{}" filename="libown.so"><jointName>j</jointName></plugin></model>"""
    w, problems = world(arm.format("top", arm.format("arm", arm.format("hand", "", "inmost"), "inner"), "outer"), finder)
    told = {plugin.name: plugin.element.findtext("jointName") for plugin in w.models[0].plugins}
    assert told == {"outer": "j", "inner": "arm::j", "inmost": "arm::hand::j"} and not problems


def test_an_update_rate_below_0_is_as_fast_as_possible(finder):
    w, problems = world("<physics type='ode'><real_time_update_rate>-1</real_time_update_rate></physics>", finder)
    assert w.physics.real_time_update_rate == 0.0 and not problems


def test_include_of_a_light(models, finder):
    models("lamp", '<sdf version="1.6"><light name="lamp" type="point"/></sdf>')
    w, _ = world("<include><uri>model://lamp</uri><pose>0 0 3 0 0 0</pose></include>", finder)
    assert (w.lights[0].name, w.lights[0].pose.p) == ("lamp", (0.0, 0.0, 3.0))


def test_a_missing_model_is_one_warning_and_the_rest_loads(models, finder):
    models("thing", MODEL.format(name="thing"))
    w, problems = world(
        "<include><uri>model://gone</uri></include><include><uri>model://thing</uri></include><include><uri>model://gone</uri></include>",
        finder,
    )
    assert names(w.models) == ["thing"] and len(problems) == 1
    assert "model://gone" in text(problems) and finder.model_paths[0] in text(problems)


def test_the_network_is_never_used_but_a_local_model_of_that_name_is(models, finder):
    models("ground_plane", MODEL.format(name="floor"))
    w, problems = world(
        "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane</uri></include>"
        "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Tree</uri></include>",
        finder,
    )
    assert names(w.models) == ["floor"] and "the network is never used" in text(problems)


def test_duplicate_names_keep_the_first(models, finder):
    models("thing", MODEL.format(name="thing"))
    w, problems = world("<include><uri>model://thing</uri></include>" * 2, finder)
    assert len(w.models) == 1 and "'thing' is there already" in text(problems)


def test_nested_models_are_flattened_with_scoped_names(models, finder):
    models("thing", MODEL.format(name="thing"))
    m, problems = model(
        """<link name="base"/>
        <include><uri>model://thing</uri><name>t</name><pose>0 5 0 0 0 0</pose></include>
        <model name="s"><pose>1 0 0 0 0 1.5707963267948966</pose><link name="l"><pose>1 0 0 0 0 0</pose></link></model>
        <joint name="weld" type="fixed"><parent>base</parent><child>t::body</child></joint>""",
        finder,
    )
    assert names(m.links) == ["base", "s::l", "t::body", "t::tip"]
    by_name = {link.name: link.pose.p for link in m.links}
    assert by_name["t::body"] == (0.0, 5.0, 1.0) and by_name["s::l"] == pytest.approx((1.0, 1.0, 0.0))
    assert [(j.name, j.parent, j.child) for j in m.joints] == [("weld", "base", "t::body"), ("t::j", "t::body", "t::tip")]
    assert names(m.plugins) == ["own"] and not problems


def test_what_is_static_in_a_model_that_moves_stays_where_it_is(finder):
    """Warehouses name their floor so: a <model> with nothing but the <include> of one that is static."""
    slab = '<model name="slab"><static>1</static><link name="l"/></model>'
    m, problems = model(f"<pose>0 0 3 0 0 0</pose>{slab}", finder)
    assert m.static and not m.joints and not problems
    m, problems = model(f'<link name="base"/><model name="room"><link name="door"/>{slab}</model>', finder)
    assert not m.static and not problems
    assert [(j.name, j.type, j.parent, j.child) for j in m.joints] == [("room::slab::l::static", "fixed", "world", "room::slab::l")]


def test_a_model_that_includes_itself_is_stopped(models, finder):
    models("ring", '<sdf version="1.6"><model name="ring"><link name="l"/><include><uri>model://ring</uri></include></model></sdf>')
    w, problems = world("<include><uri>model://ring</uri></include>", finder)
    assert names(w.models[0].links) == ["l"] and "includes itself" in text(problems)


def test_bad_models_of_a_world_are_left_out_one_by_one(models, finder):
    models("broken", "<sdf version='1.6'><model name='x'>")
    models("config", MODEL.format(name="x"), config="<model/>")
    w, problems = world(
        """<include><uri>model://broken</uri></include><include><uri>model://config</uri></include>
        <model name="none"/><model name="light"><link name="l"><inertial><mass>0</mass></inertial></link></model>
        <model name="fat"><link name="l"><collision name="c"><geometry><sphere><radius>-1</radius></sphere></geometry>
        </collision></link></model><model name="good"><link name="l"/></model>""",
        finder,
    )
    assert names(w.models) == ["fat", "good"] and len(problems) == 5 and not w.models[0].links[0].collisions
    for part in (
        "model.sdf:1: not well-formed",
        "<sdf version='1.6'>model.sdf</sdf>",
        "has no <link>",
        "positive mass",
        "sizes must be positive",
    ):
        assert part in text(problems)


def test_static_models_may_have_any_mass(finder):
    m, _ = model('<static>1</static><link name="l"><inertial><mass>0</mass><inertia><ixx>nan</ixx></inertia></inertial></link>', finder)
    assert m.static and m.links[0].inertial == Inertial()


def test_nan_inertia_of_a_moving_model_is_refused(finder):
    with pytest.raises(DescriptionError, match="finite"):
        model('<link name="l"><inertial><inertia><ixx>nan</ixx></inertia></inertial></link>', finder)


def test_the_newest_supported_file_of_a_model_config_is_taken(models, finder):
    folder = models(
        "thing",
        MODEL.format(name="new"),
        config="""<model><sdf version="1.3">old.sdf</sdf>
        <sdf version="1.6">model.sdf</sdf><sdf version="1.9">future.sdf</sdf></model>""",
    )
    (folder / "old.sdf").write_text(MODEL.format(name="old"))
    (folder / "future.sdf").write_text(MODEL.format(name="future"))
    assert names(world("<include><uri>model://thing</uri></include>", finder)[0].models) == ["new"]


# ---------------------------------------------------------------------------------------------- state, population


def test_what_had_fallen_out_of_a_saved_world_is_left_out_alone(finder):
    w, problems = world(
        """<model name="cup"><link name="l"/></model><model name="can"><link name="l"/></model><state world_name="w">
        <model name="cup"><link name="l"><pose>4.5e7 0 -2e8 0 0 0</pose></link></model>
        <model name="can"><pose>1 0 0 0 0 0</pose></model></state>""",
        finder,
    )
    assert w.state.deletions == ("cup",) and [(m.name, m.pose.p) for m in w.state.models] == [("can", (1.0, 0.0, 0.0))]
    assert "it has fallen out of this world; model 'cup' is left out" in text(problems)


def test_state_of_a_saved_world(finder):
    w, _ = world(
        """<model name="m"><link name="l"/></model><state world_name="w"><sim_time>12 500000000</sim_time>
        <iterations>12500</iterations>
        <model name="m"><pose>1 0 0 0 0 0</pose><scale>2 2 2</scale>
          <link name="l"><pose>1 2 3 0 0 1</pose><velocity>1 2 3 4 5 6</velocity></link>
          <model name="sub"><link name="k"><pose>4 5 6 0 0 0</pose></link></model></model>
        <light name="sun"><pose>0 0 7 0 0 0</pose></light>
        <insertions><model name="late"><link name="l"/></model></insertions>
        <deletions><name>m</name></deletions></state>
        <state world_name="w"><sim_time>99 0</sim_time></state>""",
        finder,
    )
    state = w.state
    assert (state.sim_time, state.iterations, state.deletions) == (12.5, 12500, ("m",))
    (m,) = state.models
    assert (m.pose.p, m.scale) == ((1.0, 0.0, 0.0), (2.0, 2.0, 2.0))
    assert [(link.name, link.pose.p) for link in m.links] == [("l", (1.0, 2.0, 3.0)), ("sub::k", (4.0, 5.0, 6.0))]
    assert (m.links[0].linear, m.links[0].angular) == ((1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    assert state.light_poses[0][0] == "sun" and names(w.models) == ["m", "late"]


def test_what_was_stretched_in_the_window_is_as_large_as_it_was(finder):
    shapes = {
        "box": "<box><size>1 1 1</size></box>",
        "ball": "<sphere><radius>0.5</radius></sphere>",
        "post": "<cylinder><radius>0.5</radius><length>1</length></cylinder>",
    }
    parts = "".join(
        f'<collision name="{name}"><pose>0 0 3 0 0 0</pose><geometry>{shape}</geometry></collision>'
        f'<visual name="{name}"><geometry>{shape}</geometry></visual>'
        for name, shape in shapes.items()
    )
    models = "".join(f'<model name="{name}"><link name="l">{parts}</link></model>' for name in ("wall", "crate", "odd"))
    w, problems = world(
        f"""{models}<state world_name="w">
        <model name="wall"><scale>0.2 7.5 2</scale></model><model name="crate"><scale>1 1 1</scale></model>
        <model name="odd"><scale>1 0 1</scale></model></state>""",
        finder,
    )
    wall, crate, odd = (m.links[0] for m in w.models)
    for parts in (wall.collisions, wall.visuals):
        assert [part.geometry for part in parts] == [Box((0.2, 7.5, 2.0)), Sphere(3.75), Cylinder(3.75, 2.0)]
    assert wall.collisions[0].pose.p == (0.0, 0.0, 3.0) and wall.inertial == Inertial()
    for link in (crate, odd):
        assert [part.geometry for part in link.collisions] == [Box(), Sphere(0.5), Cylinder(0.5, 1.0)]
    assert "model 'odd': scale 1 0 1" in text(problems)


@pytest.mark.parametrize(
    "distribution, region",
    [
        ("<type>random</type>", "<box><size>4 4 0.1</size></box>"),
        ("<type>uniform</type>", "<box><size>4 4 0.1</size></box>"),
        ("<type>random</type>", "<cylinder><radius>2</radius><length>1</length></cylinder>"),
        ("<type>linear-x</type>", "<box><size>4 4 0.1</size></box>"),
    ],
)
def test_population(finder, distribution, region):
    body = f"""<population name="p"><pose>10 0 0 0 0 0</pose>{region}<model_count>9</model_count>
        <distribution>{distribution}</distribution>
        <model name="can"><pose>0 0 0.5 0 0 0</pose><link name="l"/></model></population>"""
    w, problems = world(body, finder)
    assert names(w.models) == [f"can_clone_{i}" for i in range(9)] and not problems
    places = [m.pose.p for m in w.models]
    assert len(set(places)) == 9 and all(abs(x - 10) <= 2 and abs(y) <= 2 for x, y, z in places)
    assert places == [m.pose.p for m in world(body, finder)[0].models]  # every time the same


def test_population_grid(finder):
    w, _ = world(
        """<population name="p"><model name="m"><link name="l"/></model><distribution><type>grid</type>
        <rows>2</rows><cols>3</cols><step>1 2 0</step></distribution></population>""",
        finder,
    )
    assert sorted({m.pose.p[0] for m in w.models}) == [-1.0, 0.0, 1.0]
    assert sorted({m.pose.p[1] for m in w.models}) == [-1.0, 1.0]


def test_a_road_is_scenery_and_no_model(finder):
    w, problems = world(
        """<road name="street"><width>7.5</width><point>0 0 0</point><point>1 2 0.1</point><point>1 2 0.1</point>
        <point>5 2 0.1</point></road><road name="own"><point>0 0 0</point><point>1 0 0</point>
        <material><diffuse>1 0 0 1</diffuse></material></road>""",
        finder,
    )
    street, own = w.scene.roads
    assert street.geometry == Ribbon(((0.0, 0.0, 0.0), (1.0, 2.0, 0.1), (5.0, 2.0, 0.1)), 7.5)
    assert street.material.name == "Gazebo/Road" and not street.cast_shadows
    assert (own.geometry.width, own.material.diffuse) == (1.0, (1.0, 0.0, 0.0, 1.0))
    assert not w.models and not problems


@pytest.mark.parametrize(
    "inside, word",
    [
        ("", "two points"),
        ("<point>1 1 0</point><point>1 1 2</point>", "two points"),
        ("<width>-1</width><point>0 0 0</point><point>1 0 0</point>", "-1"),
        ("<point>0 0 0</point><point>nan 0 0</point>", "nan"),
        ("<point>0 0 0</point><point>1 0 0</point>" * 60_000, "120000"),
    ],
)
def test_a_road_that_is_none_is_one_line_and_the_rest_loads(finder, inside, word):
    w, problems = world(f'<road name="street">{inside}</road><model name="m"><link name="l"/></model>', finder)
    assert names(w.models) == ["m"] and not w.scene.roads
    assert len(problems) == 1 and word in text(problems) and "road 'street' is left out" in text(problems)


def test_an_actor_without_anything_is_there(finder):
    w, problems = world('<actor name="walker"/>', finder)
    assert names(w.models) == ["walker"] and not problems and [link.name for link in w.models[0].links] == ["walker_pose"]


# ---------------------------------------------------------------------------------------------- texts to spawn


def test_kinds_of_text(models, finder):
    models("thing", MODEL.format(name="thing"))
    include = (
        "<sdf version='1.4'><world name='default'><include><uri>model://thing</uri><name>{}</name>"
        "<pose>1 2 3 0 0 0</pose></include></world></sdf>"
    )
    assert root_kind("<robot name='r'/>") == "urdf"
    assert root_kind("<sdf version='1.6'><light name='l'/></sdf>") == "light"
    assert root_kind(include.format("x"), finder) == "model"
    m, _ = read_model(include.format("x"), finder=finder)
    assert (m.name, m.pose.p) == ("x", (1.0, 2.0, 3.0))
    light, _ = read_light("<sdf version='1.6'><light name='l' type='spot'><diffuse>1 0 0</diffuse></light></sdf>")
    assert (light.name, light.type, light.diffuse) == ("l", "spot", (1.0, 0.0, 0.0, 1.0))


def test_a_text_to_spawn_is_parsed_once(models, finder, monkeypatch):
    from ode_sim.description import load

    models("thing", MODEL.format(name="thing"))
    parsed = []
    monkeypatch.setattr(load, "parse_xml", lambda *text: parsed.append(text) or xmlsource.parse_xml(*text))
    inertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
    robot = Entity(f"<robot name='r'><link name='l'><inertial><mass value='1'/>{inertia}</inertial></link></robot>", finder)
    assert robot.kind == "urdf" and robot.model("mine")[0].name == "mine"
    thing = Entity("<world name='w'><include><uri>model://thing</uri></include></world>", finder)
    assert thing.kind == "model" and thing.model()[0].name == "thing"
    lamp = Entity("<light name='l'/>")
    assert lamp.kind == "light" and lamp.light("lamp")[0].name == "lamp"
    assert len(parsed) == 3
    with pytest.raises(DescriptionError, match="<light name='lamp'>: is no <model>"):
        lamp.model()
    with pytest.raises(DescriptionError, match="is no <light>"):
        robot.light()
    with pytest.raises(DescriptionError, match="is URDF; expected <sdf"):
        read_sdf_model("<robot name='r'/>")


@pytest.mark.parametrize(
    "text, named",
    [
        ("<robot><link name='l'><inertial><mass value='1'/>{inertia}</inertial></link></robot>", "no name of its own"),
        ("<robot name=''><link name='l'><inertial><mass value='1'/>{inertia}</inertial></link></robot>", "an empty one"),
        ("<sdf version='1.6'><model><link name='l'/></model></sdf>", "a model without"),
    ],
)
def test_the_name_that_a_model_is_spawned_by_is_set_in_its_text(text, named, finder):
    """gazebo_ros_api_plugin writes the requested name over the attribute before the text is read: none need be there."""
    inertia = "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
    assert Entity(text.format(inertia=inertia), finder).model("mine")[0].name == "mine", named


@pytest.mark.parametrize(
    "spawned, message",
    [
        ("<sdf version='1.6'/>", "holds no <model>"),
        ("<html/>", "expected <robot> or <sdf>"),
        ("", "empty"),
        ("<sdf version='1.6'><world name='w'><include><uri>model://gone</uri></include></world></sdf>", "model://gone"),
        ("<sdf version='x'><model name='m'/></sdf>", "'x' is no SDF version"),
        ("<sdf version='1.6'><light name='l'/></sdf>", "is no <model>"),
    ],
)
def test_texts_that_are_no_model(finder, spawned, message):
    with pytest.raises(DescriptionError, match=message) as caught:
        read_model(spawned, finder=finder)
    assert "\n" not in str(caught.value)


def test_a_world_that_is_not_there_names_those_that_are(tmp_path):
    (tmp_path / "worlds").mkdir()
    (tmp_path / "worlds/empty.world").write_text("<sdf version='1.6'><world name='default'/></sdf>")
    finder = ResourceFinder(environment=False, stock=str(tmp_path))
    assert load_world("worlds/empty.world", finder)[0].name == "default"
    with pytest.raises(DescriptionError, match="cannot find world 'worlds/moon.world'.*: worlds/empty.world"):
        load_world("worlds/moon.world", finder)


def test_warnings_name_file_and_line(tmp_path, finder):
    file = tmp_path / "a.world"
    file.write_text("<sdf version='1.6'>\n<world name='w'>\n<gravity>0 0</gravity>\n</world></sdf>")
    w, problems = load_world(str(file), finder)
    assert w.gravity == (0.0, 0.0, -9.8) and text(problems).startswith(f"{file}:3 <gravity>: '0 0' is not 3 numbers")


def test_colours_of_gazebo_and_of_a_model(models, finder):
    folder = models("thing", MODEL.format(name="thing"))
    (folder / "materials/scripts").mkdir(parents=True)
    (folder / "materials/textures").mkdir()
    (folder / "materials/textures/t.png").write_text("x")
    (folder / "materials/scripts/t.material").write_text("""
        material Other/One { technique { pass { ambient 1 1 1 } } }
        // material Thing/Skin in a comment
        material Thing/Skin : Other/One
        {
          technique { pass { ambient 0.1 0.2 0.3
            diffuse 0.4 0.5 0.6 0.7
            texture_unit { texture t.png } } }
        }""")
    script = "<material><script><uri>{}</uri><name>{}</name></script>{}</material>"
    visual = '<visual name="{}"><geometry><empty/></geometry>{}</visual>'
    m, problems = model(
        '<link name="l">'
        + "".join(
            visual.format(i, content)
            for i, content in enumerate(
                [
                    script.format("file://media/materials/scripts/gazebo.material", "Gazebo/Grey", ""),
                    script.format("model://thing/materials/scripts", "Thing/Skin", ""),
                    script.format("file://media/materials/scripts/gazebo.material", "Gazebo/Mauve", ""),
                    script.format("", "Gazebo/Red", "<ambient>1 1 1 1</ambient>"),
                    "<material><diffuse>0 1 0 1</diffuse></material>",
                    "",
                ]
            )
        )
        + "</link>",
        finder,
    )
    grey, skin, mauve, red, green, none = (visual.material for visual in m.links[0].visuals)
    assert (grey.diffuse, grey.ambient) == ((0.7, 0.7, 0.7, 1.0), (0.3, 0.3, 0.3, 1.0))
    assert (skin.ambient, skin.diffuse) == ((0.1, 0.2, 0.3, 1.0), (0.4, 0.5, 0.6, 0.7))
    assert skin.texture == str(folder / "materials/textures/t.png")
    assert mauve.diffuse is None and "no material 'Gazebo/Mauve'" in text(problems) and len(problems) == 1
    assert (red.diffuse, red.ambient) == ((1.0, 0.0, 0.0, 1.0), (1.0, 1.0, 1.0, 1.0))
    assert green.diffuse == (0.0, 1.0, 0.0, 1.0) and none is None


def test_saved_worlds_say_default_where_there_is_no_material(finder):
    default = "<script><uri>__default__</uri><name>__default__</name></script>"
    m, problems = model(
        '<link name="l">'
        + "".join(
            f'<visual name="{name}"><geometry><empty/></geometry><material>{default}{colour}</material></visual>'
            for name, colour in (("plain", ""), ("green", "<diffuse>0 1 0 1</diffuse>"))
        )
        + "</link>",
        finder,
    )
    plain, green = (visual.material for visual in m.links[0].visuals)
    assert plain is None and green.diffuse == (0.0, 1.0, 0.0, 1.0) and not problems


def test_pose_as_quaternion_is_read(finder):
    m, _ = model('<link name="l"><pose rotation_format="quat_xyzw">1 2 3 0 0 2 2</pose></link>', finder)
    assert math3.to_rpy(m.links[0].pose) == pytest.approx((0.0, 0.0, math.pi / 2))
