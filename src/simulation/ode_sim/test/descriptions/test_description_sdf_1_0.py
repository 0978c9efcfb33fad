"""SDF 1.0: each value stands in an attribute, as sdformat's sdf/1.0/*.sdf describe; what is read is what the same file of 1.6 says."""

import pytest
from ode_sim.description import load_world
from sdf_texts import finder, models, text, world

OLDEST = """<gazebo version="1.0"><world name="w">
<physics type="ode" update_rate="500"><gravity xyz="0 0 -5"/>
  <ode><solver type="quick" dt="0.002" iters="30" sor="1.2"/>
  <constraints cfm="0.1" erp="0.3" contact_max_correcting_vel="50" contact_surface_layer="0.002"/></ode></physics>
<scene><ambient rgba="0.1 0.2 0.3 1"/><background rgba="0 0 0 1"/><shadows enabled="false"/>
  <fog rgba="1 0 0 1" type="linear" start="2" end="9" density="0.5"/></scene>
<light type="spot" name="lamp" cast_shadows="true"><origin pose="1 2 3 0 0 0"/><diffuse rgba="0.5 0.5 0.5 1"/>
  <attenuation range="7" constant="0.2" linear="0.1" quadratic="0.01"/><direction xyz="0 1 -1"/>
  <spot inner_angle="0.1" outer_angle="0.5" falloff="2"/></light>
<model name="m" static="false"><origin pose="1 2 3 0 0 0"/>
  <link name="a" gravity="false" self_collide="true"><origin pose="0 0 1 0 0 0"/><damping linear="0.1" angular="0.2"/>
    <inertial mass="2"><origin pose="0 0 0.5 0 0 0"/><inertia ixx="1" ixy="0.1" ixz="0" iyy="2" iyz="0" izz="2.5"/></inertial>
    <collision name="c" laser_retro="5"><origin pose="0 0 0.1 0 0 0"/><geometry><box size="1 2 3"/></geometry>
      <surface><bounce restitution_coefficient="0.5" threshold="2"/>
        <friction><ode mu="0.3" mu2="0.4" fdir1="1 0 0" slip1="0.1" slip2="0.2"/></friction>
        <contact><ode kp="1000" kd="2" max_vel="0.5" min_depth="0.003"/></contact></surface></collision>
    <visual name="v" cast_shadows="false" transparency="0.5"><geometry><sphere radius="0.7"/></geometry>
      <material script="Gazebo/Red"/></visual>
    <sensor name="eye" type="ray" always_on="true" update_rate="20" visualize="true"><origin pose="0 0 0.2 0 0 0"/>
      <ray><scan><horizontal samples="9" resolution="1" min_angle="-1" max_angle="1"/></scan>
      <range min="0.1" max="8" resolution="0.01"/></ray>
    </sensor></link>
  <link name="b"><collision name="c"><geometry><cylinder radius="0.2" length="0.6"/></geometry></collision></link>
  <joint name="j" type="revolute"><origin pose="0 0 0.3 0 0 0"/><parent link="a"/><child link="b"/>
    <axis xyz="0 1 0"><dynamics damping="0.7" friction="0.6"/><limit lower="-1" upper="2" effort="3" velocity="4"/></axis></joint>
  <plugin name="p" filename="libp.so"><topic name="kept">t</topic></plugin></model></world></gazebo>"""

