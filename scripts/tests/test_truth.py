"""Every row of docs/parity.md: what ode_sim does beside what real Gazebo Classic 11.1 did (scripts/real_gazebo/records)."""

import functools
import os

import pytest
from real_gazebo.causes import CAUSES, NOT_COMPARED, cause_of
from real_gazebo.compare import Result, measured, run_ours
from real_gazebo.records import Record, path_of
from real_gazebo.scene import SCENES as ALL
from real_gazebo.scenes import SCENES

LONG = 1.3  # simulated s; longer scenes and those with many bodies are left to slow runs


@functools.lru_cache(maxsize=2)
def ours(name, solver):
    return run_ours(next(scene for scene in SCENES if scene.name == name), solver)


@functools.lru_cache(maxsize=2)
def real(name):
    return Record.read(path_of(name))


def is_slow(scene):
    return scene.server or scene.family in ("piles", "robots") or scene.seconds > LONG


def cases(solver):
    for scene in SCENES:
        for row in scene.rows:
            cause = cause_of(solver, scene.name, row.quantity)
            marks = [pytest.mark.xfail(strict=True, reason=cause)] if cause else []
            marks += [pytest.mark.slow] if is_slow(scene) else []
            marks += [pytest.mark.skip(reason="not yet run beside real Gazebo")] if scene.name in NOT_COMPARED else []
            marks += [pytest.mark.skip(reason="scripts/truth compare runs it, on a server of its own")] if scene.server else []
            yield pytest.param(scene, row, id=f"{scene.name}-{row.quantity}", marks=marks)


def result_of(scene, row, solver):
    return Result(scene, row, measured(row, real(scene.name)), {solver: measured(row, ours(scene.name, solver))})


@pytest.mark.parametrize("scene, row", cases("gazebo"))
def test_gazebo_solver_does_what_real_gazebo_did(scene, row):
    result = result_of(scene, row, "gazebo")
    assert result.within("gazebo"), f"real {result.real:.7g}, here {result.ours['gazebo']:.7g}"


@pytest.mark.parametrize("scene, row", cases("default"))
def test_default_solver_keeps_the_law(scene, row):
    result = result_of(scene, row, "default")
    assert result.within("default"), f"wanted {result.wanted('default'):.7g}, here {result.ours['default']:.7g}; real {result.real:.7g}"


@pytest.mark.parametrize("scene", ALL, ids=lambda scene: scene.name)
def test_record_is_of_this_scene(scene):
    if scene.name in NOT_COMPARED and not os.path.exists(path_of(scene.name)):
        pytest.skip("not recorded yet: scripts/truth record")
    assert os.path.exists(path_of(scene.name)), "scripts/truth record makes it"
    assert real(scene.name).digest == scene.digest(), "the scene was changed after real Gazebo ran it: scripts/truth record it again"
    missing = [row.quantity for row in scene.rows if measured(row, real(scene.name)) != measured(row, real(scene.name))]
    assert not missing, f"real Gazebo's record has none of {missing}"


def test_every_record_has_a_scene_and_all_are_small():
    folder = os.path.dirname(path_of("any"))
    names = {name[: -len(".csv.gz")] for name in os.listdir(folder)}
    assert names <= {scene.name for scene in SCENES}
    assert sum(os.path.getsize(os.path.join(folder, name)) for name in os.listdir(folder)) < 6e6


def test_every_cause_is_of_a_row():
    rows = {(scene.name, row.quantity) for scene in SCENES for row in scene.rows}
    names = {scene.name for scene in SCENES}
    for cause in CAUSES:
        assert cause.scene in names, cause
        assert all((cause.scene, quantity) in rows for quantity in cause.quantities), cause
