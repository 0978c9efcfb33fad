"""A plugin's widget with a pane below for its messages."""

from python_qt_binding.QtCore import QByteArray, Qt
from python_qt_binding.QtWidgets import QProgressBar, QSplitter, QTextBrowser, QVBoxLayout, QWidget


class PluginContainerWidget(QWidget):
    """Shows what the widget emits by its signals ``sig_sysmsg`` (text) and ``sig_sysprogress`` (percent).

    :param plugin_widget: has these signals as far as they are asked for, and ``shutdown``, ``save_settings``,
        ``restore_settings``
    """

    def __init__(self, plugin_widget, on_sys_msg=True, on_sysprogress_bar=True):
        super().__init__()
        self._plugin_widget = plugin_widget
        self._splitter = QSplitter(Qt.Orientation.Vertical, self)
        self._splitter.setObjectName("_splitter")
        self._sysmsg_widget, self._sysprogress_bar = QTextBrowser(self), QProgressBar(self)
        self._sysmsg_widget.setObjectName("_sysmsg_widget")
        self._sysmsg_widget.document().setMaximumBlockCount(10000)
        self._sysprogress_bar.setObjectName("_sysprogress_bar")
        self._sysprogress_bar.setRange(0, 100)
        self._splitter.addWidget(plugin_widget)
        self._splitter.addWidget(self._sysmsg_widget)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self._splitter)
        layout.addWidget(self._sysprogress_bar)
        self.setWindowTitle(plugin_widget.windowTitle())
        if on_sys_msg:
            plugin_widget.sig_sysmsg.connect(self.set_sysmsg)
        else:
            self._sysmsg_widget.hide()
        if on_sysprogress_bar:
            plugin_widget.sig_sysprogress.connect(self.set_sysprogress)
        else:
            self._sysprogress_bar.hide()

    def set_sysprogress(self, sysprogress):
        """Percent done."""
        try:
            self._sysprogress_bar.setValue(int(float(sysprogress)))
        except (TypeError, ValueError):
            pass  # the signal carries whatever a plugin thought of

    def set_sysmsg(self, sysmsg):
        """Append a line to the pane."""
        self._sysmsg_widget.append(sysmsg)

    def shutdown(self):
        self._plugin_widget.shutdown()

    def save_settings(self, plugin_settings, instance_settings):
        """Store the place of the splitter in ``instance_settings``, and what the widget wants to keep; it gets ``plugin_settings`` too."""
        instance_settings.set_value("_splitter", self._splitter.saveState())
        self._plugin_widget.save_settings(plugin_settings, instance_settings)

    def restore_settings(self, plugin_settings, instance_settings):
        """Take back what :meth:`save_settings` stored in ``plugin_settings`` and ``instance_settings``."""
        state = instance_settings.value("_splitter")
        if isinstance(state, QByteArray):
            self._splitter.restoreState(state)
        else:
            self._splitter.setSizes([300, 100])
        self._plugin_widget.restore_settings(plugin_settings, instance_settings)
