"""Descriptions: URDF and SDF that are spawned, worlds that are loaded."""
from __future__ import annotations

import os
from pathlib import Path
from random import Random
from typing import Iterator, List

from fuzzing import seeds, worlds, xml_cases
from fuzzing.findings import Found, refused
from fuzzing.kinds import Kind

GROUND = ("<sdf version='1.6'><world name='w'><model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane/>"
          "</geometry></collision></link></model></world></sdf>")
_BOX = "<geometry><box><size>0.5 0.5 0.5</size></box></geometry>"
_LINK = (f"<link name='extra'><pose>0 0 1 0 0 0</pose><inertial><mass>1</mass></inertial><collision name='c'>{_BOX}<max_contacts>3"
         "</max_contacts></collision></link>")
_SENSORS = ["<sensor name='s' type='ray'><update_rate>10</update_rate><ray><scan><horizontal><samples>5</samples><min_angle>-1</min_angle>"
            "<max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>5</max></range></ray></sensor>",
            "<sensor name='c' type='camera'><camera><image><width>8</width><height>8</height></image><clip><near>0.1</near><far>9</far></clip>"
            "</camera></sensor>", "<sensor name='i' type='imu'/>", "<sensor name='b' type='contact'><contact><collision>c</collision></contact></sensor>"]
_SURFACE = ("<surface><bounce><restitution_coefficient>0.5</restitution_coefficient></bounce><friction><ode><mu>1</mu><mu2>1</mu2><slip1>0.1"
            "</slip1><fdir1>1 0 0</fdir1></ode></friction><contact><ode><kp>1e6</kp><kd>1</kd><max_vel>0.1</max_vel><min_depth>0.001"
            "</min_depth></ode></contact></surface>")
_JOINTS = [f"<joint name='j{kind}' type='{kind}'><parent>world</parent><child>extra</child><axis><xyz>0 0 1</xyz><limit><lower>-1</lower>"
           "<upper>1</upper><effort>10</effort><velocity>1</velocity></limit><dynamics><damping>0.1</damping><friction>0.1</friction>"
           "<spring_stiffness>1</spring_stiffness><spring_reference>0</spring_reference></dynamics></axis>"
           + ("<axis2><xyz>0 1 0</xyz></axis2>" if kind in ("universal", "revolute2") else "") + "</joint>"
           for kind in ("revolute", "prismatic", "fixed", "ball", "universal", "revolute2", "screw", "gearbox", "continuous")]
_GEOMETRIES = ["<geometry><heightmap><uri>file://media/materials/textures/grass.png</uri><size>10 10 1</size></heightmap></geometry>",
               "<geometry><polyline><point>0 0</point><point>1 0</point><point>1 1</point><height>1</height></polyline></geometry>",
               "<geometry><capsule><radius>0.1</radius><length>0.5</length></capsule></geometry>",
               "<geometry><mesh><uri>model://coke_can/meshes/coke_can.dae</uri><scale>1 1 1</scale></mesh></geometry>", _BOX,
               "<geometry><sphere><radius>0.3</radius></sphere></geometry>"]
