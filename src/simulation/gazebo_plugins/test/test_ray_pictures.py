"""Which sensors measure by pictures: by type, number of rays, the environment, and what there is to draw on."""

import pytest
from gazebo_plugins.sensors import ray_pictures
from ode_sim_rendering import devices as drawing

CARD, SOFTWARE = "0000:65:00.0", "software"


@pytest.mark.parametrize(
    "kind, rays, devices, environment, expected",
    [
        ("gpu_ray", 64 * 2048, [CARD, SOFTWARE], {}, True),
        ("gpu_lidar", 64 * 2048, [CARD], {}, True),
        ("ray", 64 * 2048, [CARD], {}, False),
        ("gpu_ray", 640, [CARD], {}, False),
        ("gpu_ray", 64 * 2048, [SOFTWARE], {}, False),
        ("gpu_ray", 64 * 2048, [], {}, False),
        ("gpu_ray", 640, [], {"ODE_SIM_GPU_RAY": "pictures"}, True),
        ("ray", 640, [CARD], {"ODE_SIM_GPU_RAY": "pictures"}, False),
        ("gpu_ray", 64 * 2048, [CARD], {"ODE_SIM_GPU_RAY": "rays"}, False),
        ("gpu_ray", 64 * 2048, [CARD], {"ODE_SIM_GPU_RAY": "something"}, True),
        ("gpu_ray", 64 * 2048, [CARD, SOFTWARE], {"ODE_SIM_GL_DEVICE": "software"}, False),
        ("gpu_ray", 64 * 2048, [SOFTWARE, CARD], {"ODE_SIM_GL_DEVICE": "65:00.0"}, True),
        ("gpu_ray", 64 * 2048, [CARD], {"ODE_SIM_GL_DEVICE": "9"}, True),  # not there: the first is taken
        ("gpu_ray", 64 * 2048, [CARD], {"ODE_SIM_GL": "osmesa"}, False),
    ],
)
def test_who_measures_by_pictures(monkeypatch, kind, rays, devices, environment, expected):
    for name in ("ODE_SIM_GPU_RAY", "ODE_SIM_GL_DEVICE", "ODE_SIM_GL"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    monkeypatch.setattr(drawing, "devices", lambda: devices)
    assert ray_pictures.wanted(kind, rays) == expected
