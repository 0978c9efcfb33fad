"""``<state>`` of a world file: time, poses and velocities of the moment at which Gazebo saved it."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ode_sim.core_numbers import unit_pose
from ode_sim.description import model as d
from ode_sim.handles import ModelHandle

if TYPE_CHECKING:
    from ode_sim.world import World

_LONGEST_TIME = 9e9  # s that the clock's nanoseconds can hold


def apply_state(world: World, state: d.WorldState) -> None:
    """Put ``world`` into ``state``, in the place of its models' own poses; what cannot be is a problem of the world's."""

    def problem(message: str) -> None:
        world.problems.append(d.Problem("warning", f"<state>: {message}", world.description.source))

    if 0.0 <= state.sim_time <= _LONGEST_TIME and 0 <= state.iterations < 2**63:
        world.core.time_ns = round(state.sim_time * 1e9)
        world.core.iterations = int(state.iterations)
    else:
        problem(f"no clock shows {state.sim_time:g} s after {state.iterations} steps; it starts from 0")
    for name, pose in state.light_poses:
        if name in world.lights:
            world.lights[name] = replace(world.lights[name], pose=pose)
    for saved in state.models:
        if saved.name in world.models:
            try:
                _apply_model_state(world.models[saved.name], saved)
            except ValueError as error:
                problem(f"model '{saved.name}' stays where the simulator has put it: {error}")


def _apply_model_state(model: ModelHandle, saved: d.ModelState) -> None:
    if saved.pose is not None:
        model.pose = saved.pose
        model.initial_pose = unit_pose(saved.pose)
    for link_state in saved.links:
        link = model.links.get(link_state.name)
        if link is not None:
            link.pose = link_state.pose
            link.set_twist(link_state.linear, link_state.angular)
