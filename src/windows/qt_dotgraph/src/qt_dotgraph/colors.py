"""A colour for each word, the same every time."""

import zlib

from python_qt_binding.QtGui import QColor


def get_color_for_string(s):
    """A dark ``QColor`` that depends on the text alone."""
    return QColor.fromHsv(zlib.crc32(s.encode()) % 360, 200, 180)
