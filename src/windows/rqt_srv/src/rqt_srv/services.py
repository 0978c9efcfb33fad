"""The plugin."""

from rqt_msg.types_widget import TypesPlugin


class Services(TypesPlugin):
    """Definitions of services."""

    name, title, mode = "Services", "Service Type Browser", ".srv"
