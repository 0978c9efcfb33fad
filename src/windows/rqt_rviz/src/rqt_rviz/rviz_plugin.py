"""The plugin RViz of rqt: Debian's RViz through its Python binding."""

from __future__ import annotations

import argparse
import os
import signal

from node_signals import rviz_displays
from python_qt_binding.QtCore import qWarning
from python_qt_binding.QtGui import QGuiApplication
from python_qt_binding.QtWidgets import (
    QCheckBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLineEdit,
    QPushButton,
    QVBoxLayout,
    QWidget,
)
from qt_gui.errors import PluginLoadError
from rqt_gui_py.plugin import Plugin
from rviz_offscreen import qt


def _import_rviz():
    """:raises PluginLoadError: RViz would end the whole window: no X display, another Qt, or its binding is not there."""
    if QGuiApplication.platformName() != "xcb":
        raise PluginLoadError(
            f"RViz draws on X displays alone, and this window is on '{QGuiApplication.platformName()}'; "
            "set DISPLAY and QT_QPA_PLATFORM=xcb, or use rosrun rviz_offscreen screenshot"
        )
    needed, here = qt.package(), QWidget.__module__.partition(".")[0]
    if needed is None:
        raise PluginLoadError("RViz's Python module is not there; sudo apt install python3-rviz")
    if needed != here:
        raise PluginLoadError(
            f"this machine's RViz is for {needed} and this window is on {here}: run rosrun rqt_rviz rqt_rviz, or "
            f"QT_API={needed.lower()} rqt for a window whose plugins all are on {needed}"
        )
    try:
        from rviz_offscreen.bindings import rviz
    except ImportError as error:
        raise PluginLoadError(f"RViz cannot be loaded: {error}; install python3-rviz") from None
    return rviz


class TheFrame:
    """RViz's frame: a process can make but one, for a second one's materials have the names of the first one's."""

    def __init__(self):
        self._made = self._idle = None

    def take(self, rviz, ogre_log: bool):
        """RViz's frame, made if there is none.

        :param rviz: the module
        :param ogre_log: let Ogre write its log; it counts when the frame is made
        :raises PluginLoadError: another plugin shows it
        """
        if self._idle is not None:
            frame, self._idle = self._idle, None
            return frame
        if self._made is not None:
            raise PluginLoadError("RViz can be open once in a window; run rqt_rviz or rviz for another one")
        rviz_displays.start([])
        if not ogre_log:
            rviz.OgreLogging.noLog()
        self._made = frame = rviz.VisualizationFrame()
        frame.setSplashPath("")
        frame.initialize()
        signal.signal(signal.SIGINT, signal.getsignal(signal.SIGINT))  # roscpp, in RViz, has taken Ctrl-C for itself
        return frame

    def give_back(self) -> None:
        """No plugin shows it any more."""
        self._idle = self._made


_the_frame = TheFrame()


class RViz(Plugin):
    """RViz as a dock."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RViz")
        args = self._parse_args(context.argv())
        self._config, self._hide_menu, self._given = args.display_config, args.hide_menu, bool(args.display_config)
        self._rviz = _import_rviz()
        self._widget = _the_frame.take(self._rviz, args.ogre_log)
        number = context.serial_number()
        self._widget.setWindowTitle("RViz[*]")  # the mark is for changes that are not saved
        self._container = QWidget()
        self._container.setObjectName("RVizContainer")
        self._container.setWindowTitle("RViz" + (f" ({number})" if number > 1 else ""))
        layout = QVBoxLayout(self._container)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self._widget)
        self._widget.show()
        self._hide_quit()
        self._widget.menuBar().setVisible(not self._hide_menu)
        if self._config:
            self._load(self._config)
        context.add_widget(self._container)

    def _parse_args(self, argv):
        parser = argparse.ArgumentParser(prog="rqt_rviz", add_help=False)
        RViz.add_arguments(parser)
        return parser.parse_args(argv)

    @staticmethod
    def add_arguments(parser) -> None:
        group = parser.add_argument_group("Options for rqt_rviz plugin")
        group.add_argument("-d", "--display-config", default="", help="a display configuration file (.rviz) to load")
        group.add_argument("-m", "--hide-menu", action="store_true", help="hide RViz's menu bar")
        # -l is --lock-perspective of rqt itself
        group.add_argument("--ogre-log", action="store_true", help="write Ogre's log")

    def _hide_quit(self) -> None:
        """RViz's Quit would end rqt."""
        menus = self._widget.menuBar().actions()
        entries = menus[0].menu().actions() if menus and menus[0].menu() else []
        if entries:
            entries[-1].setVisible(False)

    def _load(self, name: str) -> None:
        path = os.path.abspath(os.path.expanduser(name))
        if not os.path.isfile(path):
            qWarning(f"rqt_rviz: there is no display configuration {path}")
            return
        config, reader = self._rviz.Config(), self._rviz.YamlConfigReader()
        reader.readFile(config, path)
        if reader.error():
            qWarning(f"rqt_rviz: {path} is no display configuration of RViz: {reader.errorMessage().splitlines()[0][:120]}")
            return
        self._widget.load(config)

    def trigger_configuration(self) -> None:
        """Ask for the configuration file and whether the menu bar is hidden."""
        dialog = QDialog(self._widget)
        dialog.setWindowTitle("RViz")
        name, hide, browse = QLineEdit(self._config), QCheckBox(), QPushButton("Browse...")
        hide.setChecked(self._hide_menu)
        browse.clicked.connect(
            lambda: name.setText(
                QFileDialog.getOpenFileName(dialog, "Display configuration", "", "RViz (*.rviz);;All files (*)")[0] or name.text()
            )
        )
        row = QHBoxLayout()
        row.addWidget(name)
        row.addWidget(browse)
        box = QDialogButtonBox(QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel)
        box.accepted.connect(dialog.accept)
        box.rejected.connect(dialog.reject)
        form = QFormLayout(dialog)
        form.addRow("Display configuration", row)
        form.addRow("Hide menu", hide)
        form.addRow(box)
        dialog.accepted.connect(lambda: self._configure(name.text(), hide.isChecked()))
        dialog.open()

    def _configure(self, name: str, hide_menu: bool) -> None:
        self._config, self._hide_menu = name, hide_menu
        self._widget.menuBar().setVisible(not hide_menu)
        if name:
            self._load(name)

    def save_settings(self, plugin_settings, instance_settings) -> None:
        instance_settings.set_value("rviz_config_file", self._config)
        instance_settings.set_value("hide_menu", self._hide_menu)

    def restore_settings(self, plugin_settings, instance_settings) -> None:
        hide = self._hide_menu or instance_settings.value("hide_menu", False) in (True, "true")
        name = self._config if self._given else str(instance_settings.value("rviz_config_file", "") or "")
        self._configure(name, hide) if not self._given else self._configure_menu(hide)

    def _configure_menu(self, hide: bool) -> None:
        self._hide_menu = hide
        self._widget.menuBar().setVisible(not hide)

    def shutdown_plugin(self) -> None:
        # Its dock goes and takes its children along: RViz has to leave before, to be shown again.
        self._widget.hide()
        self._widget.setParent(None)
        _the_frame.give_back()
