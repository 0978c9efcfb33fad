"""A robot of a few joints under the plugin, in this process: the test steps the world itself."""

import contextlib
import logging
import threading
import xml.etree.ElementTree as ET

import ode_sim
import rospy
from gazebo_ros.sdf_element import SdfElement
from gazebo_ros_control.plugin import GazeboRosControl
from std_msgs.msg import Float64

DT = 0.001

#: A horizontal arm on a vertical axis: nothing but inertia (0.5 * 0.25 + 0.01 about the axis) acts on it.
JOINT = """
  <joint name="{name}" type="{kind}">
    <parent link="world"/><child link="{name}_link"/><origin xyz="0 {y} 1"/><axis xyz="0 0 1"/>{limit}
  </joint>
  <link name="{name}_link">
    <inertial><origin xyz="0.5 0 0"/><mass value="0.5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  </link>"""
INERTIA = 0.5 * 0.25 + 0.01
LIMIT = '<limit lower="-3" upper="3" effort="10" velocity="0.5"/>'
NO_LIMIT = '<limit lower="-1e9" upper="1e9" effort="1e9" velocity="1e9"/>'
POSITION, VELOCITY, EFFORT = (f"hardware_interface/{kind}JointInterface" for kind in ("Position", "Velocity", "Effort"))
FORWARD = {
    "pos": {"type": "position_controllers/JointPositionController", "joint": "j"},
    "vel": {"type": "velocity_controllers/JointVelocityController", "joint": "j"},
    "eff": {"type": "effort_controllers/JointEffortController", "joint": "j"},
    "states": {"type": "joint_state_controller/JointStateController", "publish_rate": 100},
}


def joint(name, limit=LIMIT, kind="revolute", y=0.0):
    return JOINT.format(name=name, limit=limit, kind=kind, y=y)


def transmission(name, joint_name, *interfaces, joints=""):
    tags = "".join(f"<hardwareInterface>{interface}</hardwareInterface>" for interface in interfaces)
    return (
        f'<transmission name="{name}"><type>transmission_interface/SimpleTransmission</type>'
        f'<joint name="{joint_name}">{tags}</joint>{joints}'
        f'<actuator name="{name}_motor"><mechanicalReduction>50</mechanicalReduction></actuator></transmission>'
    )


def urdf(*parts):
    return f'<robot name="robot"><link name="world"/>{"".join(parts)}</robot>'


def one_joint(*interfaces, limit=LIMIT, kind="revolute"):
    return urdf(joint("j", limit, kind), transmission("t", "j", *interfaces))


def gains(**values):
    return {**FORWARD, "gazebo_ros_control": {"pid_gains": {"j": values}}}


class Log(logging.Handler):
    """What rospy logs."""

    def __init__(self):
        super().__init__()
        self.lines = []

    def emit(self, record):
        self.lines.append((record.levelname, record.getMessage()))

    def having(self, *parts, level=None):
        return [line for name, line in self.lines if all(part in line for part in parts) and level in (None, name)]

    @classmethod
    @contextlib.contextmanager
    def recorded(cls):
        log = cls()
        logging.getLogger("rosout").addHandler(log)
        try:
            yield log
        finally:
            logging.getLogger("rosout").removeHandler(log)


class Server:
    """What the plugin needs of the simulator's server."""

    def __init__(self, world):
        self.world = world
        self.driven = []  # names of joints, each time the plugin says that it drives some

    def drives(self, *joints):
        self.driven += [[joint.name for joint in joints]] if joints else []

    def before_step(self, f):
        def call(world):
            try:
                f()
            except Exception as error:  # as the simulator's server
                rospy.logerr("%s", error)
                world.before_step.remove(call)

        self.world.before_step.append(call)

    def call(self, f):
        return f()


class SimulatedRobot:
    """``step`` and ``run`` move time; ``switch`` asks for controllers and steps until they have changed."""

    def __init__(
        self,
        description,
        plugin="<robotNamespace>/robot</robotNamespace>",
        parameters=None,
        name="model",
        describe=True,
        namespace="/robot",
    ):
        self.namespace = namespace
        if rospy.has_param("/robot"):
            rospy.delete_param("/robot")
        if rospy.has_param("/robot_description"):
            rospy.delete_param("/robot_description")
        if parameters:
            rospy.set_param("/robot", parameters)
        if describe:
            rospy.set_param("/robot_description", description)
        self.world = ode_sim.World()
        self.model = self.world.spawn_urdf(description, name=name)
        self.plugin = GazeboRosControl()
        self.sdf = SdfElement(ET.fromstring(f"<plugin>{plugin}</plugin>"))

    def load(self):
        self.server = Server(self.world)
        self.plugin.load(self.server, self.model, self.sdf)
        return self

    def __enter__(self):
        return self.load()

    def __exit__(self, *_):
        self.plugin.shutdown()

    @property
    def manager(self):
        return self.plugin._manager

    @property
    def hw(self):
        return self.plugin._hw

    def joint(self, name="j"):
        return self.model.joints[name]

    def handle(self, interface, name="j"):
        """The command handle of a joint, as controllers see it."""
        return next(handle for handle in self.hw.get(interface).handles() if handle.name == name)

    def step(self, count=1):
        self.world.step(count)

    def run(self, seconds):
        self.world.step(round(seconds / DT))

    def start(self, *names):
        for name in names:
            assert self.manager.load_controller(name), name
        self.switch(names)

    def switch(self, start=(), stop=()):
        answer = []
        request = threading.Thread(target=lambda: answer.append(self.manager.switch_controller(list(start), list(stop))))
        request.start()
        while request.is_alive():
            if self.manager._switch is not None:
                self.step()
            request.join(0.002)
        assert answer == [True], (start, stop)

    def controller(self, name):
        return next(loaded.controller for loaded in self.manager.controllers if loaded.name == name)

    def command(self, name, value):
        """As if a message had come on the controller's command topic."""
        self.controller(name)._receive(Float64(value))

    def state(self, name):
        return self.controller(name).state.value
