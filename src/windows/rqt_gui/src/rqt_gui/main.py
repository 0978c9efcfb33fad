"""rqt: the window of qt_gui, with the plugins of all packages that ROS finds."""

import os
import sys

import rospkg
import rospy
from qt_gui.main import Main as Base


class Main(Base):
    """A plugin's own command is ``sys.exit(Main().main(sys.argv, standalone="package"))``."""

    def __init__(self, filename=None, ros_pack=None, settings_filename="rqt_gui"):
        """:param filename: the script that was started, for the messages; settings are in ``~/.config/ros.org``"""
        self._ros_pack = ros_pack or rospkg.RosPack()
        super().__init__(invoked_filename=filename, settings_filename=settings_filename)

    def main(self, argv=None, standalone=None, plugin_argument_provider=None, plugin_manager_settings_prefix=""):
        """See :meth:`qt_gui.main.Main.main`; ROS remappings are taken out of ``argv`` first.

        ``standalone``, ``plugin_argument_provider`` and ``plugin_manager_settings_prefix`` are the same there.
        """
        argv = rospy.myargv(sys.argv if argv is None else argv)
        try:
            return super().main(
                argv,
                standalone=standalone,
                plugin_argument_provider=plugin_argument_provider,
                plugin_manager_settings_prefix=plugin_manager_settings_prefix,
            )
        finally:
            if rospy.core.is_initialized():
                rospy.signal_shutdown("the window is closed")

    def create_application(self, argv):
        from python_qt_binding.QtGui import QIcon

        app = super().create_application(argv)
        app.setWindowIcon(QIcon(os.path.join(self._ros_pack.get_path("rqt_gui"), "resource", "rqt.svg")))
        return app

    def _add_plugin_providers(self):
        from qt_gui.recursive_plugin_provider import RecursivePluginProvider

        from rqt_gui.rospkg_plugin_provider import CompiledPluginProvider, RospkgPluginProvider

        RospkgPluginProvider.rospack = self._ros_pack
        self.plugin_providers.append(RospkgPluginProvider("qt_gui", "qt_gui_py::Plugin"))
        for tag, base in (("qt_gui", "qt_gui_py::PluginProvider"), ("rqt_gui", "rqt_gui_py::PluginProvider")):
            self.plugin_providers.append(RecursivePluginProvider(RospkgPluginProvider(tag, base)))
        self.plugin_providers.append(CompiledPluginProvider())


if __name__ == "__main__":
    sys.exit(Main().main())
