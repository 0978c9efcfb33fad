"""Plans of buildings, through the command build_world: read, built, drawn from above, and loaded as a world."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import yaml

from fuzzing import seeds, tree_cases, values, worlds, xml_cases
from fuzzing.findings import Found, check_message, refused
from fuzzing.kinds import Kind

_EXAMPLES = """
- name: flat
  wall: {thickness: 0.15, height: 2.5, material: Gazebo/CeilingTiled}
  walls:
    - {path: [[0, 0], [6, 0], [6, 4], [0, 4], [0, 0]], doors: [{at: 1.5}], windows: [{at: 8.0, width: 1.2, height: 0.5, sill: 1.0}]}
    - {from: [3, 0], to: [3, 2.5], color: [0.8, 0.7, 0.6]}
  stairs: [{at: [5, 2], yaw: 1.57, width: 1.0, depth: 2.0, height: 2.5, steps: 5}]
  levels:
    - walls: [{from: [0, 0], to: [6, 0]}]
      floor: {color: [1, 0, 0]}
      height: 2.0
  models: [{model: table, at: [1, 2], yaw: 0.3}, {model: coke_can, at: [1, 2, 0.5], name: can}]
- {image: plan.png, resolution: 0.1, origin: [0.0, 0.0, 0.0], occupied_thresh: 0.5, negate: 0, mode: trinary, free_thresh: 0.1}
- {image: broken.png, resolution: 0.1}
- {image: vast.png, resolution: 0.1, wall: {height: 2.0}}
- {walls: [{from: [0, 0], to: [1, 0]}]}
"""
_PREFIXES = (
    b"[" * 2000,
    b"a: &a [*a]\n",
    b"!!python/object/apply:os.system [true]\n",
    b"x: {y: " * 500,
    b"\xff\xfe",
    b"- - - -\n",
    b"a: &a [1,1,1,1,1,1]\nb: &b [*a,*a,*a,*a,*a,*a]\nwalls: &c [*b,*b,*b,*b,*b,*b]\nmodels: [*c,*c,*c]\n",
)


class PlanKind(Kind):
    """YAML plans of ``rosrun building_editor build_world``."""

    name, suffix = "plan", ".yaml"

    def prepare(self) -> None:
        import building_editor.build_world
        import ode_sim  # noqa: F401

        self._build = building_editor.build_world.main
        self._plans = yaml.safe_load(_EXAMPLES)
        self._plans += [yaml.safe_load(path.read_text()) for path in seeds.files(".yaml") if path.parent.name == "plans"]

    def start(self, folder: Path, number: int) -> None:
        from PIL import Image, ImageDraw

        image = Image.new("L", (60, 40), 255)
        pen = ImageDraw.Draw(image)
        pen.rectangle((5, 5, 50, 30), outline=0, width=2)
        pen.line((20, 5, 20, 30), fill=30)
        image.save("plan.png")
        data = Path("plan.png").read_bytes()
        Path("broken.png").write_bytes(data[: len(data) // 2])
        Path("vast.png").write_bytes(data[:16] + b"\x00\x00\xff\xff\x00\x00\xff\xff" + data[24:])

    def generate(self, random: Random) -> bytes:
        plan = random.choice(self._plans)
        for key in [key for key in plan if isinstance(plan[key], list) and len(plan[key]) > 8]:
            plan = {**plan, key: values.chosen(random, plan[key], random.randint(1, 6))}
        plan = tree_cases.changed(random, plan, random.choice((1, 1, 2, 3, 5, 10)), tree_cases.odd_value)
        text = _dumped(plan)
        if random.random() < 0.1:
            text = values.with_numbers_changed(random, text.decode()).encode()
        if random.random() < 0.05:
            text = random.choice(_PREFIXES) + text
        return values.damaged(random, text, 2) if random.random() < 0.08 else text

    def run(self, case: bytes) -> None:
        Path("case.yaml").write_bytes(case)
        said, complained = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complained):
            code = self._build(["case.yaml", "-o", "built.world", "--preview", "plan_drawn.png"])
        lines = complained.getvalue() if code else said.getvalue()
        if code not in (0, 1):
            raise Found("exit code", f"build_world: {code}")
        check_message(lines.strip(), "building.py: build_world's message")
        if code == 0 and complained.getvalue():
            raise Found("output on the terminal", "build_world", complained.getvalue())
        if code == 0:
            self._use()

    @staticmethod
    def _use() -> None:
        import ode_sim

        built = str(Path("built.world").resolve())
        world, error = refused(lambda: ode_sim.World.load(built, finder=seeds.finder()), ode_sim.DescriptionError)
        if error is not None:
            raise Found("built what cannot be loaded", "sdf_model.py", str(error))
        worlds.settle(world, 5)

    def smaller(self, case: bytes) -> Iterator[bytes]:
        tree = readable(case)
        if tree is None:
            yield from xml_cases.smaller_bytes(case)
            return
        for candidate in tree_cases.smaller(tree):
            yield _dumped(candidate)


def readable(case: bytes) -> Any:
    """The tree of a YAML text that may be broken, else None."""
    try:
        tree = yaml.safe_load(case)
        yaml.safe_dump(tree)
        return tree
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError, ValueError):
        return None


def _dumped(plan: Any) -> bytes:
    return yaml.safe_dump(plan, default_flow_style=None, allow_unicode=True, width=10**6).encode()
