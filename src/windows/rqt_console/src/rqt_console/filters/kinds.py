"""The kinds of rules, in the order of the menus."""

from .custom_filter import CustomFilter
from .location_filter import LocationFilter
from .message_filter import MessageFilter
from .node_filter import NodeFilter
from .severity_filter import SeverityFilter
from .time_filter import TimeFilter
from .topic_filter import TopicFilter

#: Key in settings: (label, class).
KINDS = {
    "message": ("...containing", MessageFilter),
    "severity": ("...with severities", SeverityFilter),
    "node": ("...from node", NodeFilter),
    "time": ("...from time range", TimeFilter),
    "topic": ("...from topic", TopicFilter),
    "location": ("...from location", LocationFilter),
    "custom": ("Custom", CustomFilter),
}
