"""The plugin: sliders for the joints of a running trajectory controller."""

import math

import rospy
from control_msgs.msg import JointTrajectoryControllerState
from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtWidgets import QComboBox, QFormLayout, QGridLayout, QLabel, QPushButton, QSlider, QVBoxLayout, QWidget
from rqt_gui_py.plugin import Plugin
from rqt_py_common.background import Background
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

from .controllers import ControllerFinder, Found
from .joint_widget import JointWidget

COMMAND_PERIOD, SHOW_PERIOD, LIST_PERIOD = 100, 33, 1000  # ms
SHORTEST = 0.5  # s that a motion takes at full speed


def duration(positions, targets, velocities, scale: float) -> float:
    """Seconds for all joints to arrive together, from ``positions`` at ``targets`` (rad or m).

    :param velocities: the joints' limits, rad/s or m/s
    :param scale: share of them, above 0
    """
    return (
        max([abs(target - position) / velocity for position, target, velocity in zip(positions, targets, velocities)] + [SHORTEST]) / scale
    )


class JointTrajectoryController(Plugin):
    """Off, the sliders follow the robot; on, the robot follows the sliders."""

    def __init__(self, context, finder=None):
        """:param finder: ControllerFinder or the like"""
        super().__init__(context)
        self.setObjectName("joint_trajectory_controller")
        self._finder = finder or ControllerFinder()
        self._background = Background(self)
        self._found, self._wanted = Found({}, ()), ("", "")
        self._subscriber = self._publisher = None
        self._positions = {}  # of the controller's state
        self.joints = {}
        self._build(context)
        self._timers = []
        for call, period in ((self.poll, LIST_PERIOD), (self._show_positions, SHOW_PERIOD), (self.command, COMMAND_PERIOD)):
            timer = QTimer(self)
            timer.timeout.connect(call)
            timer.start(period)
            self._timers.append(timer)
        self.poll()

    def _build(self, context) -> None:
        self._widget = QWidget()
        self._widget.setObjectName("JointTrajectoryControllerUi")
        number = context.serial_number()
        self._widget.setWindowTitle("Joint trajectory controller" + (f" ({number})" if number > 1 else ""))
        self.manager_box, self.controller_box = QComboBox(), QComboBox()
        self.manager_box.setObjectName("cm_combo")
        self.controller_box.setObjectName("jtc_combo")
        self.enable_button = QPushButton("off")
        self.enable_button.setObjectName("enable_button")
        self.enable_button.setCheckable(True)
        self.enable_button.setEnabled(False)
        self.enable_button.setToolTip("Off: the sliders follow the robot. On: the robot follows the sliders.")
        self.speed_slider, self.speed_label = QSlider(Qt.Orientation.Horizontal), QLabel()
        self.speed_slider.setObjectName("speed_scaling_slider")
        self.speed_slider.setRange(1, 100)
        self.speed_slider.valueChanged.connect(lambda value: self.speed_label.setText(f"{value} %"))
        self.speed_slider.setValue(50)
        self.status_label = QLabel()
        self.status_label.setObjectName("status_label")
        self.status_label.setWordWrap(True)
        grid, layout = QGridLayout(), QVBoxLayout(self._widget)
        for column, widget in enumerate((QLabel("controller manager ns"), QLabel("controller"))):
            grid.addWidget(widget, 0, column)
        grid.addWidget(self.manager_box, 1, 0)
        grid.addWidget(self.controller_box, 1, 1)
        grid.addWidget(self.enable_button, 1, 2)
        layout.addLayout(grid)
        self._form_place = QVBoxLayout()
        self._form = None
        layout.addLayout(self._form_place)
        speed = QGridLayout()
        speed.addWidget(QLabel("speed scaling"), 0, 0)
        speed.addWidget(self.speed_slider, 0, 1)
        speed.addWidget(self.speed_label, 0, 2)
        layout.addLayout(speed)
        layout.addWidget(self.status_label)
        layout.addStretch()
        self.manager_box.currentTextChanged.connect(self._manager_changed)
        self.controller_box.currentTextChanged.connect(self._controller_changed)
        self.enable_button.toggled.connect(self._enabled)
        self._enabled(False)
        context.add_widget(self._widget)

    # what there is

    def poll(self) -> None:
        self._background.run("managers", self._finder.managers, self._show_managers, lambda error: self._show_managers([]))
        manager = self.manager_box.currentText()
        if manager:
            self._background.run(
                ("controllers", manager),
                lambda: self._finder.controllers(manager),
                lambda found: self._show_controllers(manager, found),
                lambda error: self._show_controllers(manager, Found({}, (f"{manager} does not answer: {error}",))),
            )

    def _show_managers(self, names) -> None:
        if self._refill(self.manager_box, names, self._wanted[0]):
            self._manager_changed(self.manager_box.currentText())
        if not names:
            self.status_label.setText("there is no controller manager")

    def _manager_changed(self, manager: str) -> None:
        self._wanted = (manager or self._wanted[0], self._wanted[1])
        self._found = Found({}, ())
        if self._refill(self.controller_box, [], ""):
            self._controller_changed("")
        self.poll() if manager else None

    def _show_controllers(self, manager: str, found: Found) -> None:
        if manager != self.manager_box.currentText():
            return
        same = self._found.usable.get(self.controller_box.currentText()) == found.usable.get(self.controller_box.currentText())
        self._found = found
        if self._refill(self.controller_box, list(found.usable), self._wanted[1]) or not same:
            self._controller_changed(self.controller_box.currentText())
        self.status_label.setText("\n".join(found.reasons))

    @staticmethod
    def _refill(box, names, wanted: str) -> bool:
        """Whether another entry is chosen now."""
        before = box.currentText()
        if [box.itemText(n) for n in range(box.count())] == list(names):
            return False
        blocked = box.blockSignals(True)
        box.clear()
        box.addItems(names)
        for name in (wanted, before):
            if name in names:
                box.setCurrentText(name)
        box.blockSignals(blocked)
        return box.currentText() != before

    def _controller_changed(self, controller: str) -> None:
        self.enable_button.setChecked(False)
        self._disconnect()
        if self._form is not None:
            self._form.hide()
            self._form.deleteLater()
            self._form, self.joints = None, {}
        limits = self._found.usable.get(controller)
        self.enable_button.setEnabled(False)
        if limits is None:
            return
        self._wanted = (self._wanted[0], controller)
        self._form = QWidget()
        form = QFormLayout(self._form)
        for name, limit in limits.items():
            self.joints[name] = JointWidget(name, limit.lowest, limit.highest)
            self.joints[name].setEnabled(False)
            form.addRow(name, self.joints[name])
        self._form_place.addWidget(self._form)
        namespace = f"{self.manager_box.currentText().rsplit('/', 1)[0]}/{controller}"
        self._subscriber = rospy.Subscriber(f"{namespace}/state", JointTrajectoryControllerState, self.state_received, queue_size=1)
        self._publisher = rospy.Publisher(f"{namespace}/command", JointTrajectory, queue_size=1)

    # the robot

    def state_received(self, state) -> None:
        """In rospy's thread."""
        self._positions = dict(zip(state.joint_names, state.actual.positions))

    def _show_positions(self) -> None:
        positions = self._positions
        if not self.joints or not all(math.isfinite(positions.get(name, math.nan)) for name in self.joints):
            return
        self.enable_button.setEnabled(True)
        if not self.enable_button.isChecked():
            for name, widget in self.joints.items():
                widget.show_value(positions[name])

    def _enabled(self, on: bool) -> None:
        self.enable_button.setText("on" if on else "off")
        self.enable_button.setStyleSheet(f"background-color: {'#2eb82e' if on else '#d93030'}; color: white")
        for widget in self.joints.values():
            widget.setEnabled(on)

    def command(self) -> None:
        """One point: where the sliders are."""
        if not self.enable_button.isChecked() or self._publisher is None:
            return
        limits = self._found.usable.get(self.controller_box.currentText(), {})
        names = [name for name in self.joints if name in self._positions and name in limits]
        targets = [self.joints[name].value() for name in names]
        point = JointTrajectoryPoint(positions=targets)
        point.time_from_start = rospy.Duration(
            duration(
                [self._positions[name] for name in names],
                targets,
                [limits[name].velocity for name in names],
                self.speed_slider.value() / 100,
            )
        )
        try:
            self._publisher.publish(JointTrajectory(joint_names=names, points=[point]))
        except rospy.ROSException:  # the node is being shut down
            pass

    def _disconnect(self) -> None:
        for end in (self._subscriber, self._publisher):
            if end is not None:
                end.unregister()
        self._subscriber = self._publisher = None
        self._positions = {}

    def shutdown_plugin(self) -> None:
        for timer in self._timers:
            timer.stop()
        self._background.close()
        self._disconnect()

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("cm_ns", self._wanted[0])
        instance_settings.set_value("jtc_name", self._wanted[1])

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        self._wanted = (instance_settings.value("cm_ns", "") or "", instance_settings.value("jtc_name", "") or "")
