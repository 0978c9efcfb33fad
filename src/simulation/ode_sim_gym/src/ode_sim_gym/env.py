"""The Gymnasium environment over :class:`Episodes`, and several in one process."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np

from ode_sim_gym.episodes import Episodes

if TYPE_CHECKING:
    from ode_sim_rendering.camera import Camera

Judge = Callable[[Episodes, np.ndarray], Any]


class RobotEnv(gymnasium.Env):
    """A robot in a world. What :class:`Episodes` takes goes there: world, robot, commands, joints, links, period, start, finder.

    :param reward: ``reward(episodes, action)`` after each action.
    :param terminated: ``terminated(episodes, action)``: whether the episode has come to an end of its own.
    :param limit: actions after which an episode is cut off (``truncated``); 0 is never.
    :param camera: an :class:`ode_sim_rendering.Camera`, for ``render_mode="rgb_array"``.

    Observations are (size,) float32, see :meth:`Episodes.observe`; actions (commands,) float32 in the commands' own units;
    ``gymnasium.wrappers.RescaleAction`` brings them to -1 ... 1.
    """

    # of the class, where gymnasium.make() looks; an instance knows whether it has a camera
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"]}

    def __init__(
        self,
        reward: Judge,
        terminated: Judge | None = None,
        limit: int = 1000,
        camera: Camera | None = None,
        render_mode: str | None = None,
        **episodes: Any,
    ):
        self.episodes = Episodes(**episodes)
        self._reward, self._terminated = reward, terminated
        self.limit = limit
        self._camera = camera
        period = self.episodes.steps_per_action * self.episodes.world.dt
        modes = ["rgb_array"] if camera is not None else []
        self.metadata = {"render_modes": modes, "render_fps": max(1, round(1.0 / period))}
        if render_mode is not None and render_mode not in modes:
            raise ValueError(f"render_mode '{render_mode}' is not there; give camera=ode_sim_rendering.Camera(...) and 'rgb_array'")
        self.render_mode = render_mode
        low, high = np.array(self.episodes.bounds, dtype=np.float32).T
        self.action_space = gymnasium.spaces.Box(low, high, dtype=np.float32)
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (self.episodes.size,), np.float32)
        self._done = 0

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[np.ndarray, dict[str, Any]]:
        """With a ``seed``: the same episodes as the last time that it was given. Without: the next of the same row.

        :param options: of Gymnasium's interface, not used.
        """
        super().reset(seed=seed)
        self.episodes.begin(int(self.np_random.integers(2**63)))
        self._done = 0
        return self._observe(), self._information()

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """One period with ``action``. An episode that has flown apart ends, and is seen where it was no number as 0."""
        self.episodes.advance(action)
        self._done += 1
        observation = self._observe()
        broken = not np.isfinite(observation).all()
        reward = 0.0 if broken else float(self._reward(self.episodes, action))
        terminated = broken or bool(self._terminated is not None and self._terminated(self.episodes, action))
        truncated = bool(self.limit) and self._done >= self.limit
        return np.nan_to_num(observation, posinf=0.0, neginf=0.0), reward, terminated, truncated, self._information()

    def render(self) -> np.ndarray | None:
        """(height, width, 3) uint8."""
        if self.render_mode != "rgb_array":
            return None
        from ode_sim_rendering import render  # OpenGL, which learning without pictures does not load

        return render(self.episodes.world, self._camera)

    def _observe(self) -> np.ndarray:
        return self.episodes.observe().astype(np.float32)

    def _information(self) -> dict[str, Any]:
        """Simulated time, and what the simulator had to say since the last look."""
        said = list(self.episodes.world.messages)
        self.episodes.world.messages.clear()
        return {"time": self.episodes.time, **({"messages": said} if said else {})}


class RobotVectorEnv(gymnasium.vector.SyncVectorEnv):
    """``number`` worlds in one process, each as :class:`RobotEnv` has it, and the same bits as that one gives with its seed.

    :param autoreset: Gymnasium's mode: NextStep, SameStep or Disabled.
    """

    def __init__(self, number: int, autoreset: str = "NextStep", **environment: Any):
        if number < 1:
            raise ValueError(f"a vector has at least one world, not {number}")
        super().__init__([lambda: RobotEnv(**environment)] * number, autoreset_mode=autoreset)
