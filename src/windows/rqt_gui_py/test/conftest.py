"""Packages made up for a test, on a ROS_PACKAGE_PATH of its own."""

import sys

import pytest
import rospkg
from rqt_gui import rospkg_plugin_provider
from rqt_testing import in_process  # noqa: F401 before anything of Qt

MANIFEST = """<package format="2"><name>{name}</name><version>1.2.3</version><description>d</description>
<maintainer email="a@b.c">Somebody</maintainer><license>BSD</license><url type="website">http://example.org/{name}</url>
<export><rqt_gui plugin="${{prefix}}/plugin.xml"/></export></package>"""
PLUGIN = """<library path="{path}"><class name="{cls}" type="{type}" base_class_type="{base}"><description/>
<qtgui><group><label>Topics</label></group><label>{label}</label><icon type="theme">folder</icon></qtgui></class></library>"""


class Workspace:
    """``make`` writes a package with one plugin; ``providers`` are what rqt would ask."""

    def __init__(self, folder):
        self.folder = folder

    def make(self, name, code="", cls="Plugin", kind=None, base="rqt_gui_py::Plugin", path="src", label=None, manifest=MANIFEST):
        package = self.folder / name
        (package / "src" / name).mkdir(parents=True, exist_ok=True)
        (package / "package.xml").write_text(manifest.format(name=name))
        (package / "plugin.xml").write_text(
            PLUGIN.format(path=path, cls=cls, type=kind or f"{name}.module.{cls}", base=base, label=label or name)
        )
        (package / "src" / name / "__init__.py").write_text("")
        (package / "src" / name / "module.py").write_text(code)
        return package

    def providers(self):
        from rqt_gui.main import Main

        main = Main(ros_pack=rospkg.RosPack([str(self.folder), *rospkg.get_ros_paths()]))
        main._add_plugin_providers()
        return main.plugin_providers


@pytest.fixture
def workspace(tmp_path):
    in_process.application()
    in_process.rospy_without_master()
    before, modules = list(sys.path), set(sys.modules)
    yield Workspace(tmp_path / "ws")
    sys.path[:] = before
    for name in set(sys.modules) - modules:
        if str(tmp_path) in str(getattr(sys.modules[name], "__file__", "")):
            del sys.modules[name]
    rospkg_plugin_provider.RospkgPluginProvider.rospack = None
    rospkg_plugin_provider._known.clear()
