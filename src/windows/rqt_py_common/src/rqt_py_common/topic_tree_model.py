"""All topics of the master as a tree."""

from rqt_py_common.message_tree_model import MessageTreeModel
from rqt_py_common.topic_completer import fill_with_topics


class TopicTreeModel(MessageTreeModel):
    """Filled when it is made."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.refresh()

    def refresh(self):
        self._topics = None
        fill_with_topics(self)
