"""A node of ROS 2, run by ROS 2's own Python: orders come as lines of JSON, and so go the answers.

All that rclpy makes is made by the executor's one thread, which would see things half made otherwise.
"""

import json
import queue
import sys
import threading

import rclpy
from builtin_interfaces.msg import Duration
from control_msgs.action import FollowJointTrajectory, GripperCommand
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Image, JointState
from std_msgs.msg import Float64, Int32, String
from std_srvs.srv import SetBool
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectoryPoint

KINDS = {kind.__name__: kind for kind in (Clock, Float64, Image, Int32, JointState, String, TFMessage)}
LATCHED = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
SAYING = threading.Lock()
PROFILES = {"": QoSProfile(depth=100), "latched": LATCHED, "sensor": qos_profile_sensor_data}


def say(**words):
    with SAYING:  # threads of the executor say things at one time, and print writes the end of a line by itself
        print(json.dumps(words), flush=True)


class Node:
    def __init__(self):
        rclpy.init()
        self.node = rclpy.create_node("tester")
        self.executor = SingleThreadedExecutor()
        self.executor.add_node(self.node)
        threading.Thread(target=self.executor.spin, daemon=True).start()
        self.publishers, self.kept = {}, []

    def made(self, make, *words):
        """What ``make`` makes of the node and ``words`` in the executor's thread, for another one."""
        done = queue.SimpleQueue()
        self.executor.create_task(lambda: done.put(make(self.node, *words)))
        return done.get()

    def hear(self, topic, kind, profile=""):
        def take(message):
            say(heard=topic, data=bytes(serialize_message(message)).hex())

        self.kept.append(self.node.create_subscription(KINDS[kind], topic, take, PROFILES[profile]))

    def advertise(self, topic, kind, profile=""):
        self.publishers[topic] = self.node.create_publisher(KINDS[kind], topic, PROFILES[profile])

    def publish(self, topic, data):
        self.publishers[topic].publish(bytes.fromhex(data))

    def echo(self, topic, back):
        publisher = self.node.create_publisher(Float64, back, 10)
        self.kept.append(self.node.create_subscription(Float64, topic, publisher.publish, 10))

    def serve(self, name):
        def answer(request, response):
            response.success, response.message = not request.data, "of ROS 2"
            return response

        self.kept.append(self.node.create_service(SetBool, name, answer))

    def call(self, name, value):
        client = self.made(type(self.node).create_client, SetBool, name)
        client.wait_for_service(20.0)
        answer = client.call(SetBool.Request(data=value))
        say(called=name, success=answer.success, message=answer.message)

    def goal(self, name, positions, joints, seconds, cancel=""):
        """:param cancel: "moving" or "at once"; "" for not at all"""
        client = self.made(ActionClient, FollowJointTrajectory, name)
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = joints
        goal.trajectory.points = [JointTrajectoryPoint(positions=positions, time_from_start=Duration(sec=seconds))]
        client.wait_for_server(20.0)
        feedback, told = [], threading.Event()
        done = threading.Event()

        def tell(message):
            feedback.append(message)
            say(progress=name)
            told.set()

        sent = client.send_goal_async(goal, feedback_callback=tell)
        sent.add_done_callback(lambda _: done.set())
        done.wait(20.0)
        if cancel:
            told.wait(20.0 if cancel == "moving" else 0.0)
            sent.result().cancel_goal_async()
        ended = threading.Event()
        result = sent.result().get_result_async()
        result.add_done_callback(lambda _: ended.set())
        ended.wait(60.0)
        answer = result.result()
        say(ended=name, status=answer.status, code=answer.result.error_code, text=answer.result.error_string, feedback=len(feedback))

    def serve_action(self, name, until_cancelled=False):
        canceled = {}  # what will be true, by the bytes of a goal's number

        def accept(handle):
            canceled[bytes(handle.goal_id.uuid)] = self.executor.create_future()
            handle.execute()

        def cancel(handle):
            canceled[bytes(handle.goal_id.uuid)].set_result(True)
            return CancelResponse.ACCEPT

        async def execute(handle):
            say(begun=name)
            feedback = FollowJointTrajectory.Feedback(joint_names=handle.request.trajectory.joint_names)
            handle.publish_feedback(feedback)
            if until_cancelled:
                await canceled[bytes(handle.goal_id.uuid)]
            (handle.canceled if until_cancelled else handle.succeed)()
            say(over=name)
            return FollowJointTrajectory.Result(error_code=-3, error_string="of ROS 2")

        self.kept.append(
            ActionServer(self.node, FollowJointTrajectory, name, execute, handle_accepted_callback=accept, cancel_callback=cancel)
        )

    def grip(self, name, position, effort):
        client = self.made(ActionClient, GripperCommand, name)
        goal = GripperCommand.Goal()
        goal.command.position, goal.command.max_effort = position, effort
        client.wait_for_server(20.0)
        answer = client.send_goal(goal)
        result = answer.result
        say(gripped=name, status=answer.status, result=[result.position, result.effort, result.stalled, result.reached_goal])

    def serve_grip(self, name):
        def execute(handle):
            command = handle.request.command
            handle.succeed()
            return GripperCommand.Result(position=command.position, effort=command.max_effort, reached_goal=True)

        self.kept.append(ActionServer(self.node, GripperCommand, name, execute))


def main():
    node = Node()
    say(ready=True)
    for line in sys.stdin:
        words = json.loads(line)
        run = getattr(node, words.pop("do"))
        if run.__name__ in ("call", "goal", "grip"):  # these wait for answers
            threading.Thread(target=run, kwargs=words, daemon=True).start()
        else:
            node.executor.create_task(run, **words)


if __name__ == "__main__":
    main()
