"""What of Gazebo is not here says so to whoever includes it."""

import pathlib
import subprocess

import pytest

INCLUDE = pathlib.Path(__file__).resolve().parents[1] / "include"
GAZEBO = subprocess.run(["pkg-config", "--cflags", "gazebo"], capture_output=True, text=True).stdout.split()
ABSENT = sorted(path for path in INCLUDE.rglob("*.hh") if path.read_text().startswith("#error"))


@pytest.mark.parametrize(
    "name, words",
    [
        ("rendering/UserCamera.hh", "no window of Gazebo"),
        ("rendering/Conversions.hh", "no Ogre"),
        ("rendering/Light.hh", "lights"),
        ("gui/GuiPlugin.hh", "GUI plugin"),
        ("physics/ode/ODEJoint.hh", "over ODE are not here"),
        ("physics/ode/ODESurfaceParams.hh", "over ODE are not here"),
    ],
)
def test_the_first_line_of_the_compiler_says_what_is_not_here(name, words):
    done = subprocess.run(
        ["g++", "-fsyntax-only", "-x", "c++", f"-I{INCLUDE}", "-"], input=f"#include <gazebo/{name}>\n", capture_output=True, text=True
    )
    lines = [line for line in done.stderr.splitlines() if "error" in line]
    assert done.returncode and words in lines[0], done.stderr


def test_nothing_that_is_here_includes_what_is_not():
    names = {f"<gazebo/{path.relative_to(INCLUDE / 'gazebo')}>" for path in ABSENT}
    assert len(names) > 10
    for path in sorted(INCLUDE.rglob("*.hh")):
        assert not [line for line in path.read_text().splitlines() if line.startswith("#include") and line.split()[1] in names], path


def test_threads_of_boost_are_known_to_whoever_includes_gazebos_messages():
    source = "#include <gazebo/common/Console.hh>\nboost::thread thread;\nboost::mutex mutex;\nstd::thread own;\n"
    done = subprocess.run(
        ["g++", "-std=c++17", "-fsyntax-only", "-x", "c++", f"-I{INCLUDE}", "-"], input=source, capture_output=True, text=True
    )
    assert not done.returncode, done.stderr


@pytest.mark.slow
@pytest.mark.skipif(not GAZEBO, reason="no sourced workspace has gazebo_cpp")
@pytest.mark.parametrize(
    "header, known",
    [
        ("physics/MultiRayShape.hh", "physics::Collision physics::RayShape"),
        ("physics/Link.hh", "physics::Joint common::UpdateInfo event::Events"),
        ("physics/ode/ODEPhysics.hh", "physics::PhysicsEngine physics::Shape dContactGeom"),
        ("rendering/Camera.hh", "common::PID common::Image"),
        ("sensors/RaySensor.hh", "common::UpdateInfo common::SphericalCoordinates event::Events"),
        ("sensors/sensors.hh", "physics::Model physics::World physics::JointController common::PID"),
        ("plugins/ContactPlugin.hh", "physics::ContactManager sensors::RaySensor common::Animation"),
        ("transport/Node.hh", "common::Image common::Exception"),
        ("transport/Node.hh", "boost::bind(&std::string::size,_1)"),
        ("physics/physics.hh", "boost::bind(&std::string::size,_1)"),
        ("sensors/CameraSensor.hh", "boost::bind(&std::string::size,_1)"),
    ],
)
def test_a_header_brings_what_gazebos_own_brings(header, known):
    """What Gazebo 11.1's headers include, plugins use without including it."""
    sizes = "".join(f"static_assert(sizeof({name}) > 0);\n" for name in known.split())
    done = subprocess.run(
        ["g++", "-std=c++17", "-fsyntax-only", "-w", "-x", "c++", *GAZEBO, "-"],
        input=f"#include <gazebo/{header}>\nusing namespace gazebo;\n{sizes}",
        capture_output=True,
        text=True,
    )
    assert not done.returncode, done.stderr
