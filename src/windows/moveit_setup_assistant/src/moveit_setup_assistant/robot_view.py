"""The picture of the robot beside the screens: turned by dragging, with links that light up."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from ode_sim_rendering import Camera, Renderer, RenderingUnavailable, look_at
from python_qt_binding.QtCore import QPoint, Qt, QTimer, Signal
from python_qt_binding.QtGui import QImage, QPainter
from python_qt_binding.QtWidgets import QWidget

from moveit_setup_assistant.robot_scene import RobotScene
from moveit_setup_assistant.robot_source import Robot

_HFOV = 0.8  # rad
_LARGEST = 900  # pixels along a side that are drawn; a larger window shows them larger


class RobotView(QWidget):
    """Draws a robot in the state it is given. The mouse turns it (left), moves it (middle or shift), and comes nearer (wheel).

    ``problem`` carries one line when something of the robot, or all of it, cannot be drawn.
    """

    problem = Signal(str)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("robot_view")
        self.setMinimumSize(280, 240)
        self._renderer: Renderer | None = None
        self._scene: RobotScene | None = None
        self._poses = np.zeros((0, 7))
        self._image = QImage()
        self._azimuth, self._elevation, self._distance, self._target = math.pi / 5, 0.4, 2.0, np.zeros(3)
        self._pressed: QPoint | None = None
        self._timer = QTimer(self)  # one picture for many changes in one go
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._draw)

    def set_robot(self, robot: Robot | None) -> None:
        """Show another robot in its default state, all of it in the picture; None for nothing."""
        self._scene = RobotScene(robot) if robot else None
        if robot is None or self._scene is None:
            self._image = QImage()
            self.update()
            return
        if self._renderer is None:
            try:
                self._renderer = Renderer(antialiasing="msaa", shadows="off")
            except RenderingUnavailable as error:
                self._scene = None
                self.problem.emit(f"The robot cannot be shown: {error}")
                return
        self._poses = self._scene.poses(robot.model.state())
        self._renderer.set_scene(self._scene.description())
        self._frame_robot()
        for line in self._renderer.take_problems():
            self.problem.emit(line)
        self._timer.start(0)

    def set_state(self, state) -> None:
        """Show the robot in another state of its own model."""
        if self._scene is not None:
            self._poses = self._scene.poses(state)
            self._timer.start(0)

    def highlight(self, links: Iterable[str]) -> None:
        """Light up these links, and no others."""
        if self._scene is not None and self._renderer is not None:
            self._renderer.set_scene(self._scene.description(links))
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

    def _frame_robot(self) -> None:
        low, high = self._poses[:, :3].min(axis=0), self._poses[:, :3].max(axis=0)
        self._target = (low + high) / 2
        self._distance = max(0.5, 1.6 * float(np.linalg.norm(high - low)) + 0.3)

    def _eye(self) -> np.ndarray:
        level = math.cos(self._elevation)
        away = np.array([level * math.cos(self._azimuth), level * math.sin(self._azimuth), math.sin(self._elevation)])
        return self._target + self._distance * away

    def _draw(self) -> None:
        if self._scene is None or self._renderer is None:
            return
        shrink = min(1.0, _LARGEST / max(self.width(), self.height(), 1))
        width, height = max(16, int(self.width() * shrink)), max(16, int(self.height() * shrink))
        camera = Camera(
            "view",
            width,
            height,
            _HFOV,
            near=self._distance / 100,
            far=self._distance * 20,
            pose=look_at(tuple(self._eye()), tuple(self._target)),
        )
        pixels = np.ascontiguousarray(self._renderer.color(camera, self._poses))
        self._image = QImage(pixels.data, width, height, 3 * width, QImage.Format_RGB888).copy()
        self.update()

    # ---- what the user does

    def resizeEvent(self, _event) -> None:
        self._timer.start(0)

    def paintEvent(self, _event) -> None:
        painter = QPainter(self)
        if self._image.isNull():
            painter.drawText(self.rect(), Qt.AlignCenter, "The robot appears here when its files are loaded.")
        else:
            painter.drawImage(self.rect(), self._image)

    def mousePressEvent(self, event) -> None:
        self._pressed = event.pos()

    def mouseReleaseEvent(self, _event) -> None:
        self._pressed = None

    def mouseMoveEvent(self, event) -> None:
        if self._pressed is None:
            return
        moved, self._pressed = event.pos() - self._pressed, event.pos()
        if event.buttons() & Qt.MiddleButton or event.modifiers() & Qt.ShiftModifier:
            right = np.array([-math.sin(self._azimuth), math.cos(self._azimuth), 0.0])
            scale = self._distance * math.tan(_HFOV / 2) * 2 / max(self.width(), 1)
            self._target = self._target - right * moved.x() * scale + np.array([0, 0, 1.0]) * moved.y() * scale
        else:
            self._azimuth -= moved.x() * 0.01
            self._elevation = min(1.55, max(-1.55, self._elevation + moved.y() * 0.01))
        self._timer.start(0)

    def wheelEvent(self, event) -> None:
        self._distance = min(200.0, max(0.05, self._distance * 0.999 ** event.angleDelta().y()))
        self._timer.start(0)
