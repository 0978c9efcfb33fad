"""The name under which other packages hand a console its messages."""

from python_qt_binding.QtCore import QIdentityProxyModel


class MessageProxyModel(QIdentityProxyModel):
    """``setSourceModel(MessageDataModel())``, then ``ConsoleWidget(proxy)``: the model itself sorts and filters."""
