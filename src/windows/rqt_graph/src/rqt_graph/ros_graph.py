"""The window of the graph."""

import threading

import rospy
from python_qt_binding.QtCore import Qt, QTimer, Signal
from python_qt_binding.QtGui import QKeySequence
from python_qt_binding.QtWidgets import QCheckBox, QComboBox, QCompleter, QLineEdit, QSpinBox, QToolTip, QVBoxLayout, QWidget
from qt_gui.application.compatibility import QShortcut
from rosgraph_msgs.msg import TopicStatistics
from rqt_gui_py.plugin import Plugin

from rqt_graph.background import Latest
from rqt_graph.command import add_arguments
from rqt_graph.dotcode import NODE_NODE_GRAPH, NODE_TOPIC_ALL_GRAPH, NODE_TOPIC_GRAPH, Options, Statistics, generate_dot
from rqt_graph.graph_pane import GraphPane
from rqt_graph.ros_state import WONKY, NoMaster, read, service_types
from rqt_graph.toolbar import Row

_TYPES = (("Nodes only", NODE_NODE_GRAPH), ("Nodes/Topics (active)", NODE_TOPIC_GRAPH), ("Nodes/Topics (all)", NODE_TOPIC_ALL_GRAPH))
PERIOD = 2000  # ms between two automatic refreshes
# object name, name of the setting, option, text, tool tip
_GROUPS = (
    ("actionlib_check_box", "group_actions", "Actions", "Summarize action topics into one, named <server>/action_topics"),
    ("group_tf_check_box", "group_tf", "tf", "Summarize tf and tf_static into one, named /tf"),
    ("group_image_check_box", "group_images", "Images", "Summarize the transports of an image, named <image>/image_topics"),
)
_HIDES = (
    ("dead_sinks_check_box", "hide_dead_sinks", "Dead sinks", "Hide topics without subscribers"),
    ("leaf_topics_check_box", "hide_leaf_topics", "Leaf topics", "Hide topics with one connection only"),
    ("quiet_check_box", "hide_debug", "Debug", "Hide common debugging nodes and topics"),
    ("hide_tf_nodes_check_box", "hide_tf", "tf", "Hide tf and tf_static"),
    ("unreachable_check_box", "hide_unreachable", "Unreachable", "Hide nodes that do not answer"),
    ("hide_dynamic_reconfigure_check_box", "hide_params", "Params", "Hide the parameter topics of dynamic_reconfigure"),
)


