"""Qt's modules under one name::

    from python_qt_binding import QT_BINDING, loadUi
    from python_qt_binding.QtWidgets import QWidget

``QT_BINDING`` is ``pyqt`` or ``pyside``, ``QT_BINDING_VERSION`` its version, ``QT_BINDING_MODULES`` the modules by name. PyQt
is preferred; set ``sys.SELECT_QT_BINDING`` or ``sys.SELECT_QT_BINDING_ORDER`` before the first import to choose otherwise. Of the
same binding's versions Qt 5's comes first, which is what plugins are written for; the environment variable ``QT_API=pyqt6``
(``pyside6``) asks for Qt 6's, as it does of matplotlib.
"""

import sys

from python_qt_binding.binding_helper import QT_BINDING, QT_BINDING_MODULES, QT_BINDING_VERSION, loadUi

__all__ = ["QT_BINDING", "QT_BINDING_MODULES", "QT_BINDING_VERSION", "loadUi", *QT_BINDING_MODULES]

for _name, _module in QT_BINDING_MODULES.items():
    sys.modules[f"{__name__}.{_name}"] = globals()[_name] = _module
