from collections.abc import Sequence

class Complementary:
    """Orientation of a sensor in a world whose z is up; with a magnetic field its x is magnetic north.

    :param gain_acc: 0 to 1, share of the error against gravity that one reading takes away; likewise ``gain_mag`` of the yaw.
    :param adaptive: readings that are not of gravity's size count less: at 10 % off in full, at 20 % not at all.
    :param bias_alpha: 0 to 1, share of the turn rates at rest that goes into their bias; None: no bias is looked for.
    :raises ValueError: a share that is none
    """

    def __init__(self, gain_acc: float = ..., gain_mag: float = ..., adaptive: bool = ..., bias_alpha: float | None = ...) -> None: ...
    @property
    def orientation(self) -> list[float]:
        """w, x, y, z"""
    @property
    def bias(self) -> list[float]:
        """rad/s"""
    @property
    def steady(self) -> bool:
        """Whether the last reading was of a sensor at rest."""
    def reset(self) -> None: ...
    def update(self, acceleration: Sequence[float], rate: Sequence[float], field: Sequence[float] | None, dt: float) -> None:
        """One reading: m/s^2, rad/s, magnetic field in any unit or None, s since the last one."""
