"""Keys to velocities. Knows neither ROS nor terminals."""

from typing import NamedTuple

HELP = """
Reading from the keyboard  and Publishing to Twist!
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

For Holonomic mode (strafing), hold down the shift key:
---------------------------
   U    I    O
   J    K    L
   M    <    >

t : up (+z)
b : down (-z)

anything else : stop

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%

CTRL-C to quit
"""
HELP_AGAIN = 15  # speed keys after which the help is shown anew


class Direction(NamedTuple):
    """Shares of the speeds: ahead, to the left, up, turning to the left."""

    x: int = 0
    y: int = 0
    z: int = 0
    turn: int = 0


DIRECTIONS = {
    "u": Direction(1, turn=1),
    "i": Direction(1),
    "o": Direction(1, turn=-1),
    "j": Direction(turn=1),
    "l": Direction(turn=-1),
    "m": Direction(-1, turn=-1),
    ",": Direction(-1),
    ".": Direction(-1, turn=1),
    "U": Direction(1, 1),
    "I": Direction(1),
    "O": Direction(1, -1),
    "J": Direction(y=1),
    "L": Direction(y=-1),
    "M": Direction(-1, 1),
    "<": Direction(-1),
    ">": Direction(-1, -1),
    "t": Direction(z=1),
    "b": Direction(z=-1),
}
#: Factors of the linear and the angular speed.
SPEEDS = {"q": (1.1, 1.1), "z": (0.9, 0.9), "w": (1.1, 1), "x": (0.9, 1), "e": (1, 1.1), "c": (1, 0.9)}


class Driver:
    """What is commanded now, in m/s and rad/s."""

    def __init__(self, speed: float = 0.5, turn: float = 1.0, speed_limit: float = 1000.0, turn_limit: float = 1000.0):
        self.speed, self.turn = speed, turn
        self._limits = speed_limit, turn_limit
        self._direction = Direction()
        self._speed_keys = 0

    @property
    def linear(self) -> tuple:
        return tuple(share * self.speed for share in self._direction[:3])

    @property
    def angular(self) -> float:
        return self._direction.turn * self.turn

    def press(self, key: str) -> tuple:
        """Take a key, or "" for a time without one.

        :returns: (whether there is something new to send, text to show)
        """
        if key in SPEEDS:
            return True, self._change_speeds(*SPEEDS[key])
        stood = self._direction == Direction()
        self._direction = DIRECTIONS.get(key, Direction())
        return not (key == "" and stood), ""

    def status(self) -> str:
        return f"currently:\tspeed {self.speed}\tturn {self.turn} "

    def _change_speeds(self, linear: float, angular: float) -> str:
        self.speed, self.turn = min(self._limits[0], self.speed * linear), min(self._limits[1], self.turn * angular)
        lines = ["Linear speed limit reached!"] if self.speed == self._limits[0] else []
        lines += ["Angular speed limit reached!"] if self.turn == self._limits[1] else []
        lines.append(self.status())
        self._speed_keys += 1
        if self._speed_keys % HELP_AGAIN == 0:
            lines.append(HELP)
        return "\n".join(lines)
