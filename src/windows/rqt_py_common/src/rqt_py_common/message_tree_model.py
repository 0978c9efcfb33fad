"""A message as a tree: name, type, path of each field."""

from python_qt_binding.QtGui import QStandardItem, QStandardItemModel

from rqt_py_common.data_items import ReadonlyItem


class MessageTreeModel(QStandardItemModel):
    """Rows of fields. Each item has ``_path`` (``/topic/field[0]/x``) and ``_user_data``.

    A derived class changes the columns by :meth:`_get_data_items_for_path`.
    """

    def __init__(self, parent=None):
        super().__init__(parent)

    def add_message(self, message_instance, message_name="", message_type="", message_path=""):
        """Append a message, with all fields that ``message_instance`` has; None appends nothing.

        :param message_name: shown in its row
        :param message_type: ``package/Name``
        :param message_path: put before the paths of its fields: the topic
        """
        if message_instance is not None:
            self._recursive_create_items(self, message_instance, message_name, message_type, message_path)

    def _get_toplevel_items(self, index_list):
        """The topmost items above those of a selection, each once."""
        tops: dict = {}
        for index in index_list:
            item = self.itemFromIndex(index)
            while item.parent() is not None:
                item = item.parent()
            tops.setdefault(item.row(), item)
        return list(tops.values())

    def _get_data_items_for_path(self, slot_name, slot_type_name, slot_path, **kwargs):
        return QStandardItem(slot_name), QStandardItem(slot_type_name), QStandardItem(slot_path)

    def _recursive_create_items(self, parent, slot, slot_name, slot_type_name, slot_path, **kwargs):
        """Append the row of one field, and below it those of its own fields; (row, whether it has none)."""
        row = list(self._get_data_items_for_path(slot_name, slot_type_name, slot_path, **kwargs))
        for item in row:
            item._path = slot_path
            item._user_data = kwargs.get("user_data")
        children = list(_fields(slot, slot_type_name, slot_path))
        for child, name, type_name, path in children:
            self._recursive_create_items(row[0], child, name, type_name, path, **kwargs)
        if parent is self and kwargs.get("top_level_row_number") is not None:
            parent.insertRow(kwargs["top_level_row_number"], row)
        else:
            parent.appendRow(row)
        return row, not children

    @staticmethod
    def _build_tree_recursive(stditem_parent, names_on_branch):
        """Append a branch of names; a name that equals the last one of its level goes below that."""
        last = stditem_parent.child(stditem_parent.rowCount() - 1) if stditem_parent.rowCount() else None
        if last is None or last.text() != names_on_branch[0]:
            last = ReadonlyItem(names_on_branch[0])
            stditem_parent.appendRow(last)
        if names_on_branch[1:]:
            MessageTreeModel._build_tree_recursive(last, names_on_branch[1:])


def _fields(slot, type_name, path):
    """(value, name, type, path) of the fields of a message, or of the elements of a list that has some."""
    if hasattr(slot, "__slots__") and hasattr(slot, "_slot_types"):
        for name, kind in zip(slot.__slots__, slot._slot_types):
            yield getattr(slot, name), name, kind, f"{path}/{name}"
    elif isinstance(slot, (list, tuple)):
        for index, element in enumerate(slot):
            yield element, f"[{index}]", type_name.split("[")[0], f"{path}[{index}]"
