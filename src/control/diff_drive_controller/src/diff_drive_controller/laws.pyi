MIN_INTERVAL: float  # s; shorter ones give no usable velocity

def differential(left: float, right: float, separation: float) -> tuple[float, float]:
    """(distance m, angle rad) of a base whose sides went ``left`` and ``right`` (m), ``separation`` (m) apart."""

def bicycle(distance: float, steering: float, base: float) -> tuple[float, float]:
    """The same of one whose driven axle went ``distance`` (m), steered ``steering`` (rad) at an axle ``base`` (m) before it."""

class RollingMean:
    """Mean of the last ``size`` values."""

    def __init__(self, size: int) -> None: ...
    def __call__(self, value: float) -> float:
        """Add a value. :return: the mean"""
    def clear(self) -> None: ...

class WheelTravel:
    """What a joint has turned since it was last asked. The first answer is 0: joints need not start at 0."""

    def __call__(self, position: float) -> float:
        """:param position: rad. :return: rad"""
    def restart(self) -> None:
        """The next answer is 0 again."""

class PlanarOdometry:
    """Pose in the odom frame, and velocity in the base frame; ``odometry_law.h`` says the rest. Times are in s.

    :param window: number of values over which the velocity of ``travelled`` is averaged
    """

    x: float  #: m
    y: float  #: m
    heading: float  #: rad, not wrapped
    linear: float  #: forward, m/s
    linear_y: float  #: to the left, m/s
    angular: float  #: rad/s
    def __init__(self, window: int) -> None: ...
    def restart(self, time: float) -> None:
        """Forget velocities; the pose stays."""
    def interval(self, time: float) -> float:
        """Seconds since the pose was last brought up to date; negative when a simulation was reset."""
    def travelled(self, distance: float, angle: float, time: float) -> None:
        """The base went ``distance`` (m) forward while turning ``angle`` (rad), as measured at ``time``."""
    def commanded(self, linear: float, angular: float, time: float) -> None:
        """Open loop: the base has been doing ``linear`` (m/s) and ``angular`` (rad/s) up to ``time``."""
    def moved(self, linear: float, linear_y: float, angular: float, time: float) -> None:
        """Velocities of a base that also moves sideways, as measured at ``time``."""

Bounds = tuple[float, float] | None

class SpeedLimiter:
    """Limits a commanded velocity, given the last two that came out of it; ``speed_limiter.h`` says how.

    :param velocity: (lowest, highest), m/s or rad/s; acceleration and jerk are its derivatives
    """

    last: float  #: The last limited velocity.
    def __init__(self, velocity: Bounds = ..., acceleration: Bounds = ..., jerk: Bounds = ...) -> None: ...
    def reset(self) -> None:
        """The base stands still."""
    def limit(self, velocity: float, dt: float) -> float:
        """The velocity nearest to ``velocity`` that is allowed ``dt`` seconds after the last one."""
