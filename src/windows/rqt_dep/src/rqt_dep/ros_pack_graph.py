"""The window of the graph of packages."""

from python_qt_binding.QtWidgets import QCheckBox, QComboBox, QCompleter, QLineEdit, QVBoxLayout, QWidget
from rqt_graph.background import Latest
from rqt_graph.graph_pane import GraphPane
from rqt_graph.toolbar import Row
from rqt_gui_py.plugin import Plugin

from rqt_dep.packages import BOTH, DEPENDS, DEPENDS_ON, Options, generate_dot, read_packages

_DIRECTIONS = (("depends", DEPENDS), ("depends_on", DEPENDS_ON), ("both", BOTH))
_DEPTHS = (("1 level", 1), ("2 levels", 2), ("3 levels", 3), ("4 levels", 4), ("all levels", 0))


class RosPackGraph(Plugin):
    """Packages on ROS_PACKAGE_PATH, read when the window opens and on Refresh."""

    def __init__(self, context):
        super().__init__(context)
        self.setObjectName("RosPackGraph")
        self._packages = {}
        self._loaded = False
        self._widget = QWidget()
        self._widget.setObjectName("RosPackGraphUi")
        number = context.serial_number()
        self._widget.setWindowTitle("Package Graph" + (f" ({number})" if number > 1 else ""))
        self.pane = GraphPane(self._widget)
        rows, row = QVBoxLayout(self._widget), Row()
        rows.setContentsMargins(3, 3, 3, 3)
        rows.addLayout(row)
        rows.addWidget(self.pane, 1)
        row.button("refresh_graph_push_button", "view-refresh", "Refresh", "Read all packages again", self.refresh)
        self.name_edit = QLineEdit()
        self.name_edit.setObjectName("filter_line_edit")
        self.name_edit.setPlaceholderText("Packages between commas: arm_gazebo, my_.*")
        self.name_edit.setToolTip("Names or regular expressions between commas; a leading - excludes. / is everything")
        self.name_edit.textChanged.connect(lambda text: self.update())
        row.addWidget(self.name_edit, 1)
        self.depth_box = self._combo("depth_combo_box", _DEPTHS, 2, row)
        self.direction_box = self._combo("directions_combo_box", _DIRECTIONS, 0, row)
        self.transitive_box = row.check(
            "transitives_check_box", "No transitive", "Leave out edges that a longer way replaces", True, self.update
        )
        self.system_box = row.check("show_system_check_box", "System", "Also what is no package of ROS", False, self.update)
        self.highlight_box: QCheckBox = row.check(
            "highlight_connections_check_box",
            "Highlight",
            "Highlight connections under the mouse",
            True,
            lambda: self.pane.set_highlight(self.highlight_box.isChecked()),
        )
        row.button("fit_in_view_push_button", "zoom-fit-best", "Fit", "Fit graph in view", self.pane.fit)
        row.file_buttons(self.pane, "rospackgraph", self._load)
        self._reader = Latest(self)
        self._reader.done.connect(self._on_read)
        context.add_widget(self._widget)
        self.refresh()

    def _combo(self, name, entries, index, row):
        box = QComboBox()
        box.setObjectName(name)
        for text, value in entries:
            box.addItem(text, value)
        box.setCurrentIndex(index)
        box.currentIndexChanged.connect(lambda i: self.update())
        row.addWidget(box)
        return box

    def refresh(self):
        """Read all manifests, soon."""
        self._loaded = False
        self._reader.run(read_packages)

    def _on_read(self, packages, error):
        if error is not None:
            self.pane.show_problem(f"the packages cannot be listed: {error}")
            return
        self._packages = packages
        self.name_edit.setCompleter(QCompleter(sorted(packages), self.name_edit))
        self.update()

    def update(self):
        if self._packages and not self._loaded:
            self.pane.show_dot(
                generate_dot(
                    self._packages,
                    Options(
                        self.name_edit.text(),
                        self.direction_box.currentData(),
                        self.depth_box.currentData(),
                        self.transitive_box.isChecked(),
                        self.system_box.isChecked(),
                    ),
                )
            )

    def _load(self):
        self._loaded = self.pane.ask_load_dot()

    def _stored(self):
        yield "filter_line_edit_text", self.name_edit.text, self.name_edit.setText
        for box in (self.depth_box, self.direction_box):
            yield box.objectName() + "_index", box.currentIndex, lambda v, box=box: box.setCurrentIndex(int(v))
        for box in (self.transitive_box, self.system_box, self.highlight_box):
            yield box.objectName() + "_state", box.isChecked, lambda v, box=box: box.setChecked(v in (True, "true"))

    def save_settings(self, plugin_settings, instance_settings):
        for key, get, _ in self._stored():
            instance_settings.set_value(key, get())

    def restore_settings(self, plugin_settings, instance_settings):
        for key, get, set_ in self._stored():
            set_(instance_settings.value(key, get()))