SDF_SNIPPETS = {
    "model": [_LINK, *_JOINTS, "<static>1</static>", "<pose>0 0 1 0 0 0</pose>", f"<model name='inner'>{_LINK}</model>",
              "<plugin name='p' filename='libx.so'><a>1</a></plugin>", "<include><uri>model://coke_can</uri><pose>0 0 1 0 0 0</pose></include>",
              "<frame name='f' attached_to='extra'><pose>1 0 0 0 0 0</pose></frame>", "<allow_auto_disable>1</allow_auto_disable>",
              "<self_collide>1</self_collide>"],
    "link": [*_SENSORS, f"<collision name='more'>{_BOX}{_SURFACE}</collision>", f"<visual name='v'>{_BOX}</visual>", "<gravity>0</gravity>",
             "<kinematic>1</kinematic>", "<velocity_decay><linear>1</linear><angular>1</angular></velocity_decay>", "<inertial><mass>0.1</mass>"
             "<inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>",
             "<light name='li' type='spot'><direction>0 0 -1</direction></light>"],
    "collision": [*_GEOMETRIES, _SURFACE, "<max_contacts>5</max_contacts>", "<laser_retro>1</laser_retro>"],
    "visual": [*_GEOMETRIES, "<material><script><uri>file://x</uri><name>Gazebo/Red</name></script></material>"],
    "world": [f"<model name='m'>{_LINK}</model>", "<include><uri>model://cafe_table</uri></include>", "<gravity>0 0 -9.8</gravity>",
              "<physics type='ode'><max_step_size>0.001</max_step_size><real_time_update_rate>1000</real_time_update_rate><max_contacts>20"
              "</max_contacts><ode><solver><iters>50</iters><sor>1.3</sor></solver><constraints><cfm>0</cfm><erp>0.2</erp>"
              "<contact_max_correcting_vel>100</contact_max_correcting_vel><contact_surface_layer>0.001</contact_surface_layer></constraints>"
              "</ode></physics>", "<state world_name='default'><sim_time>5 100</sim_time><iterations>7</iterations><model name='m'>"
              "<pose>1 0 0 0 0 0</pose><scale>2 2 2</scale><link name='extra'><pose>0 0 1 0 0 0</pose><velocity>1 0 0 0 0 1</velocity></link>"
              "</model></state>", f"<population name='p'><model name='can'>{_LINK}</model><pose>0 0 0 0 0 0</pose><box><size>2 2 0.01</size></box>"
              "<model_count>4</model_count><distribution><type>grid</type><rows>2</rows><cols>2</cols><step>1 1 0</step></distribution>"
              "</population>", "<light name='l2' type='point'><attenuation><range>5</range></attenuation></light>", "<wind><linear_velocity>1 0 0"
              "</linear_velocity></wind>", "<road name='r'><width>1</width><point>0 0 0</point><point>1 0 0</point></road>",
              "<actor name='a'><skin><filename>walk.dae</filename></skin></actor>", "<spherical_coordinates><latitude_deg>1</latitude_deg>"
              "</spherical_coordinates>", "<scene><ambient>0 0 0 1</ambient><sky/></scene>"],
}
_INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
URDF_SNIPPETS = {
    "robot": [f'<link name="extra">{_INERTIAL}<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>',
              '<joint name="je" type="revolute"><parent link="base_link"/><child link="extra"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" '
              'effort="5" velocity="1"/><dynamics damping="0.1" friction="0.1"/></joint>',
              '<joint name="jf" type="floating"><parent link="base_link"/><child link="extra"/></joint>',
              '<joint name="jm" type="continuous"><parent link="extra"/><child link="link1"/><mimic joint="je" multiplier="2" offset="0.1"/></joint>',
              '<gazebo reference="base_link"><mu1>0.5</mu1><kp>1e6</kp><maxContacts>4</maxContacts><maxVel>1</maxVel><minDepth>0.001</minDepth>'
              '<selfCollide>1</selfCollide><material>Gazebo/Red</material></gazebo>', "<gazebo><static>1</static></gazebo>",
              '<gazebo reference="je"><stopErp>0.2</stopErp><stopCfm>0</stopCfm><provideFeedback>1</provideFeedback><preserveFixedJoint>1'
              '</preserveFixedJoint></gazebo>', '<gazebo><plugin name="p" filename="libgazebo_ros_control.so"><a>1</a></plugin></gazebo>',
              '<material name="m"><color rgba="1 0 0 1"/></material>', "<gazebo>" + _JOINTS[0] + "</gazebo>"],
    "link": [_INERTIAL, '<collision><origin xyz="0 0 1"/><geometry><sphere radius="0.2"/></geometry></collision>',
             '<visual><geometry><mesh filename="package://arm_description/meshes/base_link.stl" scale="1 1 1"/></geometry></visual>',
             '<collision><geometry><mesh filename="package://arm_description/meshes/wrist.stl"/></geometry></collision>'],
    "gazebo": ["<sensor name='c' type='camera'><camera/></sensor>", *_SENSORS, "<laserRetro>1</laserRetro>", "<turnGravityOff>1</turnGravityOff>"],
    "joint": ['<mimic joint="j0" multiplier="1" offset="0"/>', '<limit lower="0" upper="1" effort="1" velocity="1"/>',
              '<safety_controller soft_lower_limit="0" k_velocity="1"/>', '<dynamics damping="1"/>', '<origin xyz="0 0 1" rpy="0 0 1"/>'],
}


