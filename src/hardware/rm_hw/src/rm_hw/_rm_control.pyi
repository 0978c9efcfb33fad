from collections.abc import Sequence

class Motor:
    halted: bool
    need_calibration: bool
    calibrated: bool
    calibration_reading: bool
    position: float
    offset: float

class Stamp:
    def set(self, seconds: float) -> None: ...

class Interfaces:
    def __init__(self) -> None: ...
    @property
    def address(self) -> int: ...
    def add_motor(self, name: str) -> Motor: ...
    def add_imu(self, name: str, frame_id: str, data: Sequence[int]) -> Stamp: ...
