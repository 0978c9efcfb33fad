"""From keys to velocities, without ROS."""

HELP = """
Control mbot!
---------------------------
Moving around:
   u    i    o
   j    k    l
   m    ,    .

q/z : increase/decrease max speeds by 10%
w/x : increase/decrease only linear speed by 10%
e/c : increase/decrease only angular speed by 10%
space key, k : force stop
anything else : stop smoothly

CTRL-C to quit
"""

DIRECTIONS = {  # key: (forwards, turn to the left)
    "u": (1, 1),
    "i": (1, 0),
    "o": (1, -1),
    "j": (0, 1),
    "l": (0, -1),
    "m": (-1, -1),
    ",": (-1, 0),
    ".": (-1, 1),
}
SPEED_FACTORS = {  # key: (linear, angular)
    "q": (1.1, 1.1),
    "z": (0.9, 0.9),
    "w": (1.1, 1),
    "x": (0.9, 1),
    "e": (1, 1.1),
    "c": (1, 0.9),
}
STOP = (" ", "k")
IDLE_TURNS = 4  # turns without a known key in which the robot keeps its direction
HELP_EVERY = 15  # speed changes between two prints of the help
LINEAR_RAMP = 0.02  # m/s per turn
ANGULAR_RAMP = 0.1  # rad/s per turn


def towards(value, target, step):
    """`value` moved towards `target` by at most `step`; a rest of rounding is no step of its own."""
    if abs(target - value) < step * (1 + 1e-9):
        return target
    return value + step if value < target else value - step


class Driver:
    """One call of `turn` per turn of the node's loop, about ten a second."""

    def __init__(self):
        self.speed = 0.2  # m/s at full deflection
        self.turn_rate: float = 1  # rad/s at full deflection
        self.linear = 0.0  # m/s, what is commanded now
        self.angular = 0.0  # rad/s, to the left
        self._direction = (0, 0)
        self._idle = 0
        self._speed_changes = 0

    def status(self):
        return "currently:\tspeed %s\tturn %s " % (self.speed, self.turn_rate)

    def at_rest(self):
        return self._direction == (0, 0) and self.linear == 0 and self.angular == 0

    def turn(self, key):
        """Takes the key of this turn (one character, or "" for none); returns the text to print, or ""."""
        text = ""
        if key in DIRECTIONS:
            self._direction = DIRECTIONS[key]
            self._idle = 0
        elif key in SPEED_FACTORS:
            linear, angular = SPEED_FACTORS[key]
            self.speed *= linear
            self.turn_rate *= angular
            self._idle = 0
            text = self.status()
            self._speed_changes += 1
            if self._speed_changes % HELP_EVERY == 0:
                text += "\n" + HELP
        elif key in STOP:
            self._direction = (0, 0)
            self.linear = self.angular = 0.0
        else:
            self._idle += 1
            if self._idle > IDLE_TURNS:
                self._direction = (0, 0)
        self.linear = towards(self.linear, self._direction[0] * self.speed, LINEAR_RAMP)
        self.angular = towards(self.angular, self._direction[1] * self.turn_rate, ANGULAR_RAMP)
        return text
