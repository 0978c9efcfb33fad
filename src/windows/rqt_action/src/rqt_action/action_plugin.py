"""The plugin."""

from rqt_msg.types_widget import TypesPlugin


class ActionPlugin(TypesPlugin):
    """Definitions of actions."""

    name, title, mode = "Action", "Action Type Browser", ".action"
