"""Commands to a running window over D-Bus: start a plugin, switch the perspective.

Every window owns the name ``org.ros.qt_gui.pid<PID>`` on the session bus, the oldest one ``org.ros.qt_gui`` as well.
"""

import os
import shlex

from python_qt_binding.QtCore import QObject, Slot

from qt_gui.errors import UsageError

try:
    from python_qt_binding import QtDBus  # type: ignore[attr-defined]  # a module of whichever binding there is
except ImportError:
    QtDBus = None

_NAME = "org.ros.qt_gui"
_TIMEOUT = 30000  # ms that a plugin may take to start


def _session_bus():
    """The session bus, or None where there is none."""
    if QtDBus is None or not (
        os.environ.get("DBUS_SESSION_BUS_ADDRESS") or os.path.exists(os.path.join(os.environ.get("XDG_RUNTIME_DIR", "/nowhere"), "bus"))
    ):
        return None
    bus = QtDBus.QDBusConnection.sessionBus()
    return bus if bus.isConnected() else None


class RemoteControl(QObject):
    """While it lives, its window can be commanded. Without a session bus it does nothing."""

    def __init__(self, gui):
        super().__init__()
        self._gui = gui
        self._bus = _session_bus()
        if self._bus is not None:
            slots = getattr(QtDBus.QDBusConnection, "RegisterOption", QtDBus.QDBusConnection).ExportAllSlots
            self._bus.registerObject("/RemoteControl", self, slots)
            self._bus.registerService(f"{_NAME}.pid{os.getpid()}")
            self._bus.registerService(_NAME)

    @Slot(result=int)
    def get_pid(self):
        return os.getpid()

    @Slot(str, str, result=str)
    def start_plugin(self, name, argv):
        """Start the plugin that ``name`` fits; the answer begins with "ok " or says what is wrong.

        :param argv: the plugin's arguments in one line, quoted as in a shell
        """
        try:
            plugin_id = self._gui.choose(name)
        except UsageError as error:
            return str(error)
        if not self._gui.plugins.load_plugin(plugin_id, argv=shlex.split(argv)):
            return f"plugin '{plugin_id}' could not be loaded; its reason is on the terminal of that window"
        return f"ok {plugin_id}"

    @Slot(str, result=str)
    def switch_perspective(self, name):
        self._gui.perspectives.switch_perspective(name)
        return f"ok {name}"


def send_command(options):
    """Send the command of the command line to a running window; the exit code.

    :raises UsageError: no bus, no window, or the window refuses.
    """
    bus = _session_bus()
    if bus is None:
        raise UsageError(
            "the --command-* options need a D-Bus session, which this shell has not (DBUS_SESSION_BUS_ADDRESS); "
            "desktops start one, dbus-run-session COMMAND does it by hand"
        )
    name = _NAME if options.command_pid is None else f"{_NAME}.pid{options.command_pid}"
    window = QtDBus.QDBusInterface(name, "/RemoteControl", "", bus)
    window.setTimeout(_TIMEOUT)
    if not window.isValid():
        raise UsageError("no running rqt has been found" + ("" if options.command_pid is None else f" with pid {options.command_pid}"))
    if options.command_start_plugin is not None:
        reply = window.call("start_plugin", options.command_start_plugin, shlex.join(options.plugin_args))
        done = "started plugin"
    else:
        reply = window.call("switch_perspective", options.command_switch_perspective)
        done = "switched to perspective"
    answer = reply.arguments()[0] if reply.arguments() else reply.errorMessage()
    if not answer.startswith("ok "):
        raise UsageError(answer)
    print(f"{done} '{answer[3:]}'")
    return 0
