#!/usr/bin/env python3
"""Learns to balance a pole on a cart: ``examples/balance.py [--generations 20] [--film balance.mp4]``. Needs ``scripts/setup --teaching``.

CMA-ES (the library ``cma``) finds the four weights by which position and velocity of cart and pole become the force on the cart. Each
generation's policies play side by side in a vector environment; the pole starts up to 0.3 rad off upright.
"""

import argparse
import pathlib

import cma
import cv2
import numpy as np
from ode_sim_gym import Command, RobotEnv, RobotVectorEnv
from ode_sim_rendering import Camera, look_at

FALLEN = 0.6  # rad
ACTIONS = 500  # of an episode: 10 s
FORCE = 10.0  # N


def leaning(episodes, random):
    """The pole points up, not quite."""
    episodes.joint("hinge").set_position(random.uniform(-0.3, 0.3))


def reward(episodes, action):
    """1 for an upright pole on a cart in the middle of its rail."""
    return 1.0 - (episodes.position("hinge") / FALLEN) ** 2 / 2.0 - (episodes.position("slider") / 2.4) ** 2 / 2.0


def fallen(episodes, action):
    return abs(episodes.position("hinge")) > FALLEN


CARTPOLE = dict(
    robot=str(pathlib.Path(__file__).with_name("cartpole.urdf")),
    commands=[Command("slider", "effort")],
    joints=["slider", "hinge"],
    reward=reward,
    terminated=fallen,
    start=leaning,
    limit=ACTIONS,
    period=0.02,
)


def make(number):
    """:param number: of worlds."""
    return RobotVectorEnv(number, **CARTPOLE)


def force(weights, observations):
    """(worlds, 1) N."""
    return (FORCE * np.tanh(np.sum(weights * observations, axis=1, keepdims=True))).astype(np.float32)


def play(env, weights, seed):
    """One episode of each policy.

    :param weights: (worlds, 4).
    :param seed: of all worlds, which begin in the same state.
    :returns: (worlds,) reward an action, 1 at best; (worlds,) s until the pole fell, 10 if it did not.
    """
    observations, _ = env.reset(seed=[seed] * env.num_envs)
    sums, lasted, up = np.zeros(env.num_envs), np.zeros(env.num_envs), np.ones(env.num_envs, dtype=bool)
    for _ in range(ACTIONS):
        observations, rewards, terminated, _, _ = env.step(force(weights, observations))
        up &= ~terminated
        sums[up] += rewards[up]
        lasted[up] += 0.02
        if not up.any():
            break
    return sums / ACTIONS, lasted


def film(weights, seed, path):
    """One episode as an MP4 of 25 pictures a second."""
    eye = Camera("eye", 640, 360, 0.9, pose=look_at((0.0, -5.5, 1.6), (0.0, 0.0, 1.3)))
    env = RobotEnv(camera=eye, render_mode="rgb_array", **CARTPOLE)
    writer = cv2.VideoWriter(path, cv2.VideoWriter_fourcc(*"avc1"), 25, (eye.width, eye.height))
    observation, _ = env.reset(seed=seed)
    for number in range(ACTIONS):
        if number % 2 == 0:
            writer.write(env.render()[:, :, ::-1].copy())
        observation, _, over, _, _ = env.step(force(weights, observation[None])[0])
        if over:
            break
    writer.release()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--generations", type=int, default=20)
    parser.add_argument("--population", type=int, default=16)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--film", help="an .mp4 of one new start, played by what was learnt")
    options = parser.parse_args()
    env = make(options.population)
    search = cma.CMAEvolutionStrategy(4 * [0.0], 1.0, {"popsize": options.population, "seed": options.seed, "verbose": -9})
    for generation in range(options.generations):
        weights = np.array(search.ask())
        scores, lasted = play(env, weights, seed=generation)
        search.tell(weights, -scores)
        print(f"generation {generation}: mean reward {scores.mean():.3f}, the pole stays up for {lasted.mean():.2f} s", flush=True)
    one = make(1)
    results = [play(one, search.mean[None], seed=1000 + number) for number in range(10)]
    print(
        f"10 new starts: mean reward {np.mean([r[0] for r in results]):.3f}, "
        f"the pole stays up for {np.mean([r[1] for r in results]):.2f} of 10 s"
    )
    if options.film:
        film(search.mean[None], 1000, options.film)


if __name__ == "__main__":
    main()
