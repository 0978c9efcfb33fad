"""What the help button of a dock and Help/About show."""

import webbrowser

from python_qt_binding import QT_BINDING, QT_BINDING_VERSION
from python_qt_binding.QtCore import qVersion
from python_qt_binding.QtWidgets import QMessageBox

from qt_gui.ros_package_helper import package_facts


def show_plugin_help(parent, descriptor):
    """A box above ``parent`` that says where the plugin of ``descriptor`` comes from: description, package, version, author, web page."""
    attributes = descriptor.attributes()
    facts = package_facts(attributes.get("package_name", ""), attributes.get("package_path"))
    url = facts.get("url", "")
    box = QMessageBox(parent)
    box.setObjectName("plugin_help")
    box.setWindowTitle(descriptor.action_attributes().get("label", descriptor.plugin_id()))
    lines = [
        descriptor.action_attributes().get("statustip") or facts.get("description", ""),
        f"Package: {attributes.get('package_name', '')} {facts.get('version', '')}",
        f"Class: {attributes.get('class_type', '')}",
        f"Maintainer: {facts['maintainer']}" if facts.get("maintainer") else "",
        url,
    ]
    box.setText("\n".join(line for line in lines if line))
    box.addButton(QMessageBox.StandardButton.Close)
    if url:
        page = box.addButton("Open web page", QMessageBox.ButtonRole.ActionRole)
        page.clicked.connect(lambda: webbrowser.open(url))
    box.open()


def show_about(parent):
    QMessageBox.about(
        parent,
        "About rqt",
        "<b>rqt</b><p>Windows for ROS: plugins side by side, in perspectives of your own.</p>"
        f"<p>Part of noetic_labs, BSD licence.<br>Qt {qVersion()} through {QT_BINDING} {QT_BINDING_VERSION}</p>",
    )
