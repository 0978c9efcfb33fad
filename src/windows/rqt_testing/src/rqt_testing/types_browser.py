"""What the browsers of messages, services and actions have in common, as a person uses them."""

import contextlib

from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@contextlib.contextmanager
def open_browser(plugin, settings):
    """The browser's window with its packages listed, by part of the plugin's name; nothing must go wrong in it.

    :param settings: path of an INI file.
    """
    rospy_without_master()
    with open_plugin(plugin, settings=settings) as gui:
        wait_until(lambda: find(gui, "package_combo").count())
        yield gui
    assert errors == []


def children(item):
    """Texts of the rows below an item."""
    return [item.child(row).text() for row in range(item.rowCount())]


def shows(gui, package, name, parts, fields, text):
    """Adds a type, looks at its tree and its text, and removes it.

    :param gui: of :func:`rqt_testing.in_process.open_plugin`
    :param package, name: of the type
    :param parts: texts of the rows that come.
    :param fields: of the first of them.
    :param text: a part of the definition.
    """
    find(gui, "package_combo").setCurrentText(package)
    find(gui, "message_combo").setCurrentText(name)
    find(gui, "add_button").click()
    tree = gui.plugin.widget.tree
    tops = [tree.model_.item(row) for row in range(tree.model_.rowCount())]
    assert [item.text() for item in tops] == parts
    assert children(tops[0]) == fields
    tree.selectAll()
    dialog = tree.view_text()
    assert text in find(dialog, "definition_text").toPlainText()
    dialog.close()
    find(gui, "remove_button").click()
    assert tree.model_.rowCount() == 0
