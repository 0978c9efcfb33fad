"""What tests share. No ROS but in ``test_support.hearing``: a test that talks to nodes brings its own clients.

Each case of a test is looked at, whatever became of those before it::

    class Wheels(test_support.TestCase):
        def test_both_turn(self):
            for name in ("left", "right"):
                with self.subTest(name):
                    wait_until(lambda: self.speed(name) > 0, f"the {name} wheel to turn")
"""

from .angles import heading
from .cases import TestCase
from .network import free_port
from .waiting import never, wait_until

__all__ = ["TestCase", "free_port", "heading", "never", "wait_until"]
