"""The picture of the robot beside the screens: turned by dragging, with links that light up."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from ode_sim.math3 import quat_to_matrix, vec3
from ode_sim_rendering import Camera, Renderer, RenderingUnavailable, look_at
from ode_sim_rendering.assets import Assets
from ode_sim_rendering.portrait import Portrait, camera_from, extent
from python_qt_binding.QtCore import QPoint, Qt, QTimer, Signal
from python_qt_binding.QtGui import QImage, QPainter
from python_qt_binding.QtWidgets import QWidget

from moveit_setup_assistant.robot_scene import RobotScene
from moveit_setup_assistant.robot_source import Robot

_FIELD = 0.8  # rad, along the view's longer side
_NOTHING = 0.2  # m, of what is looked at around a link that has no shape
_LARGEST = 900  # pixels along a side that are drawn; a larger window shows them larger


class RobotView(QWidget):
    """Draws a robot in the state it is given, as large as the view allows until the user takes the camera. The mouse turns it (left),
    moves it (middle or shift), and comes nearer (wheel); a double click gives the camera back.

    ``problem`` carries one line when something of the robot, or all of it, cannot be drawn.
    """

    problem = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("robot_view")
        self.setMinimumSize(220, 220)
        self._renderer: Renderer | None = None
        self._scene: RobotScene | None = None
        self._assets = Assets()
        self._robot: Robot | None = None
        self._lit: list[str] = []  # links
        self._drawn = True, False  # visual, collision
        self._text = ""  # in place of a picture
        self._poses = np.zeros((0, 7))
        self._image = QImage()
        self._azimuth, self._elevation, self._distance = math.pi / 5, 0.4, 2.0
        self._target: np.ndarray = np.zeros(3)
        self._pressed: QPoint | None = None
        self._taken = False  # the camera, by the user
        self._fitted = 0, 0  # the size in pixels for which it stands where it does
        self._timer = QTimer(self)  # one picture for many changes in one go
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._draw)

    def set_robot(self, robot: Robot) -> None:
        """Show another robot in its default state, all of it in the picture."""
        self._robot, self._scene, self._text, self._image = robot, None, "", QImage()
        if self._renderer is None:
            try:
                self._renderer = Renderer(antialiasing="msaa", shadows="off", assets=self._assets)
            except RenderingUnavailable as error:
                self._text = f"The robot cannot be shown: {error}"
                self.problem.emit(self._text)
                self.update()
                return
        self._scene = RobotScene(robot, *self._drawn)
        self._poses = self._scene.poses(robot.model.state())
        self._renderer.set_scene(self._scene.description())
        self._taken, self._fitted = False, (0, 0)
        for line in self._renderer.take_problems():
            self.problem.emit(line)
        self._timer.start(0)

    def set_drawn(self, visual: bool, collision: bool) -> None:
        """Which of the links' shapes are drawn: ``visual``, ``collision``, both or none."""
        self._drawn = visual, collision
        if self._scene is not None and self._robot is not None:
            self._scene = RobotScene(self._robot, visual, collision)
            self.highlight(self._lit)

    def set_state(self, state) -> None:
        """Show the robot in another state of its own model."""
        if self._scene is not None:
            self._poses = self._scene.poses(state)
            self._timer.start(0)

    def highlight(self, links: Iterable[str]) -> None:
        """Light up these links, and no others."""
        self._lit = list(links)
        if self._scene is not None and self._renderer is not None:
            self._renderer.set_scene(self._scene.description(self._lit))
            self._timer.start(0)

    def close_renderer(self) -> None:
        """Give up OpenGL; nothing is drawn any more."""
        self._timer.stop()
        if self._renderer is not None:
            self._renderer.close()
            self._renderer, self._scene = None, None

    def picture(self) -> QImage:
        """What is shown now."""
        return self._image

    def _project(self, camera: Camera) -> np.ndarray:
        """(N, 2) column and row of the corners in the camera's picture, pixels."""
        R_WC = np.array(quat_to_matrix(camera.pose.q))
        return camera.project((self._corners() - np.asarray(camera.pose.p)) @ R_WC)

    def _corners(self) -> np.ndarray:
        """(N, 3), model frame, m: what has to be in the picture."""
        assert self._scene is not None
        corners = extent(Portrait(self._scene.description(), self._poses, "", "iso", 1, 1), self._assets)
        if len(corners) and np.isfinite(corners).all():
            return corners
        origins = self._poses[:, :3]
        return np.concatenate([origins - _NOTHING, origins + _NOTHING])

    def _fit(self, width: int, height: int) -> None:
        """Stand where all of the robot is in the picture, and no farther away."""
        corners = self._corners()
        found = camera_from(corners, self._azimuth, self._elevation, width, height, self._hfov(width, height))
        eye: np.ndarray = np.array(found.pose.p)
        middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
        self._distance = max(0.05, float((middle - eye) @ self._towards()))
        self._target = eye + self._distance * self._towards()

    def _hfov(self, width: int, height: int) -> float:
        """rad; a narrow view looks no farther up and down than a wide one to its sides."""
        return 2 * math.atan(math.tan(_FIELD / 2) * width / max(width, height))

    def _camera(self, width: int, height: int) -> Camera:
        """Where the user put it; else where it was, as long as all of the robot is in the picture, or as near as it can be."""
        if not self._taken and (self._fitted != (width, height) or self._leaves(self._placed(width, height))):
            self._fit(width, height)
            self._fitted = width, height
        return self._placed(width, height)

    def _placed(self, width: int, height: int) -> Camera:
        near, far = self._distance / 100, self._distance * 20
        pose = look_at(vec3(self._eye()), vec3(self._target))
        return Camera("view", width, height, self._hfov(width, height), near=near, far=far, pose=pose)

    def _leaves(self, camera: Camera) -> bool:
        """Whether some of the robot is outside the picture."""
        at = self._project(camera)
        return bool((at < 0).any() or (at >= (camera.width, camera.height)).any())

    def _towards(self) -> np.ndarray:
        level = math.cos(self._elevation)
        return -np.array([level * math.cos(self._azimuth), level * math.sin(self._azimuth), math.sin(self._elevation)])

    def _eye(self) -> np.ndarray:
        return self._target - self._distance * self._towards()

    def _draw(self) -> None:
        if self._scene is None or self._renderer is None:
            return
        shrink = min(1.0, _LARGEST / max(self.width(), self.height(), 1))
        width, height = max(16, int(self.width() * shrink)), max(16, int(self.height() * shrink))
        camera = self._camera(width, height)
        pixels = np.ascontiguousarray(self._renderer.color(camera, self._poses))
        self._image = QImage(pixels.data, width, height, 3 * width, QImage.Format_RGB888).copy()
        self.update()

    # ---- what the user does

    def resizeEvent(self, _event) -> None:
        self._timer.start(0)

    def paintEvent(self, _event) -> None:
        painter = QPainter(self)
        if self._image.isNull():
            painter.drawText(self.rect().adjusted(8, 8, -8, -8), Qt.AlignCenter | Qt.TextWordWrap, self._text)
        else:
            painter.drawImage(self.rect(), self._image)

    def mousePressEvent(self, event) -> None:
        self._pressed = event.pos()

    def mouseDoubleClickEvent(self, _event) -> None:
        self._taken, self._fitted = False, (0, 0)
        self._timer.start(0)

    def mouseReleaseEvent(self, _event) -> None:
        self._pressed = None

    def mouseMoveEvent(self, event) -> None:
        if self._pressed is None:
            return
        moved, self._pressed = event.pos() - self._pressed, event.pos()
        self._taken = True
        if event.buttons() & Qt.MiddleButton or event.modifiers() & Qt.ShiftModifier:
            right = np.array([-math.sin(self._azimuth), math.cos(self._azimuth), 0.0])
            scale = self._distance * math.tan(self._hfov(self.width(), self.height()) / 2) * 2 / max(self.width(), 1)
            self._target = self._target - right * moved.x() * scale + np.array([0, 0, 1.0]) * moved.y() * scale
        else:
            self._azimuth -= moved.x() * 0.01
            self._elevation = min(1.55, max(-1.55, self._elevation + moved.y() * 0.01))
        self._timer.start(0)

    def wheelEvent(self, event) -> None:
        self._taken = True
        self._distance = min(200.0, max(0.05, self._distance * 0.999 ** event.angleDelta().y()))
        self._timer.start(0)
