"""Small things about layouts."""

from python_qt_binding.QtCore import Qt


class LayoutUtil:
    """A name space, as others import it."""

    @staticmethod
    def alternate_color(list_widgets, colors_alter=(Qt.GlobalColor.white, Qt.GlobalColor.gray)):
        """Give ``list_widgets``, which stand in a row, the background colours ``colors_alter`` in turn."""
        for index, widget in enumerate(list_widgets):
            widget.setAutoFillBackground(True)
            palette = widget.palette()
            palette.setColor(widget.backgroundRole(), colors_alter[index % len(colors_alter)])
            widget.setPalette(palette)

    @staticmethod
    def clear_layout(layout):
        """Close all widgets of a layout and of those within it, and take them out; spacers go too."""
        for index in reversed(range(layout.count())):
            item = layout.itemAt(index)
            if item.widget() is not None:
                item.widget().close()
            elif item.layout() is not None:
                LayoutUtil.clear_layout(item.layout())
            layout.removeItem(item)
