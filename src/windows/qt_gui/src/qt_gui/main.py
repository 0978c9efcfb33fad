"""The program: options, application, window, end."""

import os
import signal
import sys
import threading
from typing import Any

from node_signals.display import missing_display

from qt_gui.application import options as command_line
from qt_gui.errors import PerspectiveError, UsageError


class Main:
    """``Main(...).main(argv)`` runs the window and returns the exit code. A face of its own derives from it."""

    main_filename: str | None = None  # of the program that was started

    def __init__(self, qtgui_path=None, invoked_filename=None, settings_filename="qt_gui"):
        """:param settings_filename: name of the INI file, without ending, below ``~/.config/ros.org``"""
        Main.main_filename = invoked_filename or os.path.abspath(sys.argv[0] or __file__)
        self._settings_filename = settings_filename
        self.plugin_providers = []
        self._options: Any = None  # argparse's, from main() on

    def main(self, argv=None, standalone=None, plugin_argument_provider=None, plugin_manager_settings_prefix=""):
        """Run until the window is closed.

        :param argv: with the program's name; None: ``sys.argv``
        :param standalone: the plugin to show alone, as its own command does
        :param plugin_argument_provider: adds the plugin's options to an ``argparse`` parser; ``context.argv()`` has them
        :param plugin_manager_settings_prefix: taken for upstream's callers; it has no effect
        :return: exit code; wrong options of the window give 1
        """
        argv = sys.argv if argv is None else argv
        if threading.current_thread() is threading.main_thread():
            signal.signal(signal.SIGINT, signal.SIG_DFL)  # until there is a window to close, Ctrl-C just ends the process
        program = os.path.basename(Main.main_filename or "")
        try:
            self._options = command_line.parse(program, argv[1:], standalone, plugin_argument_provider)
            return self._run([argv[0]] if argv else [program])
        except (UsageError, PerspectiveError) as error:
            if str(error):
                print(f"{program}: {error}", file=sys.stderr)
            return 1

    def _run(self, argv):
        options = self._options
        if options.qt_binding is not None:
            setattr(sys, "SELECT_QT_BINDING", options.qt_binding)  # noqa: B010  as python_qt_binding is told which one
        from python_qt_binding.QtCore import QSettings

        from qt_gui.application import reporting
        from qt_gui.application.compatibility import accept_floats

        if options.command_start_plugin is not None or options.command_switch_perspective is not None:
            from qt_gui.application.remote_control import send_command

            return send_command(options)
        settings = QSettings(QSettings.Format.IniFormat, QSettings.Scope.UserScope, "ros.org", self._settings_filename)
        if options.clear_config:
            settings.clear()
        reporting.install(options.verbose)
        from qt_gui.gui import Gui

        if options.list_perspectives:
            print("\n".join(sorted(Gui([], settings, options).perspectives.perspectives)))
            return 0
        accept_floats()
        if not options.list_plugins:
            problem = missing_display()
            if problem:
                raise UsageError(problem)
            app = self.create_application(argv)
        self._add_plugin_providers()
        gui = Gui(self.plugin_providers, settings, options)
        if options.list_plugins:
            print("\n".join(sorted(gui.plugins.get_plugins().values())))
            return 0
        return self._show(app, gui)

    def _show(self, app, gui):
        from qt_gui.application.interrupts import Interrupts
        from qt_gui.application.remote_control import RemoteControl
        from qt_gui.icon_loader import choose_theme

        choose_theme()
        interrupts = Interrupts(lambda: (app.closeAllWindows(), app.quit()))
        try:
            gui.open()
            remote = RemoteControl(gui)  # noqa: F841 answers as long as it is there
            if interrupts.fired:
                return 0
            return app.exec() if hasattr(app, "exec") else app.exec_()
        finally:
            interrupts.stop()
            gui.dispose()

    def create_application(self, argv):
        """The ``QApplication``; a derived class may dress it."""
        from python_qt_binding.QtCore import QCoreApplication, Qt
        from python_qt_binding.QtWidgets import QApplication

        if hasattr(Qt, "AA_ShareOpenGLContexts"):
            QCoreApplication.setAttribute(Qt.AA_ShareOpenGLContexts)  # web views ask for it before the application is made
        app = QApplication.instance() or QApplication(argv)
        if hasattr(Qt, "AA_DontShowIconsInMenus"):
            app.setAttribute(Qt.AA_DontShowIconsInMenus, False)
        return app

    def _add_plugin_providers(self):
        """Where a derived class appends to ``self.plugin_providers``."""
