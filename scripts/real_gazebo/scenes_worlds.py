"""What a file means: versions of SDF, frames, includes, nested models, states, URDF and its lumping; resets, poses, fields of force."""

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.sdf import box, collision, cube, ground, inertial, link, model, world

EQUAL = (1e-6, 2e-6)


def scene(name, what, law, text, rows, seconds=1.2, deeds=(), files=None, every=0.02, **settings):
    return add(Scene(name, "worlds", what, law, text, tuple(rows), seconds, every, tuple(deeds), files or {}, **settings))


def value(kind, name, number, what, law=None, last=False, near=EQUAL, default=None):
    return Row(
        f"{what} of {kind} {name}", lambda r: float(r.value(kind, name, number, last)), law=law, gazebo=near, default=default or near
    )


def placed(name, last=False):
    """World pose of a link after loading, one row: distance of its numbers from real Gazebo's is what counts."""
    return tuple(
        value("link", name, 10 + i, what, last=last, near=(1e-5, 2e-6)) for i, what in enumerate(("x", "y", "z", "qx", "qy", "qz", "qw"))
    )


def names(kind, expected, last=False):
    """The names that real Gazebo has, and how many of them are there."""
    return Row(
        f"names of {kind}s: {', '.join(expected)}",
        lambda r: float(r.names(kind) == sorted(expected)),
        law=1.0,
        gazebo=(0, 0),
        default=(0, 0),
    )


# ---------------------------------------------------------------------------------------------------- versions of SDF


def old_model(frame=""):
    return (
        f"<model name='p'><pose>1 2 3 0.1 0.2 0.3</pose><link name='a'>"
        f"<pose>0.1 0 0.2 0.3 0 0.5</pose>{inertial(1, 0.02, '0 0 -0.25 0 0 0')}</link>"
        f"<link name='b'><pose>0.1 0.5 0.2 0 0 1</pose>{inertial(1, 0.02, '0 0 -0.25 0 0 0')}</link>"
        f"<joint name='j1' type='revolute'><parent>world</parent><child>a</child><axis><xyz>0.6 0.8 0</xyz>{frame}</axis></joint>"
        "<joint name='j2' type='revolute'><pose>0.05 0 0.1 0 0 0.4</pose><parent>a</parent><child>b</child><axis>"
        "<xyz>1 0 0</xyz></axis></joint></model>"
    )


AXES = tuple(value("joint", f"p::{j}", 3 + i, f"{c} of the axis") for j in ("j1", "j2") for i, c in enumerate("xyz"))
MOVES = tuple(
    Row(f"p::{j} at {t:g} s", lambda r, j=j, t=t: r.angle(f"p::{j}", t), gazebo=(1e-4, 2e-5), default=(2e-3, 1e-3))
    for j in ("j1", "j2")
    for t in (0.3, 0.6)
)
for version, words in (
    ("1.3", "axis in the model's frame"),
    ("1.4", "axis in the model's frame"),
    ("1.5", "axis in the child's frame"),
    ("1.6", "axis in the child's frame"),
    ("1.7", "axis in the joint's frame"),
):
    scene(
        f"sdf_{version.replace('.', '')}",
        f"two links and two joints in a file of SDF {version}",
        words,
        world(ground(), old_model(), version=version),
        placed("p::a") + placed("p::b") + AXES + MOVES,
        0.8,
    )
