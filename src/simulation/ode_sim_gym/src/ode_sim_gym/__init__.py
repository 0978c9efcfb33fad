"""Worlds for learning: a Gymnasium environment, and a vector of them, over a world file or a robot's URDF. No ROS.

    env = RobotEnv(robot="cartpole.urdf", commands=[Command("slider", "effort")], reward=upright)
    observation, info = env.reset(seed=1)
    observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

The same seed and the same actions give the same bits. Needs Gymnasium: ``scripts/setup --teaching``.
"""

try:
    import gymnasium  # noqa: F401
except ImportError:
    raise ImportError(
        "ode_sim_gym needs Gymnasium, which is not there: run scripts/setup --teaching and source devel/setup.bash again, "
        "or pip install gymnasium==1.4.0"
    ) from None

from ode_sim_gym.env import RobotEnv, RobotVectorEnv
from ode_sim_gym.episodes import Command, Episodes

__all__ = ["Command", "Episodes", "RobotEnv", "RobotVectorEnv"]
