"""Error of a free pendulum against its equation of motion solved to twelve digits, for several step sizes."""

import math

import ode_sim

LENGTH, MASS, GRAVITY, START, DURATION = 0.5, 1.0, 9.8, 1.0, 10.0
STEPS = (0.01, 0.005, 0.002, 0.001, 0.0005)
INERTIA = 0.01  # kg m2, about the centre of mass

URDF = f"""<robot name="pendulum"><link name="world"/><link name="bob"><inertial><origin xyz="0 0 {-LENGTH}"/>
<mass value="{MASS}"/><inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="world"/><child link="bob"/><origin xyz="0 0 2"/><axis xyz="0 1 0"/>
</joint></robot>"""


def reference(times):
    """Angle and rate at the times, by Runge-Kutta of order four in steps of 0.1 ms."""
    factor = MASS * GRAVITY * LENGTH / (INERTIA + MASS * LENGTH**2)
    q, v, t, h, found = START, 0.0, 0.0, 1e-4, []
    for wanted in times:
        while t < wanted - h / 2:
            k1 = -factor * math.sin(q)
            k2 = -factor * math.sin(q + h / 2 * v)
            k3 = -factor * math.sin(q + h / 2 * v + h * h / 4 * k1)
            k4 = -factor * math.sin(q + h * v + h * h / 2 * k2)
            q, v, t = q + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), t + h
        found.append((q, v))
    return found


def energy(q, v):
    """J, above the lowest point."""
    return 0.5 * (INERTIA + MASS * LENGTH**2) * v * v + MASS * GRAVITY * LENGTH * (1.0 - math.cos(q))


def simulate(dt, times):
    world = ode_sim.World()
    world.gravity = (0.0, 0.0, -GRAVITY)
    world.physics.max_step_size = dt
    joint = world.spawn_urdf(URDF).joints["hinge"]
    joint.set_position(START)
    found = []
    for wanted in times:
        world.step(round((wanted - world.time) / dt))
        found.append((joint.position(), joint.velocity()))
    return found


def figures(quick):
    times = [0.1 * i for i in range(1, round(DURATION / 0.1) + 1)]
    true = reference(times)
    result = {}
    for dt in STEPS[:3] if quick else STEPS:
        found = simulate(dt, times)
        error = max(abs(a[0] - b[0]) for a, b in zip(found, true))
        drift = max(energy(*state) for state in found) / energy(START, 0.0) - 1.0
        name = f"pendulum, {dt * 1e3:g} ms steps"
        result[f"{name}: largest angle error in {DURATION:g} s, rad"] = error
        result[f"{name}: largest gain of energy, %"] = 100.0 * drift
    return result
