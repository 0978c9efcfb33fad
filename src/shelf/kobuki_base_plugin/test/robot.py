"""A base as Kobuki's is, of simple shapes: SDF. Lengths m, masses kg."""


def _wheel(side, y):
    return f"""<link name="wheel_{side}_link"><pose>0 {y} 0.035 0 0 0</pose>
      <inertial><mass>0.1</mass><inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial>
      <collision name="c"><pose>0 0 0 1.5707963267948966 0 0</pose>
        <geometry><cylinder><radius>0.035</radius><length>0.02</length></cylinder></geometry></collision></link>
    <joint name="wheel_{side}_joint" type="revolute"><parent>base_footprint</parent><child>wheel_{side}_link</child>
      <axis><xyz>0 1 0</xyz></axis></joint>"""


def _cliff(name, x, y):
    return f"""<sensor name="{name}" type="ray"><pose>{x} {y} 0.015 0 1.5707963267948966 0</pose>
      <ray><scan><horizontal><samples>1</samples><min_angle>0</min_angle><max_angle>0</max_angle></horizontal></scan>
      <range><min>0.01</min><max>0.15</max></range></ray></sensor>"""


def _caster(x):
    return f"""<collision name="caster_{x}"><pose>{x} 0 0.0176 0 0 0</pose>
      <geometry><sphere><radius>0.0176</radius></sphere></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>"""


_TAGS = {
    "robotNamespace": "/",
    "publish_tf": 1,
    "left_wheel_joint_name": "wheel_left_joint",
    "right_wheel_joint_name": "wheel_right_joint",
    "wheel_separation": 0.23,
    "wheel_diameter": 0.07,
    "torque": 1.0,
    "velocity_command_timeout": 0.6,
    "cliff_sensor_left_name": "cliff_left",
    "cliff_sensor_center_name": "cliff_front",
    "cliff_sensor_right_name": "cliff_right",
    "cliff_detection_threshold": 0.04,
    "imu_name": "imu",
}


def sdf(**tags):
    """:param tags: of the plugin, in place of the usual ones; None leaves one out."""
    tags = "".join(f"<{tag}>{value}</{tag}>" for tag, value in {**_TAGS, **tags}.items() if value is not None)
    return f"""<sdf version="1.6"><model name="mobile_base"><link name="base_footprint">
      <inertial><pose>0 0 0.03 0 0 0</pose><mass>2.4</mass>
        <inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.03</izz></inertia></inertial>
      <collision name="body"><pose>0 0 0.0724 0 0 0</pose>
        <geometry><cylinder><radius>0.1765</radius><length>0.11</length></cylinder></geometry></collision>
      {_caster(0.135)}{_caster(-0.135)}
      {_cliff("cliff_left", 0.087, 0.137)}{_cliff("cliff_front", 0.156, 0)}{_cliff("cliff_right", 0.087, -0.137)}
      <sensor name="imu" type="imu"><pose>0.056 0.062 0.02 0 0 0</pose></sensor></link>
      {_wheel("left", 0.115)}{_wheel("right", -0.115)}
      <plugin name="kobuki_controller" filename="libgazebo_ros_kobuki.so">{tags}</plugin></model></sdf>"""
