#!/usr/bin/env python3
"""As step_parts.py, of the UR5 with compiled controllers and plugins beside its own.

usage: compiled_steps.py STEPS CONTROLLERS ROUNDS PLUGINS
"""

import sys

import robots
import step_parts


class Extended(robots.UR5):
    def __init__(self, controllers: int, rounds: int, plugins: int):
        self._rounds, self._plugins = rounds, plugins
        self._readers = [f"reader{i}" for i in range(controllers)]
        self.started = [*robots.UR5.started, *self._readers]

    def urdf(self) -> str:
        plugin = '<gazebo><plugin name="pusher{}" filename="libbench_compiled_pusher.so"/></gazebo>'
        return super().urdf().replace("</robot>", "".join(plugin.format(i) for i in range(self._plugins)) + "</robot>")

    def controllers(self) -> dict:
        return {**super().controllers(), **{name: {"type": "bench_compiled/Reader", "rounds": self._rounds} for name in self._readers}}


if __name__ == "__main__":
    steps, controllers, rounds, plugins = map(int, sys.argv[1:])
    robots.ROBOTS["extended"] = Extended(controllers, rounds, plugins)
    sys.argv = [sys.argv[0], "extended", str(steps)]
    step_parts.main()