class _XmlKind(Kind):
    snippets = SDF_SNIPPETS

    def seeds(self) -> List[bytes]:
        raise NotImplementedError

    def load(self, text: bytes):
        """A world with what the text describes in it, None where it was refused."""
        raise NotImplementedError

    def prepare(self) -> None:
        import ode_sim  # noqa: F401  (imported here, shared by all workers)
        import ode_sim.rendering.assets  # noqa: F401
        self._mutator = xml_cases.XmlMutator(self.seeds(), self.snippets)
        for text in self.seeds():
            self.load(text)  # reads the meshes once for all workers

    def generate(self, random: Random) -> bytes:
        return self._mutator.case(random)

    def smaller(self, case: bytes) -> Iterator[bytes]:
        return xml_cases.smaller(case)

    def run(self, case: bytes) -> None:
        world = self.load(case)
        if world is None:
            return
        worlds.check_messages(world, world.problems, "problems of a description")
        worlds.settle(world)
        worlds.check_messages(world, world.messages, "messages of a world")
        worlds.check_replay(world)
        _draw(world)
        worlds.check_end(world)


class WorldKind(_XmlKind):
    """World files, as gzserver loads them."""

    name, suffix = "world", ".world"

    def seeds(self) -> List[bytes]:
        return [*seeds.worlds().values(), *(b"<sdf version='1.6'><world name='w'>" + _body(text) + b"</world></sdf>"
                                            for text in seeds.models().values())]

    def load(self, text: bytes):
        import ode_sim
        Path("case.world").write_bytes(text)
        world, _ = refused(lambda: ode_sim.World.load(os.path.abspath("case.world"), finder=seeds.finder()), ode_sim.DescriptionError)
        return world


class SdfKind(_XmlKind):
    """Models of SDF, spawned beside others."""

    name, suffix = "sdf", ".sdf"
    call = "spawn_sdf"

    def seeds(self) -> List[bytes]:
        return list(seeds.models().values())

    def load(self, text: bytes):
        import ode_sim
        world = ode_sim.World.load(GROUND, finder=seeds.finder())
        world.step(1)
        before = world.save()
        handle, error = refused(lambda: getattr(world, self.call)(as_text(text), name="fuzzed", pose=ode_sim.Pose((0.0, 0.0, 0.5))),
                                ode_sim.DescriptionError)
        if error is None:
            return world
        if world.save() != before or list(world.models) != ["ground"] or len(world.link_poses) != 1:
            raise Found("left behind", "state differs after a spawn that failed", str(error))
        worlds.check_rays(world)
        worlds.settle(world, 2)
        return None


class UrdfKind(SdfKind):
    """Robots of URDF, spawned beside others."""

    name, suffix, call = "urdf", ".urdf", "spawn_urdf"
    snippets = URDF_SNIPPETS

    def seeds(self) -> List[bytes]:
        return list(seeds.robots().values())


def as_text(case: bytes) -> str:
    """As the server gets it in a message."""
    return case.decode("utf-8", "surrogateescape")


def _body(text: bytes) -> bytes:
    """What stands in the <sdf> of a file."""
    return text[text.index(b">", text.index(b"<sdf")) + 1:text.rindex(b"</sdf>")]


def _draw(world) -> None:
    """What a camera would be told to draw: meshes and textures are read, nothing is rendered."""
    from ode_sim.rendering.assets import Assets
    assets = Assets()
    for model in world.models.values():
        for link in model.links.values():
            for visual in link.description.visuals:
                for part in assets.parts(visual, f"{link.scoped_name}::{visual.name}"):
                    if part.look.texture:
                        assets.texture(part.look.texture, visual.name)
    worlds.check_messages(world, assets.problems, "problems of drawing")
