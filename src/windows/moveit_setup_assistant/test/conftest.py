"""The window, a small robot, and a package of it."""

import os

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

import pytest  # noqa: E402
from moveit_setup_assistant import headless, package_writer  # noqa: E402
from moveit_setup_assistant.robot_source import RobotSource  # noqa: E402
from robots import FIVE  # noqa: E402

CONFIG = """
groups:
  arm: {chain: [base, inside], solver: kdl, timeout: 0.02, planner: RRTConnect}
  wing: {joints: [swinging]}
poses:
  - {name: home, group: arm, joints: {turn: 0.5, spin: -0.25}}
end_effectors:
  - {name: hand, group: wing, parent_link: column}
virtual_joints:
  - {name: stand_here, type: fixed, parent_frame: world, child_link: base}
passive_joints: [spin]
collisions: {trials: 1000}
author: {name: Ada, email: ada@example.org}
"""


@pytest.fixture(scope="session")
def app():
    from python_qt_binding.QtWidgets import QApplication

    return QApplication.instance() or QApplication([])


@pytest.fixture
def urdf(tmp_path, monkeypatch):
    folder = tmp_path / "src" / "small_description"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>small_description</name></package>")
    (folder / "small.urdf").write_text(FIVE)
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{tmp_path / 'src'}:{os.environ.get('ROS_PACKAGE_PATH', '')}")
    return folder / "small.urdf"


@pytest.fixture
def config_file(tmp_path):
    """The same robot's configuration as a person would type it."""
    (tmp_path / "config.yaml").write_text(CONFIG)
    return tmp_path / "config.yaml"


@pytest.fixture
def package(urdf, config_file, tmp_path):
    folder = tmp_path / "small_moveit_config"
    package_writer.write(headless.configuration(RobotSource.from_file(urdf), config_file), folder)
    return folder


@pytest.fixture
def user(app):
    from moveit_setup_assistant.window import Window
    from person import User

    window = Window()
    window.show()
    yield User(window)
    window.interrupted()
