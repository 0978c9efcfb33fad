"""Small Collada files with a skin and an animation, and worlds with an actor, for the tests of actors."""

#: root "hips" (axes as the world's) at z = 1, and an "arm" 0.5 m above it; a tetrahedron hangs on each.
RIG = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><created>2024-01-01T00:00:00</created>
<modified>2024-01-01T00:00:00</modified><unit name="u" meter="{unit}"/><up_axis>Z_UP</up_axis></asset>
<library_effects><effect id="red-effect"><profile_COMMON><technique sid="common"><lambert><diffuse><color>1 0 0 1</color></diffuse>
</lambert></technique></profile_COMMON></effect></library_effects>
<library_materials><material id="red" name="red"><instance_effect url="#red-effect"/></material></library_materials>
<library_geometries><geometry id="body" name="body"><mesh>
<source id="points"><float_array id="points-a" count="24">{points}</float_array><technique_common>
<accessor source="#points-a" count="8" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
<param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="corners"><input semantic="POSITION" source="#points"/></vertices>
<triangles material="cloth" count="8"><input semantic="VERTEX" source="#corners" offset="0"/>
<p>0 2 1 0 1 3 0 3 2 1 2 3 4 6 5 4 5 7 4 7 6 5 6 7</p></triangles></mesh></geometry></library_geometries>
<library_controllers><controller id="skin-of-it"><skin source="#body">
<bind_shape_matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind_shape_matrix>
<source id="joints"><Name_array id="joints-a" count="2">{joints}</Name_array></source>
<source id="bind"><float_array id="bind-a" count="32">1 0 0 0 0 1 0 0 0 0 1 {bind} 0 0 0 1
1 0 0 0 0 1 0 0 0 0 1 {arm_bind} 0 0 0 1</float_array></source>
<source id="weights"><float_array id="weights-a" count="1">1</float_array></source>
<joints><input semantic="JOINT" source="#joints"/><input semantic="INV_BIND_MATRIX" source="#bind"/></joints>
<vertex_weights count="8"><input semantic="JOINT" source="#joints" offset="0"/><input semantic="WEIGHT" source="#weights" offset="1"/>
<vcount>1 1 1 1 1 1 1 1</vcount><v>{v}</v></vertex_weights></skin></controller></library_controllers>
{animation}
<library_visual_scenes><visual_scene id="scene" name="scene">
<node id="hips-id" name="hips" sid="hips" type="JOINT"><matrix sid="transform">1 0 0 0 0 1 0 0 0 0 1 {high} 0 0 0 1</matrix>
<node id="arm-id" name="arm" sid="arm" type="JOINT"><translate sid="place">0 0 {arm}</translate>
<rotate sid="bend">0 1 0 0</rotate></node></node>
<node id="it" name="it"><instance_controller url="#skin-of-it"><skeleton>#hips-id</skeleton><bind_material><technique_common>
<instance_material symbol="cloth" target="#red"/></technique_common></bind_material></instance_controller></node>
</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#scene"/></scene></COLLADA>"""

#: In 2 s the hips go 1 m along x and 0.1 m up, and the arm bends by 90 degrees about y.
ANIMATION = """<library_animations>
<animation id="a1"><source id="t1"><float_array id="t1-a" count="3">0 1 2</float_array></source>
<source id="v1"><float_array id="v1-a" count="48">1 0 0 0 0 1 0 0 0 0 1 {h0} 0 0 0 1 1 0 0 {x1} 0 1 0 0 0 0 1 {h1} 0 0 0 1
1 0 0 {x2} 0 1 0 0 0 0 1 {h0} 0 0 0 1</float_array></source>
<sampler id="s1"><input semantic="INPUT" source="#t1"/><input semantic="OUTPUT" source="#v1"/></sampler>
<channel source="#s1" target="hips-id/transform"/></animation>
<animation id="a2"><source id="t2"><float_array id="t2-a" count="2">0 2</float_array></source>
<source id="v2"><float_array id="v2-a" count="2">0 90</float_array></source>
<sampler id="s2"><input semantic="INPUT" source="#t2"/><input semantic="OUTPUT" source="#v2"/></sampler>
<channel source="#s2" target="arm-id/bend.ANGLE"/></animation></library_animations>"""

SOLID = ((0, 0, 0), (0.2, 0, 0), (0, 0.2, 0), (0, 0, 0.2))


def rig(animated=True, unit=1.0, joints="hips arm", v="0 0 0 0 0 0 0 0 1 0 1 0 1 0 1 0"):
    """Text of the file. ``unit``: m, in which it is written; it stands for the same person."""
    points = [c / unit for base in (1.0, 1.5) for x, y, z in SOLID for c in (x, y, z + base)]
    animation = ANIMATION.format(h0=1.0 / unit, h1=1.1 / unit, x1=0.5 / unit, x2=1.0 / unit) if animated else ""
    return RIG.format(
        unit=unit,
        points=" ".join(map(str, points)),
        joints=joints,
        bind=-1.0 / unit,
        arm_bind=-1.5 / unit,
        v=v,
        animation=animation,
        high=1.0 / unit,
        arm=0.5 / unit,
    )


WALK = """<trajectory id="0" type="walk"><waypoint><time>0</time><pose>0 2 0 0 0 0</pose></waypoint>
<waypoint><time>4</time><pose>4 2 0 0 0 0</pose></waypoint></trajectory>"""


def actor(skin, script=f"<loop>true</loop>{WALK}", extra="", animation="", name="walker", scale=1.0):
    """``<actor>``; its skin is its animation 'walk' as well, which goes with the way."""
    animation = animation or (f'<animation name="walk"><filename>{skin}</filename><interpolate_x>true</interpolate_x></animation>')
    return (
        f'<actor name="{name}"><pose>7 7 7 0 0 0</pose><skin><filename>{skin}</filename><scale>{scale}</scale></skin>{animation}'
        f"<script>{script}</script>{extra}</actor>"
    )


def world(*parts):
    return f'<sdf version="1.6"><world name="w">{"".join(parts)}</world></sdf>'


#: The same two bones as motion capture; the arm bends by 90 degrees about y in a second.
BVH = """HIERARCHY
ROOT hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Yrotation Xrotation
  JOINT arm
  {
    OFFSET 0 0 20
    CHANNELS 3 Zrotation Yrotation Xrotation
    End Site
    {
      OFFSET 0 0 10
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.5
5 6 7 0 0 0 0 0 0
5 6 7 0 0 0 0 45 0
5 6 7 0 0 0 0 90 0
"""
