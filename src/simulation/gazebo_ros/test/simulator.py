"""What the rostests share: service calls in one line, and the simulator under the namespace of the test."""

import functools

import rospy
import test_support
from gazebo_msgs import srv
from gazebo_msgs.msg import LinkState, ModelState, ODEJointProperties, ODEPhysics
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Wrench
from rosgraph_msgs.msg import Log
from std_msgs.msg import Bool
from std_srvs.srv import Empty
from test_support.hearing import heard

BOX = """<sdf version="1.6"><model name="any"><link name="link">
<inertial><mass>{mass}</mass></inertial>
<collision name="c"><geometry>{geometry}</geometry></collision></link>{extra}</model></sdf>"""

URDF = """<robot name="any"><link name="base">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tip"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="elbow" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="5" velocity="5"/></joint>{extra}</robot>"""


def box(mass=1.0, geometry="<box><size>1 1 1</size></box>", extra=""):
    return BOX.format(mass=mass, geometry=geometry, extra=extra)


def urdf(extra=""):
    return URDF.format(extra=extra)


def pose(x=0.0, y=0.0, z=0.0, qx=0.0, qy=0.0, qz=0.0, qw=1.0):
    return Pose(Point(x, y, z), Quaternion(qx, qy, qz, qw))


def twist(linear=(0.0, 0.0, 0.0), angular=(0.0, 0.0, 0.0)):
    return Twist(Vector3(*linear), Vector3(*angular))


def xyz(vector):
    return (vector.x, vector.y, vector.z)


class Simulator:
    """The node ``gazebo``; every method is one service call."""

    def __init__(self, namespace="/gazebo"):
        self.namespace = namespace
        rospy.wait_for_message(namespace + "/ready", Bool)

    @functools.cache  # noqa: B019 there is one object of this class
    def proxy(self, name, service):
        rospy.wait_for_service(f"{self.namespace}/{name}", 60)
        return rospy.ServiceProxy(f"{self.namespace}/{name}", service, persistent=True)

    def step(self, steps):
        return self.proxy("step", StepWorld)(steps)

    def empty(self, name):
        self.proxy(name, Empty)()

    def world(self):
        return self.proxy("get_world_properties", srv.GetWorldProperties)()

    def clear(self):
        """Delete all models but the ground."""
        for name in self.world().model_names:
            if name != "ground_plane":
                self.delete(name)

    def model(self, name, frame=""):
        return self.proxy("get_model_state", srv.GetModelState)(name, frame)

    def link(self, name, frame=""):
        return self.proxy("get_link_state", srv.GetLinkState)(name, frame)

    def joint(self, name):
        return self.proxy("get_joint_properties", srv.GetJointProperties)(name)

    def set_model(self, name, pose=pose(), twist=twist(), frame=""):
        return self.proxy("set_model_state", srv.SetModelState)(ModelState(name, pose, twist, frame))

    def set_link(self, name, pose=pose(), twist=twist(), frame=""):
        return self.proxy("set_link_state", srv.SetLinkState)(LinkState(name, pose, twist, frame))

    def set_joints(self, model, names, positions):
        return self.proxy("set_model_configuration", srv.SetModelConfiguration)(model, "", names, positions)

    def set_joint(self, name, **properties):
        return self.proxy("set_joint_properties", srv.SetJointProperties)(name, ODEJointProperties(**properties))

    def push(self, link, force, duration, torque=(0.0, 0.0, 0.0), point=(0.0, 0.0, 0.0), frame="", start=0.0):
        return self.proxy("apply_body_wrench", srv.ApplyBodyWrench)(
            link, frame, Point(*point), Wrench(Vector3(*force), Vector3(*torque)), rospy.Time(start), rospy.Duration(duration)
        )

    def drive(self, joint, effort, duration, start=0.0):
        return self.proxy("apply_joint_effort", srv.ApplyJointEffort)(joint, effort, rospy.Time(start), rospy.Duration(duration))

    def spawn(self, name, text, where=pose(), frame="", namespace="", kind="sdf"):
        return self.proxy(f"spawn_{kind}_model", srv.SpawnModel)(name, text, namespace, where, frame)

    def delete(self, name):
        return self.proxy("delete_model", srv.DeleteModel)(name)

    def physics(self):
        return self.proxy("get_physics_properties", srv.GetPhysicsProperties)()

    def set_physics(self, time_step=0.001, rate=1000.0, gravity=(0.0, 0.0, -9.8), **ode):
        config = self.physics().ode_config
        values = {name: getattr(config, name) for name in ODEPhysics.__slots__}
        return self.proxy("set_physics_properties", srv.SetPhysicsProperties)(
            time_step, rate, Vector3(*gravity), ODEPhysics(**{**values, **ode})
        )


class Case(test_support.TestCase):
    """The world bench.world, paused and as it was at first. Time passes only through the step service."""

    @classmethod
    def setUpClass(cls):
        cls.sim = Simulator()

    def setUp(self):
        self.sim.empty("pause_physics")
        self.assertTrue(self.sim.set_physics(gravity=(0.0, 0.0, 0.0)).success)
        self.sim.empty("reset_simulation")
        self.sim.proxy("clear_body_wrenches", srv.BodyRequest)("crate::box")  # jobs survive a reset, as in Gazebo
        self.sim.proxy("clear_joint_forces", srv.JointRequest)("hinge")

    def done(self, response):
        self.assertTrue(response.success, response.status_message)
        return response

    def refused(self, response, *words):
        self.assertFalse(response.success)
        for word in words:
            self.assertIn(word, response.status_message)
        self.assertNotIn("internal error", response.status_message)
        self.assertNotIn("\n", response.status_message)

    def wait(self, condition):
        while not condition():
            self.assertFalse(rospy.is_shutdown())
            rospy.rostime.wallsleep(0.01)

    def clear(self, subscribers):
        """The models are gone, and so are the topics of their plugins that ``subscribers`` hear.

        rospy still asks for a topic that has gone meanwhile, and does not hear of one that comes under the same name and address then.
        """

        def published():
            names = {name for name, _ in rospy.get_published_topics()}
            return [subscriber for subscriber in subscribers if subscriber.resolved_name in names]

        self.wait(lambda: heard(published()))
        self.sim.clear()
        self.wait(lambda: not published())

    def near(self, a, b, places=9):
        for x, y in zip(a, b):
            self.assertAlmostEqual(x, y, places)


class HearingCase(Case):
    """Hears what the server says in its log, and the topics of models' plugins until they are gone."""

    def setUp(self):
        self.log, self.subscribers = [], []
        self.listen("/rosout", Log, lambda message: self.log.append(message.msg))
        self.wait(lambda: heard(self.subscribers))
        self.sim.empty("reset_simulation")

    def tearDown(self):
        self.clear(self.subscribers[1:])
        for subscriber in self.subscribers:
            subscriber.unregister()

    def listen(self, topic, kind, f):
        self.subscribers.append(rospy.Subscriber(topic, kind, f))