scene(
    "sdf_16_parent_model_frame",
    "SDF 1.6, use_parent_model_frame",
    "axis in the model's frame",
    world(ground(), old_model("<use_parent_model_frame>1</use_parent_model_frame>")),
    AXES + MOVES,
    0.8,
)
scene(
    "sdf_17_frames",
    "SDF 1.7: frames, relative_to, expressed_in, attached_to",
    "poses chain through the frames",
    world(
        ground(),
        """
<model name='p' canonical_link='b'><pose>1 0 1 0 0 0.3</pose><frame name='f'><pose>0.2 0 0 0 0 0.5</pose></frame>
<frame name='g' attached_to='f'><pose>0 0.3 0 0.4 0 0</pose></frame>
<link name='a'><pose relative_to='g'>0 0 0.1 0 0 0</pose>%s</link><link name='b'><pose relative_to='a'>0.5 0 0 0 0 0.2</pose>%s</link>
<joint name='j1' type='revolute'><pose relative_to='f'>0 0 0.1 0 0 0</pose><parent>a</parent><child>b</child><axis>\
<xyz expressed_in='f'>0 1 0</xyz></axis></joint>
</model>"""
        % (inertial(1, 0.02), inertial(1, 0.02)),
        version="1.7",
    ),
    placed("p::a") + placed("p::b") + tuple(value("joint", "p::j1", 3 + i, f"{c} of the axis") for i, c in enumerate("xyz")),
    0.1,
)
scene(
    "default_inertia",
    "a link without inertial, one with mass alone, one with an offset and a turned frame",
    "defaults: 1 kg, moments 1",
    world(
        "<model name='p'><link name='a'/><link name='b'><pose>1 0 0 0 0 0</pose><inertial><mass>2</mass></inertial>"
        "</link><link name='c'><pose>2 0 0 0 0 0</pose>"
        "<inertial><pose>0.1 0.2 0.3 0.4 0.5 0.6</pose><mass>3</mass><inertia><ixx>0.1</ixx><iyy>0.2</iyy>"
        "<izz>0.25</izz><ixy>0.01</ixy><ixz>0.02</ixz>"
        "<iyz>0.03</iyz></inertia></inertial></link></model>"
    ),
    tuple(
        value("link", f"p::{n}", i, what, near=(1e-5, 1e-7))
        for n in "abc"
        for i, what in enumerate(("mass", "cx", "cy", "cz", "ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    ),
    0.1,
)
THING = (
    f"<?xml version='1.0'?><sdf version='1.6'><model name='thing'><pose>0.1 0 0 0 0 0.2</pose><link name='l'>"
    f"<pose>0 0 0.1 0 0 0</pose>{inertial(1, 0.01)}"
    f"{collision(box(0.2, 0.2, 0.2))}</link></model></sdf>"
)
CONFIG = "<?xml version='1.0'?><model><name>thing</name><version>1.0</version><sdf version='1.6'>model.sdf</sdf></model>"
FILES = {"thing/model.config": CONFIG, "thing/model.sdf": THING}
scene(
    "include",
    "the same model included as it is, with a pose, with a name, static",
    "a pose of the include replaces the model's own",
    world(
        ground(),
        "<include><uri>model://thing</uri></include>",
        "<include><uri>model://thing</uri><name>second</name><pose>1 0 0 0 0 1</pose></include>",
        "<include><uri>model://thing</uri><name>third</name><pose>2 0 0 0 0 0</pose><static>1</static></include>",
    ),
    (names("model", ["ground", "thing", "second", "third"]), value("model", "third", 0, "static"))
    + placed("thing::l")
    + placed("second::l")
    + placed("third::l"),
    0.1,
    files=FILES,
)
scene(
    "include_in_model",
    "a model that includes another and joins it",
    "SDF: its links are named thing::l, its poses chain",
    world(
        ground(),
        model(
            "outer",
            link("base", inertial(1, 0.01)),
            "<include><uri>model://thing</uri><pose>0.5 0 0 0 0 0.3</pose></include>",
            "<joint name='j' type='fixed'><parent>base</parent><child>thing::l</child></joint>",
            pose="0 0 1 0 0 0.5",
        ),
    ),
    (names("link", ["ground::l", "outer::base", "outer::thing::l"]),) + placed("outer::base") + placed("outer::thing::l"),
    0.1,
    files=FILES,
)
scene(
    "nested_models",
    "a model in a model, in a model",
    "poses chain",
    world(
        ground(),
        model(
            "outer",
            link("base", inertial(1, 0.01)),
            model(
                "middle",
                link("m", inertial(1, 0.01), pose="0 0.1 0 0 0 0"),
                model("inner", link("i", inertial(1, 0.01), pose="0 0 0.1 0 0 0.3"), pose="0.1 0 0 0.2 0 0"),
                pose="1 0 0 0 0 0.4",
            ),
            pose="0 0 1 0 0 0.5",
        ),
    ),
    (names("link", ["ground::l", "outer::base", "outer::middle::inner::i", "outer::middle::m"]),)
    + placed("outer::middle::m")
    + placed("outer::middle::inner::i"),
    0.1,
)
scene(
    "state",
    "a <state> with a model's pose and a link's pose and velocity",
    "the state replaces what the models say",
    world(
        ground(),
        cube("c", 0.2, 1, "0 0 0.1 0 0 0"),
        cube("d", 0.2, 1, "1 0 0.1 0 0 0"),
        "<state world_name='default'><sim_time>12 500000000</sim_time><iterations>12500</iterations><model name='c'>"
        "<pose>3 0 2 0 0 0.5</pose>"
        "<link name='l'><pose>3 0 2 0 0 0.5</pose><velocity>1 0 0 0 0 2</velocity></link></model></state>",
        gravity="0 0 0",
    ),
    placed("c::l")
    + placed("d::l")
    + (
        Row("c moved along x in 1 s, m", lambda r: r.at("model:c", "x", 1.0) - 3, gazebo=(1e-3, 1e-4)),
        Row("c turned in 1 s, rad", lambda r: r.yaw_at("model:c", 1.0) - 0.5, gazebo=(1e-3, 1e-4)),
    ),
)

# ---------------------------------------------------------------------------------------------------- URDF

URDF = """<robot name="u"><link name="base"><inertial><mass value="2"/>\
<inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
<link name="mast"><inertial><origin xyz="0 0 0.25"/><mass value="1"/>\
<inertia ixx="0.01" iyy="0.01" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
<collision name="pole"><origin xyz="0 0 0.25"/><geometry><cylinder radius="0.02" length="0.5"/></geometry></collision></link>
<joint name="mount" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0.05 0 0.05" rpy="0 0.3 0"/></joint>
<link name="lamp"><inertial><mass value="0.2"/><inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="0.03"/></geometry></collision></link>
<joint name="screwed" type="fixed"><parent link="mast"/><child link="lamp"/><origin xyz="0 0 0.5"/></joint>
<link name="arm"><inertial><origin xyz="0.1 0 0" rpy="0 0 0.2"/><mass value="0.5"/>\
<inertia ixx="0.001" iyy="0.003" izz="0.003" ixy="0.0002" ixz="0" iyz="0"/></inertial>
<collision><origin xyz="0.1 0 0"/><geometry><box size="0.2 0.02 0.02"/></geometry></collision></link>
<joint name="elbow" type="revolute"><parent link="lamp"/><child link="arm"/><origin xyz="0 0.05 0" rpy="0.1 0 0.2"/><axis xyz="0 1 0"/>
<limit lower="-1.2" upper="1.5" effort="3" velocity="2"/><dynamics damping="0.02" friction="0.01"/></joint>
<link name="frame_only"/><joint name="tip" type="fixed"><parent link="arm"/><child link="frame_only"/><origin xyz="0.2 0 0"/></joint>
<link name="wheel"><inertial><mass value="0.3"/><inertia ixx="0.0003" iyy="0.0005" izz="0.0003" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/></joint>
<gazebo reference="wheel"><mu1>0.7</mu1><mu2>0.3</mu2><kp>1e5</kp><kd>10</kd><maxVel>0.5</maxVel><minDepth>0.002</minDepth></gazebo>
%s</robot>"""
LINKS = ["u::base", "u::arm", "u::wheel"]
INERTIA = tuple(
    value("link", f"u::{n}", i, what, last=True, near=(2e-5, 1e-7))
    for n in ("base", "arm", "wheel")
    for i, what in enumerate(("mass", "cx", "cy", "cz", "ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
)


def limits(name):
    return tuple(
        value("joint", name, 6 + i, what, last=True, near=(1e-5, 1e-7))
        for i, what in enumerate(("lower limit", "upper limit", "effort limit", "velocity limit", "damping"))
    )


def urdf(name, what, law, extra, rows):
    return scene(name, what, law, world(gravity="0 0 0"), rows, 0.2, [Deed("spawn", "{folder}/robot.urdf")], {"robot.urdf": URDF % extra})


urdf(
    "urdf_lumped",
    "URDF: base, mast and lamp fixed to one another, arm with a frame at its tip, wheel",
    "fixed joints are lumped: names and inertia",
    "",
    (
        names("link", LINKS),
        names("joint", ["u::elbow", "u::axle"]),
        names(
            "collision",
            [
                "u::base::base_collision",
                "u::base::base_fixed_joint_lump__pole_collision_1",
                "u::base::base_fixed_joint_lump__lamp_collision_2",
                "u::arm::arm_collision",
                "u::wheel::wheel_collision",
            ],
        ),
    )
    + INERTIA
    + limits("u::elbow")
    + placed("u::arm", True)
    + placed("u::wheel", True)
    + tuple(value("joint", "u::elbow", 3 + i, f"{c} of the axis", last=True) for i, c in enumerate("xyz")),
)
urdf(
    "urdf_preserved",
    "the same with preserveFixedJoint on the mast's joint",
    "mast stays a link of its own, joined",
    "<gazebo reference='mount'><preserveFixedJoint>true</preserveFixedJoint></gazebo>",
    (names("link", ["u::mast"] + LINKS), names("joint", ["u::elbow", "u::axle", "u::mount"])) + placed("u::mast", True),
)
urdf(
    "urdf_lumping_disabled",
    "the same with disableFixedJointLumping on the mast's joint",
    "mast stays a link of its own, by a joint with limits 0",
    "<gazebo reference='mount'><disableFixedJointLumping>true</disableFixedJointLumping></gazebo>",
    (names("link", ["u::mast"] + LINKS), names("joint", ["u::elbow", "u::axle", "u::mount"])) + placed("u::mast", True),
)
WORLD_LINK = """<robot name="u"><link name="world"/><link name="a"><inertial><origin xyz="0.2 0 0"/><mass value="1"/>\
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0"
ixz="0" iyz="0"/></inertial></link><joint name="j" type="continuous"><parent link="world"/><child link="a"/>\
<origin xyz="0 0 1" rpy="0 0 0.5"/><axis xyz="0 1 0"/>
<dynamics damping="0.05" friction="0.1"/></joint></robot>"""
scene(
    "urdf_world_link",
    "URDF pendulum on a link called world, damping 0.05, friction 0.1",
    "hangs on the world",
    world(ground()),
    tuple(Row(f"u::j at {t:g} s", lambda r, t=t: r.angle("u::j", t), gazebo=(1e-4, 2e-5), default=(2e-3, 1e-3)) for t in (0.3, 0.6, 1.0)),
    1.2,
    [Deed("spawn", "{folder}/robot.urdf")],
    {"robot.urdf": WORLD_LINK},
)
