"""SDF's <noise> by both its faces: what the law on paper says (Gazebo Classic 11's GaussianNoiseModel)."""

import math
import pathlib
import subprocess
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from gazebo_plugins.sensors.noise import SdfNoise
from gazebo_ros import SdfElement
from ode_sim import _core

PROGRAM = pathlib.Path(_core.__file__).parents[3] / "gazebo_plugins" / "print_noisy"  # devel/lib/gazebo_plugins


def python(noise: str, name: str, dt: float, values, kind: str = "imu") -> np.ndarray:
    model = SdfElement(ET.fromstring(noise))
    usual = "gaussian" if kind == "ray" else "none"
    made = SdfNoise(model, np.random.Generator(np.random.PCG64(sum(map(ord, name)))), usual)
    return np.array([made(value, dt) for value in values])


def compiled(noise: str, name: str, dt: float, values, kind: str = "imu") -> np.ndarray:
    words = [str(PROGRAM), kind, noise, name, str(dt), *map(repr, map(float, values))]
    return np.array([float(line) for line in subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()])


FACES = pytest.mark.parametrize("face", [python, compiled])
EXACT = [  # <noise> without white noise, values, what is measured
    ("<mean>5</mean>", [1.0, -1.0], [6.0, 4.0]),
    ("<mean>0</mean>", [1.25], [1.25]),
    ("<mean>0</mean><precision>0.5</precision>", [0.25, -0.25, 0.75, 0.7], [0.5, -0.5, 1.0, 0.5]),  # halves away from zero
    ("<mean>0.1</mean><precision>0.25</precision>", [1.0], [1.0]),
    ("<mean>0</mean><precision>0.0000005</precision>", [0.1234567], [0.1234567]),  # finer than Gazebo looks
    ("<mean>0</mean><precision>-1</precision>", [0.3], [0.3]),
]


@FACES
@pytest.mark.parametrize("kind", ["gaussian", "gaussian_quantized"])  # Gazebo makes no difference: what counts is <precision>
@pytest.mark.parametrize("inside, values, wanted", EXACT)
def test_without_white_noise_the_value_is_exact(face, kind, inside, values, wanted):
    noise = f"<noise type='{kind}'>{inside}<stddev>0</stddev></noise>"
    np.testing.assert_allclose(face(noise, "a", 0.0, values), wanted, rtol=0, atol=1e-15)


@FACES
def test_type_none_leaves_the_value_whatever_else_is_said(face):
    noise = "<noise type='none'><mean>1</mean><stddev>2</stddev><bias_mean>3</bias_mean><precision>10</precision></noise>"
    assert face(noise, "a", 1.0, [0.5, -7.0]).tolist() == [0.5, -7.0]


@FACES
@pytest.mark.parametrize("kind, added", [("<type>gaussian</type>", 5.0), ("", 5.0), ("<type>none</type>", 0.0)])
def test_the_type_of_rays_is_an_element(face, kind, added):
    """And gaussian where there is none, as sdformat's ray.sdf has it."""
    assert face(f"<noise>{kind}<mean>5</mean><stddev>0</stddev></noise>", "a", 0.0, [1.0], "ray").tolist() == [1.0 + added]


@pytest.mark.slow
@FACES
def test_a_bias_without_spread_has_either_sign(face):
    noise = "<noise type='gaussian'><mean>0</mean><stddev>0</stddev><bias_mean>3</bias_mean><bias_stddev>0</bias_stddev></noise>"
    found = [face(noise, name, 0.0, [1.0, 1.0]) for name in map(str, range(40))]
    assert all(two[0] == two[1] for two in found)
    plus = sum(two[0] == 4.0 for two in found)
    assert plus + sum(two[0] == -2.0 for two in found) == 40
    assert 8 <= plus <= 32  # 1 in 10 000 by chance


@pytest.mark.slow
@FACES
def test_the_bias_is_drawn_once(face):
    noise = "<noise type='gaussian'><mean>0</mean><stddev>0</stddev><bias_mean>3</bias_mean><bias_stddev>0.5</bias_stddev></noise>"
    found = np.array([face(noise, name, 0.0, [0.0, 0.0]) for name in map(str, range(40))])
    assert (found[:, 0] == found[:, 1]).all()
    assert np.abs(found[:, 0]).mean() == pytest.approx(3.0, abs=4 * 0.5 / math.sqrt(40))
    assert np.abs(found[:, 0]).std() == pytest.approx(0.5, rel=0.4)


@FACES
def test_a_bias_that_wanders(face):
    """Its stationary variance is s^2 T / 2, its correlation from one value to the next exp(-dt / T)."""
    s, time, dt = 2.0, 0.5, 0.1
    noise = (
        "<noise type='gaussian'><mean>0</mean><stddev>0</stddev>"
        f"<dynamic_bias_stddev>{s}</dynamic_bias_stddev><dynamic_bias_correlation_time>{time}</dynamic_bias_correlation_time></noise>"
    )
    found = face(noise, "a", dt, [0.0] * 8000)[100:]
    assert found.var() == pytest.approx(s * s * time / 2, rel=0.15)
    assert np.corrcoef(found[:-1], found[1:])[0, 1] == pytest.approx(math.exp(-dt / time), abs=0.03)
    assert (face(noise, "a", 0.0, [1.0] * 5) == 1.0).all()  # no time has passed


@FACES
def test_white_noise(face):
    noise = "<noise type='gaussian'><mean>1</mean><stddev>0.2</stddev></noise>"
    found = face(noise, "a", 0.0, [3.0] * 4000)
    assert found.mean() == pytest.approx(4.0, abs=4 * 0.2 / math.sqrt(4000)) and found.std() == pytest.approx(0.2, rel=0.05)


def test_each_beam_has_an_error_of_its_own():
    noise = "<noise type='gaussian'><mean>1</mean><stddev>0.2</stddev><precision>0.25</precision></noise>"
    made = SdfNoise(SdfElement(ET.fromstring(noise)), np.random.Generator(np.random.PCG64(1)))
    found = made(np.full(2000, 3.0))
    assert found.shape == (2000,) and len(set(found)) > 3 and np.allclose(found * 4, np.round(found * 4))
    assert found.mean() == pytest.approx(4.0, abs=0.03)
