"""Completion of topics and their fields in a line edit."""

import rospy
from python_qt_binding.QtCore import qDebug

from rqt_py_common.message_tree_model import MessageTreeModel
from rqt_py_common.topic_helpers import get_type_class
from rqt_py_common.tree_model_completer import TreeModelCompleter


class TopicCompleter(TreeModelCompleter):
    """``edit.setCompleter(TopicCompleter(edit))``, and :meth:`update_topics` when the edit is entered."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setModel(MessageTreeModel())

    def splitPath(self, path):
        """An index is a level of its own, as it is in the tree: ``/t/field[0]/x``."""
        return super().splitPath(path.replace("[", "/["))

    def update_topics(self):
        """Ask the master for its topics; those whose messages are not installed here are left out."""
        fill_with_topics(self.model())


def fill_with_topics(model, topics=None):
    """Make ``model`` hold all topics, or those given as (name, type) pairs; one that has the same topics is left alone, so
    that a list which is open stays so."""
    topics = sorted(rospy.get_published_topics() if topics is None else topics)
    if getattr(model, "_topics", None) == topics:
        return
    model.clear()
    model._topics = topics
    for name, kind in topics:
        cls = get_type_class(kind)
        if cls is None:
            qDebug(f"topic {name} is left out: its type {kind} cannot be imported")
            continue
        model.add_message(cls(), name.strip("/"), kind, name)
