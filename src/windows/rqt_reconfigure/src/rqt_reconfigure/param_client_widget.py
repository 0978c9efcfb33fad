"""The editors of one server."""

from typing import Any

import rospy
from python_qt_binding.QtCore import Qt, Signal
from python_qt_binding.QtGui import QIcon
from python_qt_binding.QtWidgets import QFileDialog, QHBoxLayout, QLabel, QPushButton, QToolButton, QVBoxLayout, QWidget
from rqt_py_common.background import Background

from . import saved_values
from .dynamic import Client
from .param_groups import GroupWidget

PATIENCE = 3.0  # s that a server has to answer


class ParamClientWidget(QWidget):
    """Connects in the background; until then, and when the server is dead, a line says so."""

    close_requested = Signal(str)
    answered = Signal(str, bool)  # node, whether it did
    _updated = Signal(object)

    def __init__(self, node: str, make_client=Client):
        """:param make_client: dynamic_reconfigure.client.Client or the like"""
        super().__init__()
        self.setObjectName(f"client{node}")
        self.node, self._make_client = node, make_client
        self._client: Any = None  # what make_client makes, once the node is there
        self.group: GroupWidget | None = None
        self._to_send: dict[str, Any] = {}
        self._closed = False
        self._background = Background(self)
        self.title_label, self.status_label = QLabel(f"<b>{node}</b>"), QLabel("waiting for its description ...")
        self.status_label.setObjectName("status_label")
        self.status_label.setWordWrap(True)
        bar = QHBoxLayout()
        bar.addWidget(self.title_label)
        bar.addStretch()
        for name, text, icon, call in (
            ("load_button", "Load", "document-open", self.ask_and_load),
            ("save_button", "Save", "document-save", self.ask_and_save),
        ):
            button = QPushButton(QIcon.fromTheme(icon), text)
            button.setObjectName(name)
            button.clicked.connect(lambda checked=False, call=call: call())
            bar.addWidget(button)
        close = QToolButton()
        close.setObjectName("close_button")
        close.setText("x")
        close.clicked.connect(lambda: self.close_requested.emit(self.node))
        bar.addWidget(close)
        self._layout = QVBoxLayout(self)
        self._layout.addLayout(bar)
        self._layout.addWidget(self.status_label)
        self._layout.addStretch()
        self._layout.setAlignment(Qt.AlignmentFlag.AlignTop)
        self._updated.connect(self._show_config)
        self._background.run("connect", self._connect, self._connected, self._failed)

    def _connect(self):
        client = self._make_client(self.node, timeout=PATIENCE, config_callback=self._config_received)
        description = client.get_group_descriptions(timeout=PATIENCE)
        config = client.get_configuration(timeout=PATIENCE)
        if self._closed or description is None or config is None:
            client.close()
            raise rospy.ROSException(f"{self.node} has the service set_parameters, but does not describe its parameters")
        return client, description, config

    def _config_received(self, config) -> None:
        """In rospy's thread."""
        if config is not None and not self._closed:
            self._updated.emit(config)

    def _connected(self, found) -> None:
        self._client, description, config = found
        self.group = group = GroupWidget(description)
        group.changed.connect(self.send)
        group.group_changed.connect(lambda name, on: self.send({"groups": {name: on}}))
        self.group.show_values(config)
        self._layout.insertWidget(2, self.group)
        self.status_label.clear()
        self.answered.emit(self.node, True)

    def _failed(self, error) -> None:
        self.status_label.setText(f"{self.node} does not answer: {error}")
        self.answered.emit(self.node, False)

    def _show_config(self, config) -> None:
        if self.group is not None:
            self.group.show_values({name: value for name, value in config.items() if name not in self._to_send})

    def send(self, values: dict) -> None:
        """Let the server have these values; while it is busy with others they wait, the newest of each."""
        self._to_send.update(values)
        self._send_next()

    def _send_next(self, _result=None) -> None:
        if self._to_send and self._client is not None and not self._background.busy("send"):
            values, self._to_send = self._to_send, {}
            self._background.run("send", lambda: self._client.update_configuration(dict(values)), self._sent, self._not_sent)

    def _sent(self, config) -> None:
        self.status_label.clear()
        if config is not None:
            self._show_config(config)
        self._send_next()

    def _not_sent(self, error) -> None:
        self._to_send.clear()
        self.status_label.setText(f"{self.node} did not take it: {error}")
        if self.group is not None and self._client.config is not None:
            self.group.show_values(self._client.config)

    def ask_and_load(self) -> None:
        path, _ = QFileDialog.getOpenFileName(self, "Load parameters", ".", "YAML files (*.yaml *.yml);;All files (*)")
        if path:
            self.load(path)

    def load(self, path: str) -> None:
        try:
            values = saved_values.load(path)
        except saved_values.SavedValuesError as error:
            self.status_label.setText(str(error))
            return
        known: dict[str, Any] = self.group.all_editors() if self.group else {}
        unknown = sorted(set(values) - set(known))
        self.send({name: value for name, value in values.items() if name in known})
        if unknown:
            self.status_label.setText(f"{path}: {self.node} has no {', '.join(unknown[:5])}")

    def ask_and_save(self) -> None:
        path, _ = QFileDialog.getSaveFileName(
            self, "Save parameters", f"{self.node.strip('/').replace('/', '_')}.yaml", "YAML files (*.yaml)"
        )
        if path:
            self.save(path)

    def save(self, path: str) -> None:
        if self._client is None or self._client.config is None:
            self.status_label.setText(f"{self.node} has not told its parameters yet")
            return
        try:
            saved_values.save(path, self._client.config)
        except OSError as error:
            self.status_label.setText(f"{path}: {error.strerror}")

    def close_client(self) -> None:
        self._closed = True
        self._background.close()
        if self._client is not None:
            self._client.close()
