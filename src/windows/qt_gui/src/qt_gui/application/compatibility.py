"""Plugins written for other versions of Python and Qt run as they are: patched here, once, when the container starts.

Noetic's Python 3.8 took a float where Qt wants an int, and cut it off. Python 3.10 and later refuse
(``setValue(self, int): argument 1 has unexpected type 'float'``), and every second plugin computes its sizes.
"""

import functools

from python_qt_binding import QtCore, QtGui, QtWidgets

QAction = getattr(QtGui, "QAction", None) or QtWidgets.QAction  # moved in Qt 6
QShortcut = getattr(QtGui, "QShortcut", None) or QtWidgets.QShortcut

# Methods that are not virtual: Qt itself must not call back into the patched ones.
_METHODS = {
    "QAbstractSlider": "setValue setRange setMinimum setMaximum setSingleStep setPageStep setSliderPosition",
    "QSlider": "setTickInterval",
    "QDial": "setNotchTarget",
    "QProgressBar": "setValue setRange setMinimum setMaximum",
    "QProgressDialog": "setValue setRange setMinimum setMaximum setMinimumDuration",
    "QSpinBox": "setValue setRange setMinimum setMaximum setSingleStep",
    "QDoubleSpinBox": "setDecimals",
    "QLCDNumber": "setDigitCount",
    "QWidget": "resize move setGeometry setFixedSize setFixedWidth setFixedHeight setMinimumSize setMinimumWidth "
    "setMinimumHeight setMaximumSize setMaximumWidth setMaximumHeight setBaseSize setContentsMargins update repaint "
    "scroll",
    "QLayout": "setContentsMargins setSpacing",
    "QBoxLayout": "addSpacing addStretch addStrut insertSpacing insertStretch setSpacing setStretch",
    "QGridLayout": "setSpacing setHorizontalSpacing setVerticalSpacing setRowStretch setColumnStretch setRowMinimumHeight "
    "setColumnMinimumWidth",
    "QFormLayout": "setSpacing setHorizontalSpacing setVerticalSpacing",
    "QSplitter": "setSizes setHandleWidth setStretchFactor moveSplitter",
    "QHeaderView": "resizeSection setDefaultSectionSize setMinimumSectionSize setMaximumSectionSize",
    "QTableView": "setColumnWidth setRowHeight",
    "QTreeView": "setColumnWidth setIndentation",
    "QTableWidget": "setRowCount setColumnCount insertRow insertColumn removeRow selectRow selectColumn",
    "QListWidget": "setCurrentRow",
    "QComboBox": "setCurrentIndex setMaxVisibleItems setMinimumContentsLength setMaxCount",
    "QTabWidget": "setCurrentIndex",
    "QStackedWidget": "setCurrentIndex",
    "QLabel": "setMargin setIndent",
    "QFrame": "setLineWidth setMidLineWidth",
    "QLineEdit": "setMaxLength setCursorPosition",
    "QTextEdit": "setFontWeight setTabStopWidth setLineWrapColumnOrWidth",
    "QPlainTextEdit": "setMaximumBlockCount",
    "QGraphicsView": "setSceneRect centerOn ensureVisible",
    "QTimer": "start setInterval singleShot",
    "QThread": "sleep msleep usleep",
    "QFont": "setPointSize setPixelSize setWeight setStretch",
    "QPen": "setWidth",
    "QColor": "setRgb setRed setGreen setBlue setAlpha setHsv setHsl lighter darker fromRgb fromHsv fromHsl",
    "QPoint": "setX setY",
    "QSize": "setWidth setHeight scaled",
    "QRect": "setX setY setWidth setHeight setLeft setRight setTop setBottom setRect setCoords adjust adjusted translate "
    "translated moveTo moveLeft moveRight moveTop moveBottom contains",
    "QImage": "scaled scaledToWidth scaledToHeight copy pixel setPixel pixelColor setPixelColor",
    "QPixmap": "scaled scaledToWidth scaledToHeight copy",
    "QIcon": "pixmap",
    "QPainter": "drawLine drawRect drawRoundedRect drawEllipse drawArc drawPie drawChord drawPoint drawText drawPixmap drawImage "
    "drawTiledPixmap fillRect eraseRect setViewport setWindow setClipRect",
    "QCursor": "setPos",
    "QStandardItemModel": "setRowCount setColumnCount",
    "QTextCursor": "setPosition",
}
_CONSTRUCTORS = (
    "QPoint",
    "QSize",
    "QRect",
    "QMargins",
    "QColor",
    "QImage",
    "QPixmap",
    "QFont",
    "QTableWidget",
    "QSpacerItem",
    "QStandardItemModel",
)
_state = {"installed": False}


def _cut(argument):
    if isinstance(argument, float):
        return int(argument)
    if isinstance(argument, list):
        return [_cut(item) for item in argument]
    return argument


def _has_float(argument) -> bool:
    return isinstance(argument, float) or isinstance(argument, list) and any(isinstance(item, float) for item in argument)


def _call_cut(function, arguments, options):
    """Call ``function`` with floats made whole numbers; None, False when there are none or it refuses these too."""
    if any(_has_float(value) for value in (*arguments, *options.values())):
        try:
            return function(*map(_cut, arguments), **{name: _cut(value) for name, value in options.items()}), True
        except (TypeError, ValueError, OverflowError):
            pass  # it was not the floats, or they are NaN
    return None, False


def _lenient(function):
    """``function``, tried again with whole numbers when it refuses floats."""

    @functools.wraps(function)
    def call(*arguments, **options):
        try:
            return function(*arguments, **options)
        except TypeError:
            result, done = _call_cut(function, arguments, options)
            if not done:
                raise
            return result

    return call


class _LenientMethod:
    """Stands in for a method of a Qt class. Binding the original each time keeps Qt's own choice of the overload: called
    through the class with an instance, it would run the base class's version."""

    def __init__(self, original):
        self._original = original
        self.__doc__ = original.__doc__

    def __get__(self, instance, owner=None):
        return _lenient(self._original.__get__(instance, owner))


def accept_floats():
    """Let the int setters of Qt take floats from here on, as they did for Noetic's plugins."""
    if _state["installed"]:
        return
    _state["installed"] = True
    for class_name, methods in _METHODS.items():
        cls = _find(class_name)
        for name in methods.split() if cls is not None else ():
            original = cls.__dict__.get(name)
            if original is None and hasattr(cls, name):
                getattr(cls, name)  # sip fills the class's dictionary when first asked
                original = cls.__dict__.get(name)
            if original is not None and hasattr(type(original), "__get__"):
                setattr(cls, name, _LenientMethod(original))
    for class_name in _CONSTRUCTORS:
        cls = _find(class_name)
        if cls is not None:
            cls.__init__ = _lenient(cls.__init__)


def _find(class_name):
    return next((getattr(module, class_name) for module in (QtCore, QtGui, QtWidgets) if hasattr(module, class_name)), None)
