"""Plots to files: a picture, or a table of numbers."""

from __future__ import annotations

from itertools import zip_longest
from typing import TYPE_CHECKING

from python_qt_binding.QtCore import QRectF, Qt
from python_qt_binding.QtGui import QImage, QPainter, QTextOption

if TYPE_CHECKING:
    from rqt_multiplot.panel import PlotPanel

SIZE = 1280, 1024  #: pixels of a picture


def write_image(name: str, panels: list[list[PlotPanel]]) -> None:
    """A picture of the plots of a table, with their titles, into the file ``name``, whose ending says the format.

    :param panels: rows of plots
    :raises OSError: it cannot be written.
    """
    image = QImage(*SIZE, QImage.Format.Format_ARGB32)
    image.fill(Qt.GlobalColor.white)
    painter = QPainter(image)
    height = SIZE[1] / len(panels)
    for row, line in enumerate(panels):
        width = SIZE[0] / len(line)
        for column, panel in enumerate(line):
            cell = QRectF(column * width, row * height, width, height)
            _draw(painter, cell, panel)
    painter.end()
    if not image.save(name):
        raise OSError(f"cannot write {name}: use a name that ends with .png, in a folder that may be written")


def _draw(painter: QPainter, cell: QRectF, panel) -> None:
    title = 24.0
    background, foreground = panel.view._background, panel.view._foreground
    painter.fillRect(cell, background)
    painter.setPen(foreground)
    painter.drawText(QRectF(cell.x(), cell.y(), cell.width(), title), panel.plot.title, QTextOption(Qt.AlignmentFlag.AlignCenter))
    panel.view.render(
        painter,
        QRectF(cell.x(), cell.y() + title, cell.width(), cell.height() - title),
        panel.view.rect(),
        Qt.AspectRatioMode.IgnoreAspectRatio,
    )


def write_text(name: str, panels: list[PlotPanel]) -> None:
    """Two columns per curve of ``panels``, x and y, under a line with their names, into the file ``name``.

    :raises OSError: it cannot be written.
    """
    titles, columns = [], []
    for panel in panels:
        for curve, points in zip(panel.plot.curves, panel.points):
            titles += [curve.axes.x_axis.name, curve.axes.y_axis.name]
            columns += [points.x.tolist(), points.y.tolist()]
    try:
        with open(name, "w", encoding="utf-8") as file:
            file.write(f"# {', '.join(titles)}\n")
            for row in zip_longest(*columns):
                file.write(", ".join("" if value is None else repr(value) for value in row) + "\n")
    except OSError as error:
        raise OSError(f"cannot write {name}: {error.strerror}") from None