NEWER = """
<physics type="ode"><real_time_update_rate>500</real_time_update_rate><max_step_size>0.002</max_step_size><gravity>0 0 -5</gravity>
  <ode><solver><type>quick</type><iters>30</iters><sor>1.2</sor></solver>
  <constraints><cfm>0.1</cfm><erp>0.3</erp><contact_max_correcting_vel>50</contact_max_correcting_vel>
  <contact_surface_layer>0.002</contact_surface_layer></constraints></ode></physics>
<scene><ambient>0.1 0.2 0.3 1</ambient><background>0 0 0 1</background><shadows>false</shadows>
  <fog><color>1 0 0 1</color><type>linear</type><start>2</start><end>9</end><density>0.5</density></fog></scene>
<light type="spot" name="lamp"><cast_shadows>true</cast_shadows><pose>1 2 3 0 0 0</pose><diffuse>0.5 0.5 0.5 1</diffuse>
  <attenuation><range>7</range><constant>0.2</constant><linear>0.1</linear><quadratic>0.01</quadratic></attenuation>
  <direction>0 1 -1</direction><spot><inner_angle>0.1</inner_angle><outer_angle>0.5</outer_angle><falloff>2</falloff></spot></light>
<model name="m"><static>false</static><pose>1 2 3 0 0 0</pose>
  <link name="a"><gravity>false</gravity><self_collide>true</self_collide><pose>0 0 1 0 0 0</pose>
    <velocity_decay><linear>0.1</linear><angular>0.2</angular></velocity_decay>
    <inertial><mass>2</mass><pose>0 0 0.5 0 0 0</pose>
      <inertia><ixx>1</ixx><ixy>0.1</ixy><ixz>0</ixz><iyy>2</iyy><iyz>0</iyz><izz>2.5</izz></inertia></inertial>
    <collision name="c"><laser_retro>5</laser_retro><pose>0 0 0.1 0 0 0</pose><geometry><box><size>1 2 3</size></box></geometry>
      <surface><bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>2</threshold></bounce>
        <friction><ode><mu>0.3</mu><mu2>0.4</mu2><fdir1>1 0 0</fdir1><slip1>0.1</slip1><slip2>0.2</slip2></ode></friction>
        <contact><ode><kp>1000</kp><kd>2</kd><max_vel>0.5</max_vel><min_depth>0.003</min_depth></ode></contact></surface></collision>
    <visual name="v"><cast_shadows>false</cast_shadows><transparency>0.5</transparency>
      <geometry><sphere><radius>0.7</radius></sphere></geometry>
      <material><script><name>Gazebo/Red</name></script></material></visual>
    <sensor name="eye" type="ray"><always_on>true</always_on><update_rate>20</update_rate><visualize>true</visualize>
      <pose>0 0 0.2 0 0 0</pose><ray><scan><horizontal><samples>9</samples><resolution>1</resolution><min_angle>-1</min_angle>
      <max_angle>1</max_angle></horizontal></scan><range><min>0.1</min><max>8</max><resolution>0.01</resolution></range></ray></sensor></link>
  <link name="b"><collision name="c"><geometry><cylinder><radius>0.2</radius><length>0.6</length></cylinder></geometry></collision></link>
  <joint name="j" type="revolute"><pose>0 0 0.3 0 0 0</pose><parent>a</parent><child>b</child>
    <axis><xyz>0 1 0</xyz><dynamics><damping>0.7</damping><friction>0.6</friction></dynamics>
      <limit><lower>-1</lower><upper>2</upper><effort>3</effort><velocity>4</velocity></limit></axis></joint>
  <plugin name="p" filename="libp.so"><topic name="kept">t</topic></plugin></model>"""


def told(thing):
    """What a record says, without where it stood in the file."""
    if hasattr(thing, "__dataclass_fields__"):
        return {name: told(getattr(thing, name)) for name in thing.__dataclass_fields__ if name not in ("source", "element")}
    return [told(each) for each in thing] if isinstance(thing, (list, tuple)) else thing


@pytest.mark.parametrize("part", ["gravity", "physics", "scene", "lights", "models"])
def test_it_says_what_the_same_file_of_1_4_says(part, finder):
    old, problems = load_world(OLDEST, finder)
    new, of_new = world(NEWER, finder, "1.4")  # whose axes are in the model's frame, as those before
    assert told(getattr(old, part)) == told(getattr(new, part))
    assert text(problems) == text(of_new) == ""


def test_plugins_keep_their_attributes(finder):
    old, _ = load_world(OLDEST, finder)
    (plugin,) = old.models[0].plugins
    assert plugin.filename == "libp.so" and plugin.element.find("topic").get("name") == "kept"
