#!/usr/bin/env python3
"""Lock-step: what the simulation publishes arrives, all of it, at subscribers in other processes that are as slow as they like."""

import json
import os
import signal
import subprocess
import sys
import threading

import rospy
import rostest
from listening import Ear, connections, until
from models import link, plugin, sdf
from plugin_world import PluginWorld
from rosgraph_msgs.msg import Log

COUNTING = os.path.join(os.path.dirname(os.path.abspath(__file__)), "counting.py")
PICTURES, TRUTH, STATES = "/eye/image_raw", "/truth", "/gazebo/model_states"


class Counter:
    """A process of counting.py, connected to the simulator."""

    def __init__(self, case, seconds, *topics):
        before = {topic: connections(topic) for topic in topics}
        self.process = subprocess.Popen(
            [sys.executable, COUNTING, str(seconds), *topics], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        case.addCleanup(self.end)
        for topic in topics:
            until(lambda topic=topic: connections(topic) - before[topic], f"connection of {topic}")

    def counts(self):
        self.process.stdin.write("\n")
        self.process.stdin.flush()
        return json.loads(self.process.stdout.readline())

    def end(self):
        self.process.kill()
        self.process.communicate()


class Lockstep(PluginWorld):
    def setUp(self):
        camera = f"""<sensor name="eye" type="camera"><update_rate>30</update_rate><camera><image><width>640</width>
            <height>480</height></image></camera>{
            plugin("gazebo_ros_camera", cameraName="eye", imageTopicName="image_raw", robotNamespace="/")
        }</sensor>"""
        self.spawn(
            "watcher",
            sdf(link("l", extra=camera), plugin("gazebo_ros_p3d", bodyName="l", topicName="truth", robotNamespace="/"), static=True),
            0,
            0,
            1,
        )
        self.addCleanup(self._delete_model, "watcher")

    def test_nothing_is_lost_on_the_way(self):
        """2 s: 60 pictures at 30 Hz, 2 000 messages of a plugin that speaks in every step into a queue of one."""
        brisk, slow = Counter(self, 0, PICTURES, TRUTH), Counter(self, 0.002, PICTURES, TRUTH)
        self.step(2.0)
        for counter in (brisk, slow):
            until(
                lambda counter=counter: counter.counts()[TRUTH] >= 2000 and counter.counts()[PICTURES] >= 60, "all messages; there are", 90
            )
            self.assertEqual(counter.counts(), {PICTURES: 60, TRUTH: 2000})

    def held_up(self):
        """A thread that makes steps, which a subscriber holds up, and what they have given in the end."""
        done = []
        with Ear("/rosout", Log) as log:
            stepping = threading.Thread(target=lambda: done.append(self._step(1500).success), daemon=True)
            stepping.start()
            until(
                lambda: any(
                    "lock-step: the simulation stood still" in m.msg and "/counting" in m.msg and PICTURES in m.msg for m in log.messages
                ),
                "line about the subscriber",
            )
        return stepping, done

    def test_a_subscriber_that_stands_still_is_waited_for_and_told_of(self):
        stuck = Counter(self, 0, PICTURES)
        os.kill(stuck.process.pid, signal.SIGSTOP)
        self.addCleanup(os.kill, stuck.process.pid, signal.SIGCONT)
        stepping, done = self.held_up()
        self.assertTrue(self._get_model_state("watcher", "").success)  # whoever waits for an answer gets it
        self.assertEqual(done, [])
        os.kill(stuck.process.pid, signal.SIGCONT)
        stepping.join(60)
        self.assertEqual(done, [True])
        until(lambda: stuck.counts()[PICTURES] >= 45, "all pictures")
        self.assertEqual(stuck.counts()[PICTURES], 45)

    def test_a_subscriber_that_ends_is_not_waited_for(self):
        gone = Counter(self, 0, PICTURES)
        os.kill(gone.process.pid, signal.SIGSTOP)
        stepping, done = self.held_up()
        gone.process.kill()
        stepping.join(60)
        self.assertEqual(done, [True])


if __name__ == "__main__":
    rospy.init_node("lockstep_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "lockstep", Lockstep)
