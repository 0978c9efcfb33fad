"""A view of a MessageTreeModel from which fields can be dragged."""

from python_qt_binding.QtCore import QMimeData, Qt
from python_qt_binding.QtGui import QDrag, QIcon
from python_qt_binding.QtWidgets import QHeaderView, QMenu, QTreeView
from qt_gui.application.compatibility import QAction


class MessageTreeWidget(QTreeView):
    """A drag carries the path of the field as text. Menus: expand and collapse on rows, sizes and sorting on the header."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setDragEnabled(True)
        self.sortByColumn(0, Qt.SortOrder.AscendingOrder)
        header = self.header()
        header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
        header.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        header.customContextMenuRequested.connect(self.handle_header_view_customContextMenuRequested)
        self._action_item_expand = QAction(QIcon.fromTheme("zoom-in"), "Expand Selected", self)
        self._action_item_expand.triggered.connect(lambda checked=False: self._handle_action_set_expanded(True))
        self._action_item_collapse = QAction(QIcon.fromTheme("zoom-out"), "Collapse Selected", self)
        self._action_item_collapse.triggered.connect(lambda checked=False: self._handle_action_set_expanded(False))
        self.customContextMenuRequested.connect(self.handle_customContextMenuRequested)

    def startDrag(self, supportedActions):
        index = self.currentIndex()
        path = getattr(self.model().itemFromIndex(index), "_path", None) if index.isValid() else None
        if path is not None:
            data = QMimeData()
            data.setText(path)
            drag = QDrag(self)
            drag.setMimeData(data)
            drag.exec() if hasattr(drag, "exec") else drag.exec_()

    def handle_customContextMenuRequested(self, pos):
        menu = QMenu(self)
        self._context_menu_add_actions(menu, pos)
        if menu.actions():
            menu.popup(self.mapToGlobal(pos))

    def _context_menu_add_actions(self, menu, pos):
        """Where a derived class adds entries of its own."""
        if self.selectionModel().hasSelection():
            menu.addAction(self._action_item_expand)
            menu.addAction(self._action_item_collapse)

    def _handle_action_set_expanded(self, expanded):
        def apply(index):
            self.setExpanded(index, expanded)
            for row in range(index.model().rowCount(index)):
                apply(index.model().index(row, 0, index))

        for index in self.selectedIndexes():
            if index.column() == 0:
                apply(index)

    def handle_header_view_customContextMenuRequested(self, pos):
        header, modes = self.header(), QHeaderView.ResizeMode
        menu = QMenu(self)
        automatic = menu.addAction("Auto-Resize")
        automatic.setCheckable(True)
        automatic.setChecked(header.sectionResizeMode(0) == modes.ResizeToContents)
        automatic.toggled.connect(lambda on: header.setSectionResizeMode(modes.ResizeToContents if on else modes.Interactive))
        sorting = menu.addAction("Sorting")
        sorting.setCheckable(True)
        sorting.setChecked(self.isSortingEnabled())
        sorting.toggled.connect(self.setSortingEnabled)
        menu.popup(header.mapToGlobal(pos))
