"""A controller manager whose control loop is the test: every cycle is known."""

import threading

from controller_manager import ControllerManager
from hardware_interface import (
    EffortJointInterface,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionJointInterface,
    RobotHW,
    VelocityJointInterface,
)

_INTERFACES = {"position": PositionJointInterface, "velocity": VelocityJointInterface, "effort": EffortJointInterface}


class Loop:
    """Joints ``names`` with all three interfaces in namespace ``namespace``.

    ``state[name]`` is what the hardware measures; ``command(kind, name)`` what it is told.
    """

    def __init__(self, names=("a", "b", "c"), namespace="/robot", dt=0.01):
        self.dt = dt
        self.time = 10.0
        self.state = {name: JointStateHandle(name) for name in names}
        self.hw = RobotHW()
        self.hw.register_interface(JointStateInterface(*self.state.values()))
        for interface in _INTERFACES.values():
            self.hw.register_interface(interface(*map(JointHandle, self.state.values())))
        self.manager = ControllerManager(self.hw, namespace)

    def command(self, kind, name):
        """What joint ``name`` is told through the interface of ``kind``: "position", "velocity" or "effort"."""
        offered = self.hw.get(_INTERFACES[kind])
        assert offered is not None  # __init__ registers all of them
        return next(handle.command for handle in offered.handles() if handle.name == name)

    def cycle(self, count=1):
        for _ in range(count):
            self.time += self.dt
            self.manager.update(self.time, self.dt)

    def load(self, *names):
        """:return: whether all were loaded."""
        return all([self.manager.load_controller(name) for name in names])

    def switch(self, start=(), stop=()):
        """Switch to the controllers ``start`` from ``stop``, with as many cycles as that takes."""
        answer = []
        request = threading.Thread(target=lambda: answer.append(self.manager.switch_controller(list(start), list(stop))), daemon=True)
        request.start()
        while request.is_alive():
            if self.manager._switch is not None:
                self.cycle()
            request.join(0.002)
        assert answer == [True], (start, stop)

    def start(self, *names):
        assert self.load(*names), names
        self.switch(names)

    def controller(self, name):
        return next(loaded.controller for loaded in self.manager.controllers if loaded.name == name)
