"""Swings one joint like a sine around the position where it was when the controller started."""

from math import pi, sin

from controller_interface import Controller
from hardware_interface import PositionJointInterface
from std_msgs.msg import Float64


class SineController(Controller):
    interface = PositionJointInterface

    def init(self, hw, root_nh, controller_nh):
        self.joint = hw.get_handle(controller_nh.get_param("joint", str))
        self.amplitude = controller_nh.param("amplitude", 0.5)  # rad
        self.frequency = controller_nh.param("frequency", 1.0)  # Hz
        controller_nh.subscriber("amplitude", Float64, self.change_amplitude)

    def change_amplitude(self, message):
        self.amplitude = message.data

    def starting(self, time):
        self.start = time
        self.centre = self.joint.position

    def update(self, time, period):
        self.joint.command = self.centre + self.amplitude * sin(2.0 * pi * self.frequency * (time - self.start))