class RosGraph(Plugin):
    """Nodes and topics of the running system. The master is asked in a thread: when this begins, on Refresh, and every two
    seconds while Auto is on."""

    _statistics_came = Signal(object)
    _types_came = Signal(str, object)

    @staticmethod
    def add_arguments(parser):
        add_arguments(parser)

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RosGraph")
        self._state = None
        self._statistics = {}
        self._loaded = False  # a file is shown
        self._tips = {}
        self._widget = QWidget()
        self._widget.setObjectName("RosGraphUi")
        number = context.serial_number()
        self._widget.setWindowTitle("Node Graph" + (f" ({number})" if number > 1 else ""))
        self.pane = GraphPane(self._widget)
        self._build()
        self._reader = Latest(self)
        self._reader.done.connect(self._on_read)
        self._timer = QTimer(self)
        self._timer.timeout.connect(self.refresh)
        self._statistics_came.connect(self._on_statistics)
        self._types_came.connect(self._on_types)
        self.pane.tool_tip_wanted.connect(self._on_tool_tip)
        self.pane.drawn.connect(self._tell_hidden)
        QShortcut(QKeySequence("Ctrl+R"), self._widget, self.refresh).setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
        context.add_widget(self._widget)
        self._subscriber = rospy.Subscriber("/statistics", TopicStatistics, self._statistics_came.emit, queue_size=100)
        self.refresh()

    def _build(self):
        rows = QVBoxLayout(self._widget)
        rows.setContentsMargins(3, 3, 3, 3)
        rows.setSpacing(2)
        first, second, third = Row(), Row(), Row()
        for row in (first, second, third):
            rows.addLayout(row)
        rows.addWidget(self.pane, 1)
        first.button("refresh_graph_push_button", "view-refresh", "Refresh", "Refresh ROS graph (Ctrl+R)", self.refresh)
        self.auto_box = first.check("auto_refresh_check_box", "Auto", "Refresh every two seconds", False, self._set_auto)
        self.type_box = QComboBox()
        self.type_box.setObjectName("graph_type_combo_box")
        self.type_box.setToolTip("Choose graph type")
        for text, mode in _TYPES:
            self.type_box.addItem(text, mode)
        self.type_box.currentIndexChanged.connect(lambda index: self.update())
        first.addWidget(self.type_box)
        self.node_filter = self._filter("filter_line_edit", "Nodes", "-/rqt.*", first)
        self.topic_filter = self._filter("topic_filter_line_edit", "Topics", "-/tf", first)
        first.file_buttons(self.pane, "rosgraph", self._load)
        second.label("Group:")
        self.namespaces = QSpinBox()
        self.namespaces.setObjectName("namespace_cluster_spin_box")
        self.namespaces.setToolTip("Show namespace boxes, nested up to this number")
        self.namespaces.setRange(0, 9)
        self.namespaces.setValue(2)
        self.namespaces.valueChanged.connect(lambda value: self.update())
        second.addWidget(self.namespaces)
        second.label("Namespaces")
        defaults = Options()
        self._boxes = {option: second.check(name, text, tip, getattr(defaults, option), self.update) for name, option, text, tip in _GROUPS}
        second.addStretch(1)
        self.highlight_box: QCheckBox = second.check(
            "highlight_connections_check_box",
            "Highlight",
            "Highlight connections under the mouse",
            True,
            lambda: self.pane.set_highlight(self.highlight_box.isChecked()),
        )
        self.fit_box: QCheckBox = second.check(
            "auto_fit_graph_check_box",
            "Fit",
            "Automatically fit graph into view",
            True,
            lambda: self.pane.set_auto_fit(self.fit_box.isChecked()),
        )
        second.button("fit_in_view_push_button", "zoom-fit-best", "Fit", "Fit graph in view", self.pane.fit)
        third.label("Hide:")
        self._boxes.update(
            {option: third.check(name, text, tip, getattr(defaults, option), self.update) for name, option, text, tip in _HIDES}
        )
        third.addStretch(1)

    def _filter(self, name, kind, example, row):
        edit = QLineEdit("/")
        edit.setObjectName(name)
        edit.setToolTip(f"{kind} to show: names or regular expressions between commas; a leading - excludes. Example: {example}")
        edit.setCompleter(_ListCompleter([], edit))
        edit.textChanged.connect(lambda text: self.update())
        row.addWidget(edit, 1)
        return edit

    def options(self):
        """What the controls say."""
        return Options(
            self.type_box.currentData(),
            self.node_filter.text(),
            self.topic_filter.text(),
            self.namespaces.value(),
            **{option: box.isChecked() for option, box in self._boxes.items()},
        )

    def refresh(self):
        """Read the graph again, soon."""
        self._loaded = False
        if not self._reader.busy():
            self._reader.run(read)

    def _on_read(self, state, error):
        if error is not None:
            if not isinstance(error, NoMaster):
                raise error
            self.pane.show_problem(str(error))
            return
        self.pane.show_problem("")
        self._state = state
        self._tips.clear()
        topics = set(state.publishers) | set(state.subscribers)
        self.node_filter.completer().set_words(state.nodes)
        self.topic_filter.completer().set_words(topics)
        self.update()

    def update(self):
        """Draw what has been read, by the options."""
        if self._state is not None and not self._loaded:
            self.pane.show_dot(generate_dot(self._state, self.options(), self._statistics))
            self._tell_hidden()

    def _tell_hidden(self):
        """A line for nodes that were too slow to answer, as on a busy machine: without them the graph may be empty."""
        if self._state is None or self._loaded:
            return
        slow = sorted(node for node, bad in self._state.bad.items() if bad == WONKY)
        if slow and self.options().hide_unreachable:
            more = f" and {len(slow) - 3} more" if len(slow) > 3 else ""
            self.pane.show_problem(
                f"not shown, because they gave no answer within a second: {', '.join(slow[:3])}{more}; "
                "Refresh asks again, and without Unreachable they are drawn in orange"
            )

    def _set_auto(self):
        self._timer.start(PERIOD) if self.auto_box.isChecked() else self._timer.stop()

    def _load(self):
        self._loaded = True
        if self.pane.ask_load_dot():
            self.auto_box.setChecked(False)
        else:
            self._loaded = False

    def _on_statistics(self, message):
        self._statistics[(message.node_pub, message.topic, message.node_sub)] = Statistics.of(message)

    # tool tips: services of a node with their types, type of a topic; asked for when the mouse rests on it

    def _on_tool_tip(self, name, item, place):
        if self._state is None or self._loaded:
            return
        kind, name = name[:2], name[2:]
        if kind == "t_":
            item.setToolTip(f"{name}: {self._state.types.get(name, 'several types')}")
        elif kind == "n_" and name not in self._tips:
            self._tips[name] = None
            services = sorted(self._state.services.get(name, []))
            threading.Thread(target=self._ask_types, args=(name, services), daemon=True).start()
        QToolTip.showText(place, item.toolTip())

    def _ask_types(self, name, services):
        types = service_types(services)
        try:
            self._types_came.emit(name, types)
        except RuntimeError:
            pass  # the window is closed

    def _on_types(self, name, types):
        item = self.pane.nodes.get("n_" + name)
        if item is not None:
            lines = [f"{service}: {kind}" for service, kind in types.items()]
            item.setToolTip("\n".join([name, "Services:" if lines else "No services", *lines]))

    # life

    def shutdown_plugin(self):
        self._timer.stop()
        self._subscriber.unregister()

    def _stored(self):
        """(key, getter, setter) of each setting, under upstream's keys."""
        yield "graph_type_combo_box_index", self.type_box.currentIndex, lambda v: self.type_box.setCurrentIndex(int(v))
        yield "filter_line_edit_text", self.node_filter.text, self.node_filter.setText
        yield "topic_filter_line_edit_text", self.topic_filter.text, self.topic_filter.setText
        yield "namespace_cluster_spin_box_value", self.namespaces.value, lambda v: self.namespaces.setValue(int(v))
        for box in (*self._boxes.values(), self.highlight_box, self.fit_box, self.auto_box):
            yield box.objectName() + "_state", box.isChecked, lambda v, box=box: box.setChecked(v in (True, "true"))

    def save_settings(self, plugin_settings, instance_settings):
        for key, get, _ in self._stored():
            instance_settings.set_value(key, get())

    def restore_settings(self, plugin_settings, instance_settings):
        for key, get, set_ in self._stored():
            try:
                set_(instance_settings.value(key, get()))
            except (TypeError, ValueError):
                continue  # of another version, or edited by hand


class _ListCompleter(QCompleter):
    """Completes the last word of a comma list, with and without the minus that excludes."""

    def __init__(self, words, edit):
        super().__init__(words, edit)
        self.set_words(words)

    def set_words(self, words):
        self.model().setStringList(sorted(words) + sorted("-" + word for word in words))

    def splitPath(self, path):
        return [path.split(",")[-1].strip()]

    def pathFromIndex(self, index):
        before, comma, _ = self.widget().text().rpartition(",")
        return before + comma + super().pathFromIndex(index)
