"""What a run of a scene gave, in real Gazebo or here: time series by name."""

from __future__ import annotations

import gzip
import math
import os

import numpy as np

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "records")
_COLUMNS = {"x": 1, "y": 2, "z": 3, "qx": 4, "qy": 5, "qz": 6, "qw": 7, "vx": 8, "vy": 9, "vz": 10, "wx": 11, "wy": 12, "wz": 13}


def path_of(scene: str) -> str:
    return os.path.join(FOLDER, scene + ".csv.gz")


def _upright(words: list[str], start: int) -> list[str]:
    """The quaternion x y z w that begins there with w not negative: q and -q are the same turn."""
    if float(words[start + 3]) >= 0:
        return words
    return words[:start] + [f"{-float(word):.9g}" for word in words[start : start + 4]] + words[start + 4 :]


class Record:
    """Rows as `recorder.cc` writes them: KIND:NAME,TIME,VALUES...; time is that since the start, resets or not."""

    def __init__(self, lines) -> None:
        self.series: dict[str, np.ndarray] = {}
        self.words: dict[str, list[list[str]]] = {}  # is_model, is_link, is_collision, is_joint
        self.digest = ""
        rows: dict[str, list[list[float]]] = {}
        self.lines = list(lines)
        for line in self.lines:
            name, *values = line.strip().split(",")
            if name.startswith("#"):
                self.digest = name.split()[1]
            elif name.startswith("is_"):
                self.words.setdefault(name, []).append(_upright(values, 14) if name.startswith("is_link") else values)
            elif name != "end":
                rows.setdefault(name, []).append([float(v) for v in values])
        for name, values in rows.items():
            if len({len(v) for v in values}) == 1:
                self.series[name] = np.array(values)
                if name.startswith(("model:", "link:")):
                    self.series[name][self.series[name][:, 7] < 0, 4:8] *= -1
            else:  # contacts: their number changes
                self.words[name] = [[f"{x:.9g}" for x in v] for v in values]

    @classmethod
    def read(cls, path: str) -> Record:
        with gzip.open(path, "rt") if path.endswith(".gz") else open(path, encoding="utf-8") as file:
            return cls(file)

    # ------------------------------------------------------------------------------------------------ motion

    def column(self, name: str, column: str) -> np.ndarray:
        """(N,) of a body's pose or twist; name as `model:box` or `link:arm::hand`."""
        return self.series[name][:, _COLUMNS[column]]

    def times(self, name: str) -> np.ndarray:
        return self.series[name][:, 0]

    def at(self, name: str, column: str, time: float) -> float:
        return float(np.interp(time, self.times(name), self.column(name, column)))

    def speed(self, name: str, time: float) -> float:
        return math.sqrt(sum(self.at(name, c, time) ** 2 for c in ("vx", "vy", "vz")))

    def spin(self, name: str, time: float) -> float:
        return math.sqrt(sum(self.at(name, c, time) ** 2 for c in ("wx", "wy", "wz")))

    def way(self, name: str, start: float, end: float) -> float:
        return math.sqrt(sum((self.at(name, c, end) - self.at(name, c, start)) ** 2 for c in "xyz"))

    def acceleration(self, name: str, start: float, end: float) -> float:
        """Mean growth of the speed, m/s^2."""
        return (self.speed(name, end) - self.speed(name, start)) / (end - start)

    def yaw(self, name: str) -> np.ndarray:
        x, y, z, w = (self.column(name, c) for c in ("qx", "qy", "qz", "qw"))
        return np.unwrap(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))

    def yaw_at(self, name: str, time: float) -> float:
        return float(np.interp(time, self.times(name), self.yaw(name)))

    def tilt(self, name: str, time: float) -> float:
        """Angle between the body's z axis and the world's, rad."""
        x, y = self.at(name, "qx", time), self.at(name, "qy", time)
        return math.acos(max(-1.0, min(1.0, 1 - 2 * (x * x + y * y))))

    def highest(self, name: str, start: float, end: float) -> float:
        t = self.times(name)
        return float(self.column(name, "z")[(t >= start) & (t <= end)].max())

    def lowest(self, name: str, start: float, end: float) -> float:
        t = self.times(name)
        return float(self.column(name, "z")[(t >= start) & (t <= end)].min())

    def falls_at(self, name: str, below: float) -> float:
        """When z is first lower than that, s; infinite if never."""
        z, t = self.column(name, "z"), self.times(name)
        under = np.nonzero(z < below)[0]
        if not len(under):
            return math.inf
        k = int(under[0])
        return float(t[k] if k == 0 else t[k - 1] + (t[k] - t[k - 1]) * (z[k - 1] - below) / (z[k - 1] - z[k]))

    # ------------------------------------------------------------------------------------------------ joints

    def angle(self, joint: str, time: float, axis: int = 0) -> float:
        """Position of a joint, rad or m."""
        rows = self.series[f"joint{axis or ''}:{joint}"]
        return float(np.interp(time, rows[:, 0], rows[:, 1]))

    def rate(self, joint: str, time: float, axis: int = 0) -> float:
        rows = self.series[f"joint{axis or ''}:{joint}"]
        return float(np.interp(time, rows[:, 0], rows[:, 2]))

    def voltage(self, battery: str, time: float) -> float:
        rows = self.series[f"battery:{battery}"]
        return float(np.interp(time, rows[:, 0], rows[:, 1]))

    def angles(self, joint: str, axis: int = 0) -> np.ndarray:
        return self.series[f"joint{axis or ''}:{joint}"][:, 1]

    def wrench(self, joint: str, component: int, time: float) -> float:
        """0-5 of body 1, 6-11 of body 2: force, torque."""
        rows = self.series[f"wrench:{joint}"]
        return float(np.interp(time, rows[:, 0], rows[:, 1 + component]))

    def sensor(self, name: str, component: int, time: float = math.inf) -> float:
        """Between the two measurements round that time, of the last one by default; component 0 is the time of measurement."""
        rows = self.series["sensor:" + name]
        if math.isinf(time):
            return float(rows[-1, 1 + component])
        return float(np.interp(time, rows[:, 1], rows[:, 1 + component]))

    def last(self, beginning: str) -> list[float]:
        """The last row of the first name that begins so, time first; also where rows are of different lengths."""
        rows = next(rows for named in (self.series, self.words) for name, rows in named.items() if name.startswith(beginning))
        return [float(value) for value in rows[-1]]

    def contacts_at(self, time: float):
        """[(pair of collisions, (position 3, normal 3, depth, force 3 and torque 3 on the first))] of one moment."""
        return [
            (name.split(":", 1)[1], row[1:])
            for name, rows in self.series.items()
            if name.startswith("contact:")
            for row in rows
            if abs(row[0] - time) < 1e-6
        ]

    # ------------------------------------------------------------------------------------------------ what was made of the file

    def names(self, kind: str) -> list[str]:
        """Names of all models, links, collisions or joints at the start, sorted."""
        return sorted(n.split(":", 1)[1] for n in self.words if n.startswith(f"is_{kind}:"))

    def value(self, kind: str, name: str, number: int, last: bool = False) -> str:
        """A word of a description row, counted after the time."""
        return self.words[f"is_{kind}:{name}"][-1 if last else 0][1 + number]
