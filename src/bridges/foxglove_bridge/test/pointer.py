#!/usr/bin/env python3
"""A robot without a simulator: its joint is where the last command of /turn_controller/command put it, and a camera sees green."""

import math

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped
from sensor_msgs.msg import Image, JointState
from tf2_msgs.msg import TFMessage
from trajectory_msgs.msg import JointTrajectory

rospy.init_node("pointer")
rospy.set_param("/turn_controller/joints", ["turn"])
angle = [0.25]
rospy.Subscriber("/turn_controller/command", JointTrajectory, lambda message: angle.append(message.points[-1].positions[0]))
states = rospy.Publisher("/joint_states", JointState, queue_size=1)
frames = rospy.Publisher("/tf", TFMessage, queue_size=1)
pictures = rospy.Publisher("/camera/image_raw", Image, queue_size=1)
rate = rospy.Rate(10)
while not rospy.is_shutdown():
    now = rospy.Time.now()
    moved = TransformStamped(child_frame_id="arm")
    moved.header.frame_id, moved.header.stamp = "base_link", now
    moved.transform.rotation = Quaternion(0.0, 0.0, math.sin(angle[-1] / 2), math.cos(angle[-1] / 2))
    state = JointState(name=["turn"], position=angle[-1:])
    picture = Image(height=20, width=40, encoding="rgb8", step=120, data=bytes((0, 200, 0)) * 800)
    state.header.stamp = picture.header.stamp = now
    frames.publish(TFMessage([moved]))
    states.publish(state)
    pictures.publish(picture)
    rate.sleep()
