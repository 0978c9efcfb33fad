"""Command lines of the nodes and tools, and arguments of gazebo_ros' launch files."""
from __future__ import annotations

import json
import re
import shlex
from pathlib import Path
from random import Random
from typing import Any, Dict, Iterator, List

from fuzzing import programs, ros, seeds, values
from fuzzing.findings import Found, check_message, of_output, of_stack
from fuzzing.kinds import Kind

_SCRIPTS = {"gzserver": "gazebo_ros", "build_world": "gazebo_ros", "spawn_model": "gazebo_ros", "gz": "gazebo_ros", "spawner": "controller_manager",
            "unspawner": "controller_manager", "controller_manager": "controller_manager", "controller_group": "controller_manager"}
_LINES = {
    "gzserver": ["worlds/empty.world", "--seed 3 test.world", "-e ode --lockstep worlds/shapes.world", "-s libgazebo_ros_api_plugin.so --verbose",
                 "-r --record_path x worlds/blank.world", "-p log", "-o preset worlds/seesaw.world", "--physics bullet --minimal_comms",
                 "-g x.so __name:=gazebo __log:=x", "--version", "-h", "model://coke_can/model.sdf"],
    "build_world": ["plan.yaml -o out.world", "plan.yaml -o out.sdf --preview out.png", "plan.png -o out.world --resolution 0.05", "plan.yaml -o built/",
                    "-h"],
    "spawn_model": ["-urdf -param robot_description -model x -z 1", "-sdf -file model.sdf -model x -x 1 -y 2 -R 0.1 -P 0.2 -Y 0.3", "-urdf -file robot.urdf "
                    "-model x -J j0 0.5 -J j1 -1 -unpause", "-sdf -database coke_can -model can -reference_frame world", "-urdf -param robot_description "
                    "-model x -gazebo_namespace /gazebo -robot_namespace /r -package_to_model", "-urdf -param p -model x -wait arm", "-sdf -stdin -model x",
                    "-urdf -file robot.urdf -model x -b", "-h"],
    "gz": ["model -m x -d", "model -m x -i", "model -m x -p", "model -m x -f robot.urdf -x 1 -y 2 -z 3 -R 1 -P 2 -Y 3", "world -p 1", "world -s",
           "world -m 10", "world -r", "physics -s 0.001 -u 1000 -g 0,0,-9.8 -i 50", "stats -d 0.1", "sdf -k model.sdf", "sdf -k test.world", "-v", "model"],
    "spawner": ["joint_state_controller", "--stopped a b", "--namespace /x --timeout 0.2 a", "--timeout 1 controllers.yaml", "--wait-for /go a",
                "--no-timeout a", "--shutdown-timeout 1 a"],
    "unspawner": ["a", "a b", "-h"],
    "controller_manager": ["list", "list-types", "load a", "start a b", "stop a", "unload a", "spawn a", "kill a", "reload-libraries", "reload-libraries "
                           "--restore", "lj", "-h"],
    "controller_group": ["list", "spawn g", "switch g"],
}
_FILES = ["empty_world.launch", "shapes_world.launch", "range_world.launch", "elevator_world.launch"]
_ARGUMENTS = {"paused": "false", "use_sim_time": "true", "extra_gazebo_args": "--seed 4", "gui": "false", "recording": "false", "headless": "true",
              "debug": "false", "physics": "ode", "verbose": "true", "output": "screen", "world_name": "worlds/empty.world", "respawn_gazebo": "false",
              "use_clock_frequency": "true", "pub_clock_frequency": "100", "enable_ros_network": "true", "server_required": "true",
              "gui_required": "false"}
_ODD = ["", "''", "\"", "$(find x)", "$(arg x)", "$(eval 1/0)", "$(env HOME)", "--", "-", "-x", "--help", "a b", ":=", "x:=y", "__name:=", "__name:=/a b",
        "true", "True", "yes", "1", "worlds/no_such.world", "model://x", ".", "/", "..", "*", ";", "&&", "--iters", "-e", "~", "$(anon x)", "%", "{}", "[1"]
_PROGRAM_CODES = (0, 1, 2, 255)


