"""Which card draws: chosen by index, by PCI address or as software; what fails leaves one line, and software draws."""

import pytest
from ode_sim.description.model import Box
from ode_sim_rendering import Camera, Renderer, RenderProcess, devices
from pictures import RED, draw, scene_of, visual
from test_rendering_process import CAMERA, World

CARDS = ["0000:17:00.0", "0000:65:00.0", "software"]
EGL = pytest.mark.skipif("software" not in devices.devices(), reason="EGL has no software device here (libegl1, libgl1-mesa-dri)")


@pytest.mark.parametrize(
    "wanted, index", [("0", 0), ("2", 2), ("0000:65:00.0", 1), ("65:00.0", 1), ("0000:17:00.0 ", 0), ("software", 2), ("Software", 2)]
)
def test_a_device_is_named_by_index_address_or_as_software(wanted, index):
    assert devices.index_of(wanted, CARDS) == index


@pytest.mark.parametrize("wanted", ["3", "-1", "66:00.0", "0001:65:00.0", "card0", "nvidia", "1.0"])
def test_one_that_is_not_there_is_answered_by_those_that_are(wanted):
    with pytest.raises(devices.UnknownDevice, match=r"0 \(0000:17:00.0\), 1 \(0000:65:00.0\), 2 \(software\)"):
        devices.index_of(wanted, CARDS)


def red_in_the_middle(made):
    picture = draw(made, scene_of(visual("box", Box((0.2, 1, 1)), (2, 0, 0), RED)), Camera(width=40, height=30, hfov=1.0, near=0.05))
    return tuple(picture[15, 20]) == (255, 0, 0)


@EGL
@pytest.mark.parametrize(
    "wanted, lines",
    [
        ("", []),
        ("software", []),
        ("0", []),
        ("9", ["ODE_SIM_GL_DEVICE: there is no device '9'"]),
        ("65:00.0", ["ODE_SIM_GL_DEVICE: there is no device '65:00.0'"]),
    ],
)
def test_the_variable_chooses_and_a_wrong_one_costs_no_picture(monkeypatch, wanted, lines):
    monkeypatch.setenv("ODE_SIM_GL_DEVICE", wanted)
    made = Renderer(backend="egl")
    told = made.take_problems()
    assert len(told) == len(lines) and all(line.startswith(begin) for line, begin in zip(told, lines)), told
    assert red_in_the_middle(made)
    made.close()


@EGL
@pytest.mark.parametrize("wanted", ["", "0", "65:00.0"])
def test_a_driver_that_fails_leaves_one_line_and_software_draws(monkeypatch, wanted):
    import glcontext

    known, original = devices.devices(), glcontext.get_backend_by_name

    def with_a_broken_card(name):
        def make(**settings):
            if settings.get("device_index", 0) == 0:
                raise RuntimeError("eglInitialize failed (0x3001)\nsecond line")
            return original(name)(**{**settings, "device_index": known.index("software")})

        return make if name == "egl" else original(name)

    monkeypatch.setattr(glcontext, "get_backend_by_name", with_a_broken_card)
    monkeypatch.setattr("ode_sim_rendering.context.devices", lambda: ["0000:65:00.0", "software"])
    monkeypatch.setenv("ODE_SIM_GL_DEVICE", wanted)
    made = Renderer()
    (line,) = made.take_problems()
    assert "eglInitialize failed" in line and "; drawn by " in line and "second" not in line
    assert any(name in line for name in ("llvmpipe", "softpipe")) and made.device in line
    assert red_in_the_middle(made)
    made.close()


def test_the_render_process_tells_what_draws_once():
    lines, told = [], []
    studio = RenderProcess(World(), lines.append, told.append)
    try:
        for _ in range(2):
            assert studio.draw(studio.add_camera(CAMERA), ("image",), lambda frame: None, wait=True)
    finally:
        studio.close()
    assert len(told) == 1 and told[0].startswith("cameras are drawn by ") and not lines, (told, lines)
