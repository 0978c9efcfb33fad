"""The plugin."""

from rqt_msg.types_widget import TypesPlugin


class Messages(TypesPlugin):
    """Definitions of messages."""

    name, title, mode = "Messages", "Message Type Browser", ".msg"
