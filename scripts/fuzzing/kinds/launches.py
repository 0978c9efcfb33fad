"""Command lines of the nodes and tools, and arguments of gazebo_ros' launch files."""

from __future__ import annotations

import json
import re
import shlex
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import yaml

from fuzzing import programs, ros, seeds, values
from fuzzing.findings import Found, check_message, of_output, of_stack
from fuzzing.kinds import Kind

_SCRIPTS = {
    "gazebo_ros": ("gzserver", "spawn_model", "gz"),
    "building_editor": ("build_world",),
    "controller_manager": ("spawner", "unspawner", "controller_manager", "controller_group"),
    "urdfdom_py": ("display_urdf",),
    "rosmon": ("rosmon",),
}
_FILES = ["empty_world.launch", "shapes_world.launch", "range_world.launch", "elevator_world.launch"]
_PROGRAM_CODES = (0, 1, 2, 255)


class LaunchKind(Kind):
    """JSON: ``program`` and ``arguments``; of program ``launch`` the first is a launch file of gazebo_ros."""

    name, suffix = "launch", ".json"
    time_limit = 60.0
    wall_limit = 120.0
    memory = 8 << 30
    silent = False

    def prepare(self) -> None:
        import building_editor.build_world  # noqa: F401
        import controller_manager.command_line  # noqa: F401
        import controller_manager.spawner  # noqa: F401
        import controller_manager_tests  # noqa: F401
        import gazebo_ros.commands.gz  # noqa: F401
        import gazebo_ros.commands.spawn_model  # noqa: F401
        import gazebo_ros.node  # noqa: F401
        import node_signals  # noqa: F401
        import roslaunch.config  # noqa: F401
        import rosmaster.master  # noqa: F401

        told = yaml.safe_load((Path(__file__).parents[1] / "commands.yaml").read_text())
        self._lines, self._arguments, self._odd_words = told["lines"], told["launch_arguments"], told["odd"]
        self._scripts = {name: programs.script_of(package, name, seeds.packages()) for package, names in _SCRIPTS.items() for name in names}

    def start(self, folder: Path, number: int) -> None:
        from PIL import Image

        self._alone, self._with_doubles = programs.start_masters(folder, number)
        Path("robot.urdf").write_bytes(seeds.robots()["arm.urdf"])
        Path("model.sdf").write_bytes(seeds.models()["unit_box.sdf"])
        Path("test.world").write_bytes(seeds.worlds()["shapes.world"])
        Path("plan.yaml").write_text("walls: [{from: [0, 0], to: [2, 0]}]\n")
        Path("none.launch").write_text('<launch><arg name="robot" default=""/><param name="x" value="$(anon x)"/></launch>')
        Path("controllers.yaml").write_text("a: {type: x/Y}\n")
        Image.new("L", (9, 9)).save("plan.png")

    # ------------------------------------------------------------------------------------------ making

    def generate(self, random: Random) -> bytes:
        if random.random() < 0.25:
            arguments = [f"{name}:={self._arguments[name]}" for name in random.sample(sorted(self._arguments), random.randint(0, 5))]
            for _ in range(random.choice((1, 1, 2, 3))):
                arguments.append(f"{random.choice(sorted(self._arguments))}:={self._odd(random)}")
            return _written({"program": "launch", "arguments": [random.choice(_FILES), *arguments]})
        program = random.choice(list(self._lines))
        arguments = shlex.split(random.choice(self._lines[program]))
        for _ in range(random.choice((1, 1, 2, 3, 5))):
            self._change(random, program, arguments)
        return _written({"program": program, "arguments": arguments})

    def _change(self, random: Random, program: str, arguments: list[str]) -> None:
        i = random.randint(0, len(arguments))
        change = random.randrange(6)
        if change == 0 or not arguments:
            arguments.insert(i, self._odd(random))
        elif change == 1:
            arguments[i:i] = shlex.split(random.choice(self._lines[program]))
        elif change == 2:
            arguments.insert(i, random.choice(shlex.split(random.choice(self._lines[program])) or [""]))
        elif change == 3:
            del arguments[i % len(arguments)]
        elif change == 4:
            arguments[i % len(arguments)] = values.with_numbers_changed(random, arguments[i % len(arguments)])
        else:
            arguments[i % len(arguments)] = self._odd(random)

    def _odd(self, random: Random) -> str:
        texts = random.choice((self._odd_words, values.ODDITIES, values.NAMES, values.EXTREMES, values.URIS))
        return random.choice([text for text in texts if not text.startswith("/dev/") and "file:///dev" not in text]).replace("\0", "")

    def smaller(self, case: bytes) -> Iterator[bytes]:
        told = json.loads(case)
        for i in range(len(told["arguments"])):
            yield _written({**told, "arguments": told["arguments"][:i] + told["arguments"][i + 1 :]})

    # ------------------------------------------------------------------------------------------ running

    def run(self, case: bytes) -> None:
        told = json.loads(case)
        if told["program"] == "launch":
            self._launch(told["arguments"])
        else:
            self._run(told["program"], told["arguments"])

    def _launch(self, arguments: list[str]) -> None:
        """What roslaunch makes of the arguments; then the server as it would be started."""
        import roslaunch
        import roslaunch.config
        import rospkg

        file = str(Path(seeds.packages()["gazebo_ros"]) / "launch" / arguments[0])
        try:
            config = roslaunch.config.load_config_default([(file, arguments[1:])], None, verbose=False)
        except (roslaunch.RLException, ValueError, rospkg.ResourceNotFound) as error:  # roslaunch says them in its own words
            if "Traceback" in str(error):
                raise Found("traceback on the terminal", "roslaunch", str(error)) from None
            return
        for node in config.nodes:
            if node.type == "gzserver":
                try:
                    line = shlex.split(node.args.replace("\n", " "))
                except ValueError:
                    return  # roslaunch itself says so
                self._run("gzserver", line)

    def _run(self, program: str, arguments: list[str]) -> None:
        if program == "gzserver":
            arguments = [*arguments, "--iters", "5"]
        ended = programs.run(self._scripts[program], arguments, self._alone if program == "gzserver" else self._with_doubles)
        said = re.sub(r"\x1b\[[\d;]*m", "", ended.errors)
        both = said + "\n" + ended.output
        if ended.hung:
            raise Found.of(of_stack("hang", both))
        if ended.code < 0 and not ended.interrupted:
            raise Found.of(of_stack(f"process ended by signal {-ended.code}", both))
        if "Traceback (most recent call last)" in both:
            raise Found.of(of_output(both[both.index("Traceback (most") :]))
        if ended.code not in _PROGRAM_CODES and not ended.interrupted:
            raise Found("exit code", program, f"{ended.code}: {programs.last_line(both)}")
        if ended.code in (1, 2) and not ended.interrupted:
            line = programs.last_line(said) or programs.last_line(ended.output)
            if not line:
                raise Found("fails without a word", program, f"code {ended.code}")
            check_message(line, f"{program}'s message")
        for line in said.splitlines():
            if re.match(r"\[(ERROR|FATAL|WARN)\]", line):
                ros.check_line(re.sub(r"^\[\w+\] \[[\d., -]+\]: ", "", line))


def _written(told: dict[str, Any]) -> bytes:
    return json.dumps(told).encode()
