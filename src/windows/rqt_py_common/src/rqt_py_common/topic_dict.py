"""All topics of the master as dictionaries."""

import rospy

from rqt_py_common.topic_helpers import get_type_class


class TopicDict:
    """``{topic: {"type": class, "children": {field: {...}}}}``, filled when it is made."""

    def __init__(self):
        self.topic_dict = {}
        self.update_topics()

    def get_topics(self):
        return self.topic_dict

    def update_topics(self):
        self.topic_dict = {}
        for name, kind in rospy.get_published_topics():
            cls = get_type_class(kind)
            if cls is not None:
                self.topic_dict[name] = _describe(cls())


def _describe(field):
    children = {name: _describe(getattr(field, name)) for name in getattr(field, "__slots__", ()) if hasattr(field, "_slot_types")}
    return {"type": type(field), "children": children}