class LaunchKind(Kind):
    """JSON: ``program`` and ``arguments``; of program ``launch`` the first is a launch file of gazebo_ros."""

    name, suffix = "launch", ".json"
    time_limit = 60.0
    wall_limit = 120.0
    memory = 8 << 30
    silent = False

    def prepare(self) -> None:
        import controller_manager.command_line  # noqa: F401
        import controller_manager.spawner  # noqa: F401
        import controller_manager_tests  # noqa: F401
        import gazebo_ros.building  # noqa: F401
        import gazebo_ros.building_image  # noqa: F401
        import gazebo_ros.building_sdf  # noqa: F401
        import gazebo_ros.gz  # noqa: F401
        import gazebo_ros.node  # noqa: F401
        import gazebo_ros.spawn_model  # noqa: F401
        import node_signals  # noqa: F401
        import roslaunch.config  # noqa: F401
        import rosmaster.master  # noqa: F401
        self._scripts = {name: programs.script_of(package, name, seeds.packages()) for name, package in _SCRIPTS.items()}

    def start(self, folder: Path, number: int) -> None:
        from PIL import Image
        self._alone, self._with_doubles = programs.start_masters(folder, number)
        Path("robot.urdf").write_bytes(seeds.robots()["arm.urdf"])
        Path("model.sdf").write_bytes(seeds.models()["unit_box.sdf"])
        Path("test.world").write_bytes(seeds.worlds()["shapes.world"])
        Path("plan.yaml").write_text("walls: [{from: [0, 0], to: [2, 0]}]\n")
        Path("controllers.yaml").write_text("a: {type: x/Y}\n")
        Image.new("L", (9, 9)).save("plan.png")

    # ------------------------------------------------------------------------------------------ making

    def generate(self, random: Random) -> bytes:
        if random.random() < 0.25:
            arguments = [f"{name}:={_ARGUMENTS[name]}" for name in random.sample(sorted(_ARGUMENTS), random.randint(0, 5))]
            for _ in range(random.choice((1, 1, 2, 3))):
                arguments.append(f"{random.choice(sorted(_ARGUMENTS))}:={self._odd(random)}")
            return _written({"program": "launch", "arguments": [random.choice(_FILES), *arguments]})
        program = random.choice(list(_LINES))
        arguments = shlex.split(random.choice(_LINES[program]))
        for _ in range(random.choice((1, 1, 2, 3, 5))):
            self._change(random, program, arguments)
        return _written({"program": program, "arguments": arguments})

    def _change(self, random: Random, program: str, arguments: List[str]) -> None:
        i = random.randint(0, len(arguments))
        change = random.randrange(6)
        if change == 0 or not arguments:
            arguments.insert(i, self._odd(random))
        elif change == 1:
            arguments[i:i] = shlex.split(random.choice(_LINES[program]))
        elif change == 2:
            arguments.insert(i, random.choice(shlex.split(random.choice(_LINES[program])) or [""]))
        elif change == 3:
            del arguments[i % len(arguments)]
        elif change == 4:
            arguments[i % len(arguments)] = values.with_numbers_changed(random, arguments[i % len(arguments)])
        else:
            arguments[i % len(arguments)] = self._odd(random)

    @staticmethod
    def _odd(random: Random) -> str:
        texts = random.choice((_ODD, values.ODDITIES, values.NAMES, values.EXTREMES, values.URIS))
        return random.choice([text for text in texts if not text.startswith("/dev/") and "file:///dev" not in text]).replace("\0", "")

    def smaller(self, case: bytes) -> Iterator[bytes]:
        told = json.loads(case)
        for i in range(len(told["arguments"])):
            yield _written({**told, "arguments": told["arguments"][:i] + told["arguments"][i + 1:]})

    # ------------------------------------------------------------------------------------------ running

    def run(self, case: bytes) -> None:
        told = json.loads(case)
        if told["program"] == "launch":
            self._launch(told["arguments"])
        else:
            self._run(told["program"], told["arguments"])

    def _launch(self, arguments: List[str]) -> None:
        """What roslaunch makes of the arguments; then the server as it would be started."""
        import roslaunch
        import roslaunch.config
        file = str(Path(seeds.packages()["gazebo_ros"]) / "launch" / arguments[0])
        try:
            config = roslaunch.config.load_config_default([(file, arguments[1:])], None, verbose=False)
        except (roslaunch.RLException, ValueError) as error:  # both are said in one line
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

    def _run(self, program: str, arguments: List[str]) -> None:
        if program == "gzserver":
            arguments = [*arguments, "--iters", "5"]
        ended = programs.run(self._scripts[program], arguments, self._alone if program == "gzserver" else self._with_doubles)
        said = re.sub(r"\x1b\[[\d;]*m", "", ended.errors)
        both = said + "\n" + ended.output
        if ended.hung:
            raise _found(of_stack("hang", both))
        if ended.code < 0 and not ended.interrupted:
            raise _found(of_stack(f"process ended by signal {-ended.code}", both))
        if "Traceback (most recent call last)" in both:
            raise _found(of_output(both[both.index("Traceback (most"):]))
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


def _found(finding) -> Found:
    return Found(finding.what, finding.place, finding.detail)


def _written(told: Dict[str, Any]) -> bytes:
    return json.dumps(told).encode()
