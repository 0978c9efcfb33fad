"""ode_sim_gym: Gymnasium's own checks, the same bits for the same seed, one world or several, errors in one line."""

import pathlib
import subprocess
import sys

import numpy as np
import pytest

gymnasium = pytest.importorskip("gymnasium", reason="gymnasium is not installed: scripts/setup --teaching")
from gymnasium.utils.env_checker import check_env  # noqa: E402
from ode_sim_gym import Command, RobotEnv, RobotVectorEnv  # noqa: E402

CARTPOLE = str(pathlib.Path(__file__).parent.parent / "examples" / "cartpole.urdf")


def shaken(episodes, random):
    episodes.joint("hinge").set_position(random.uniform(-0.5, 0.5))


def make(number=0, **more):
    keywords = {
        "robot": CARTPOLE,
        "commands": [Command("slider", "effort")],
        "joints": ["slider", "hinge"],
        "links": ["pole"],
        "reward": lambda episodes, action: np.cos(episodes.position("hinge")),
        "start": shaken,
        "limit": 50,
        **more,
    }
    return RobotVectorEnv(number, **keywords) if number else RobotEnv(**keywords)


def episode(env, seed, actions):
    first, _ = env.reset(seed=seed)
    return [first] + [env.step(action)[0] for action in actions]


@pytest.fixture
def actions():
    return np.random.default_rng(3).uniform(-10, 10, (40, 1)).astype(np.float32)


@pytest.mark.filterwarnings("ignore:.*minimum value is -infinity", "ignore:.*maximum value is infinity", "ignore:.*normalized")
def test_gymnasium_finds_no_fault():
    check_env(make())


def test_a_registered_world_knows_what_it_can_render(recwarn):
    camera = pytest.importorskip("ode_sim_rendering").Camera(width=32, height=24)
    options = {"robot": CARTPOLE, "commands": [Command("slider", "effort")], "joints": ["slider"], "reward": lambda episodes, action: 0.0}
    gymnasium.register("OdeSimTest-v0", entry_point=RobotEnv, kwargs=options)
    try:
        made = gymnasium.make("OdeSimTest-v0", camera=camera, render_mode="rgb_array")
        made.reset(seed=1)
        assert made.render().shape[-1] == 3
        assert not [str(warning.message) for warning in recwarn if "render_mode" in str(warning.message)]
    finally:
        gymnasium.registry.pop("OdeSimTest-v0")


def test_same_seed_and_actions_give_the_same_bits(actions):
    env = make()
    first = episode(env, 7, actions)
    other = episode(env, 8, actions)
    assert np.array_equal(first, episode(env, 7, actions)) and np.array_equal(first, episode(make(), 7, actions))
    assert not np.array_equal(first, other)


def test_what_an_episode_leaves_behind_is_gone_in_the_next(actions):
    for kind, high in (("position", 2.0), ("velocity", 3.0)):
        env = make(commands=[Command("slider", kind, -high, high)])
        first = episode(env, 1, actions / 10)
        assert abs(env.episodes.position("slider")) > 1e-3, kind
        assert np.array_equal(first, episode(env, 1, actions / 10)), kind


def test_without_a_seed_a_row_of_episodes_goes_on():
    env, other = make(), make()
    row = [env.reset(seed=5)[0]] + [env.reset()[0] for _ in range(3)]
    assert len({tuple(seen) for seen in row}) == 4
    assert np.array_equal(row, [other.reset(seed=5)[0]] + [other.reset()[0] for _ in range(3)])


def test_a_vector_gives_the_bits_of_single_worlds(actions):
    many = make(3)
    several = episode(many, 7, [np.repeat(action[None], 3, 0) for action in actions])
    for number in range(3):
        assert np.array_equal([seen[number] for seen in several], episode(make(), 7 + number, actions))
    assert many.step(np.zeros((3, 1), np.float32))[3].any() == (len(actions) + 1 >= 50)


def test_an_episode_ends_by_its_limit_or_its_judge():
    env = make(limit=3)
    env.reset(seed=0)
    assert [env.step([0.0])[3] for _ in range(3)] == [False, False, True]
    fallen = make(terminated=lambda episodes, action: abs(episodes.position("slider")) > 0.5)
    fallen.reset(seed=0)
    assert any(fallen.step([10.0])[2] for _ in range(50))


def test_what_is_seen_and_how_a_command_acts():
    env = make(period=0.1)
    seen, _ = env.reset(seed=0)
    assert seen.shape == (2 * 2 + 13,) and np.allclose(seen[4:7], [0, 0, 1], atol=1e-6)
    for _ in range(5):
        seen, reward, _, _, information = env.step([1000.0])  # cut to 10 N
    assert information["time"] == pytest.approx(0.5)
    assert reward == pytest.approx(np.cos(seen[1]), abs=1e-6)
    assert 0.8 < seen[0] < 1.4  # 10 N on 1.1 kg for 0.5 s: 1.14 m, less what the pole takes


@pytest.mark.parametrize(
    "change, words",
    [
        ({"commands": [Command("sledge")]}, "no joint 'sledge' that moves is in the world; there are: slider, hinge"),
        ({"commands": []}, "no joint is commanded"),
        ({"commands": [Command("hinge", "effort")]}, r"joint hinge has no effort limit; give Command\('hinge', 'effort', low, high\)"),
        ({"commands": [Command("slider", "torque")]}, "cannot be commanded by 'torque', only by position, velocity, effort"),
        ({"commands": [Command("slider", "effort", 1, 1)]}, "nothing is between low 1 and high 1"),
        ({"links": ["hand"]}, "no link 'hand' is in the world; there are: .*cart, pole"),
        ({"robot": "/none.urdf"}, "/none.urdf cannot be read: No such file"),
        ({"period": 0.0}, "the period must be more than 0 s"),
        ({"render_mode": "human"}, "render_mode 'human' is not there"),
    ],
)
def test_mistakes_get_one_line(change, words):
    with pytest.raises(ValueError, match=words) as caught:
        make(**change)
    assert "\n" not in str(caught.value)


def test_an_action_that_is_no_number_or_of_another_size():
    env = make()
    env.reset(seed=0)
    with pytest.raises(ValueError, match="finite numbers"):
        env.step([float("nan")])
    with pytest.raises(ValueError, match="an action has 1 numbers"):
        env.step([0.0, 1.0])


def test_without_gymnasium_the_remedy_is_named():
    code = "import sys; sys.modules['gymnasium'] = None\ntry:\n  import ode_sim_gym\nexcept ImportError as e: print(e)"
    assert "scripts/setup --teaching" in subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60).stdout


@pytest.mark.slow
def test_the_example_learns(tmp_path):
    pytest.importorskip("cma", reason="cma is not installed: scripts/setup --teaching")
    example, film = pathlib.Path(CARTPOLE).with_name("balance.py"), tmp_path / "pole.mp4"
    words = [sys.executable, str(example), "--generations", "12", "--film", str(film)]
    run = subprocess.run(words, capture_output=True, text=True, timeout=200)
    assert run.returncode == 0, run.stderr
    lasted = [float(line.split(" up for ")[1].split()[0]) for line in run.stdout.splitlines()]
    assert lasted[-1] > 3 * lasted[0], run.stdout  # what was found, on new starts, against the first draw
    assert film.read_bytes()[4:8] == b"ftyp"
