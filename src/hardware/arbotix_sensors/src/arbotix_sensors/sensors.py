"""What the distance is when an analogue pin reads so much. Without ROS nodes.

Curves are upstream's: the volts of Sharp's rangers fall as one over the distance, those of MaxBotix' sonars grow with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from sensor_msgs.msg import Range


@dataclass(frozen=True)
class SharpIR:
    """scale / (raw - offset) m, from a reading above ``least`` on; below it nothing is seen.

    :param min_range, max_range: m
    """

    scale: float
    offset: float
    least: int
    min_range: float
    max_range: float
    radiation_type: ClassVar[int] = Range.INFRARED
    field_of_view: ClassVar[float] = 0.001  # rad

    def convert(self, raw: int) -> float:
        """m, of a reading of 10 bits; beyond the range where nothing is seen."""
        return self.scale / (raw - self.offset) if raw > self.least else self.max_range + 0.1


@dataclass(frozen=True)
class MaxSonar:
    """12.7 m at the full 5 V."""

    min_range: float = 0.0
    max_range: float = 6.4516
    radiation_type: ClassVar[int] = Range.ULTRASOUND
    field_of_view: ClassVar[float] = 0.785398163  # rad

    def convert(self, raw: int) -> float:
        """m, of a reading of 10 bits."""
        return 12.7 * raw / 1024.0


GP2D12 = SharpIR(52.0, 12, 40, 0.10, 0.80)
A02YK = SharpIR(115.0, 12, 80, 0.20, 1.50)
A710YK = SharpIR(497.0, 56, 100, 0.75, 5.50)
BY_TYPE = {"GP2D12": GP2D12, "A02YK": A02YK, "long": A02YK, "A710YK": A710YK, "ultralong": A710YK}
