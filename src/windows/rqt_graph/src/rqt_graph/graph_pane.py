"""A graph in a view: laid out beside the window's thread, loaded, saved, highlighted."""

import os

from python_qt_binding.QtCore import QEvent, QRectF, QSize, Qt, Signal, qWarning
from python_qt_binding.QtGui import QImage, QKeySequence, QPainter
from python_qt_binding.QtWidgets import QFileDialog, QGraphicsScene, QLabel, QVBoxLayout, QWidget
from qt_dotgraph.dot_to_qt import DotToQtGenerator
from qt_dotgraph.layout import LayoutError, layout, render
from qt_gui.application.compatibility import QShortcut

from rqt_graph.background import Latest
from rqt_graph.interactive_graphics_view import InteractiveGraphicsView

_LARGEST = 16000  # pixels of one side of a picture that is saved


class GraphPane(QWidget):
    """``show_dot(text)`` draws. ``nodes`` and ``edges`` are the items drawn, as ``DotToQtGenerator`` returns them."""

    drawn = Signal()
    tool_tip_wanted = Signal(str, object, object)  # name of a node, its item, place on the screen

    def __init__(self, parent=None):
        super().__init__(parent)
        self.view = InteractiveGraphicsView(self)
        self.view.setObjectName("graphics_view")
        self.view.setRenderHint(QPainter.RenderHint.Antialiasing)
        self.problem_label = QLabel(self)
        self.problem_label.setObjectName("problem_label")
        self.problem_label.setWordWrap(True)
        self.problem_label.hide()
        layout_ = QVBoxLayout(self)
        layout_.setContentsMargins(0, 0, 0, 0)
        layout_.addWidget(self.problem_label)
        layout_.addWidget(self.view)
        self._scene = QGraphicsScene(self)
        self._scene.setBackgroundBrush(Qt.GlobalColor.white)
        self.view.setScene(self._scene)
        self.nodes, self.edges = {}, {}
        self.highlight = True
        self.auto_fit = True
        self._dot: str | None = None
        self._layout = None
        self._worker = Latest(self)
        self._worker.done.connect(self._on_laid_out)
        self.view.tool_tip_wanted.connect(self._on_tool_tip)
        self.view.viewport().installEventFilter(self)
        for keys, slot in (("Ctrl+0", self.fit), (QKeySequence.StandardKey.Save, self.ask_save_dot)):
            QShortcut(QKeySequence(keys), self, slot).setContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)

    def sizeHint(self):
        return QSize(800, 480)

    def dot(self):
        """The text that is shown, or None."""
        return self._dot

    def show_dot(self, text):
        """Lay out and draw, soon; what is there already stays as it is."""
        if text != self._dot or not (self.nodes or self._worker.busy()):
            self._dot = text
            self._worker.run(lambda: (text, layout(text)))

    def show_problem(self, text):
        """A line above the graph; an empty one takes it away."""
        self.problem_label.setText(text)
        self.problem_label.setVisible(bool(text))

    def _on_laid_out(self, result, error):
        if error is not None:
            if not isinstance(error, LayoutError):
                raise error
            self.show_problem(str(error))
            return
        self.show_problem("")
        self._layout = result[1]
        self.redraw()

    def redraw(self):
        """Draw again what is laid out."""
        if self._layout is None:
            return
        self._scene.clear()
        self.nodes, self.edges = DotToQtGenerator().layout_to_qt_items(
            self._layout, 3 if self.highlight else 1, same_label_siblings=True, scene=self._scene
        )
        self._scene.setSceneRect(self._scene.itemsBoundingRect())
        if self.auto_fit:
            self.fit()
        self.drawn.emit()

    def set_highlight(self, on):
        self.highlight = bool(on)
        self.redraw()

    def set_auto_fit(self, on):
        self.auto_fit = bool(on)
        if on:
            self.fit()

    def fit(self):
        """The whole graph, at most at twice its size."""
        self.view.fitInView(self._scene.itemsBoundingRect(), Qt.AspectRatioMode.KeepAspectRatio)
        if self.view.transform().m11() > 2:
            self.view.resetTransform()
            self.view.scale(2, 2)

    def eventFilter(self, watched, event):
        """The graph is fitted again when ``watched``, the view, changes its size; no ``event`` is kept from it."""
        if event.type() == QEvent.Type.Resize and self.auto_fit and self.nodes:
            self.fit()
        return False

    def _on_tool_tip(self, item, place):
        name = next((name for name, node in self.nodes.items() if node is item), None)
        if name is not None:
            self.tool_tip_wanted.emit(name, item, place)

    # files

    def load_dot(self, path):
        """Show a file. What cannot be read is told above the graph."""
        try:
            with open(path, encoding="utf-8") as file:
                self.show_dot(file.read())
        except (OSError, UnicodeDecodeError) as error:
            self._complain(f"cannot read {path}: {getattr(error, 'strerror', None) or 'it is not text'}")

    def save(self, path):
        """Write the graph: ``.dot`` text, ``.svg`` and ``.pdf`` by Graphviz, anything else as a picture of what is drawn."""
        form = os.path.splitext(path)[1].lower()
        try:
            if form in (".dot", ".gv", ".svg", ".pdf"):
                dot = self._dot or ""  # nothing is drawn yet
                data = dot.encode() if form in (".dot", ".gv") else render(dot, form[1:])
                with open(path, "wb") as file:
                    file.write(data)
            elif not self._image().save(path):
                self._complain(f"cannot write {path}: the place cannot be written, or its ending is none of a picture")
        except OSError as error:
            self._complain(f"cannot write {path}: {error.strerror}")
        except LayoutError as error:
            self._complain(str(error))

    def _image(self):
        rect = self._scene.itemsBoundingRect().adjusted(-8, -8, 8, 8)
        scale = min(2.0, _LARGEST / max(rect.width(), rect.height(), 1))
        image = QImage(max(1, int(rect.width() * scale)), max(1, int(rect.height() * scale)), QImage.Format.Format_RGB32)
        image.fill(Qt.GlobalColor.white)
        painter = QPainter(image)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        self._scene.render(painter, QRectF(image.rect()), rect)
        painter.end()
        return image

    def _complain(self, text):
        qWarning(text)
        self.show_problem(text)

    def ask_load_dot(self):
        path, _ = QFileDialog.getOpenFileName(self, "Open graph from file", "", "DOT graph (*.dot *.gv);;All files (*)")
        if path:
            self.load_dot(path)
        return bool(path)

    def ask_save_dot(self, name="graph.dot"):
        self._ask_save("Save as DOT graph", name, "DOT graph (*.dot)")

    def ask_save_svg(self, name="graph.svg"):
        self._ask_save("Save as SVG", name, "Scalable Vector Graphic (*.svg)")

    def ask_save_image(self, name="graph.png"):
        self._ask_save("Save as image", name, "Image (*.bmp *.jpg *.png *.tiff)")

    def _ask_save(self, title, name, kinds):
        if self._dot is None:
            return
        path, _ = QFileDialog.getSaveFileName(self, title, name, kinds)
        if path:
            self.save(path if os.path.splitext(path)[1] else path + os.path.splitext(name)[1])
