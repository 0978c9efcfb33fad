"""What rosmsg does for messages, for actions: which there are, and their classes."""

import importlib
import os

import rospkg
from genmsg import package_resource_name, resource_name
from qt_gui.errors import WindowError

MODE_ACTION = ".action"


class ROSActionException(WindowError):
    """A mode that is none, or an action that is none."""


def get_action_class(action_type, reload_on_error=False):
    """The class of the goal-result-feedback message of ``action_type``, ``pkg/Name`` or ``pkg/NameAction``; None when its package
    is not built.

    :param reload_on_error: without effect; ``roslib.message`` has such an argument
    """
    package, name = package_resource_name(action_type)
    try:
        module = importlib.import_module(f"{package}.msg")
    except (ImportError, ValueError):
        return None
    return getattr(module, name, None) if name.endswith("Action") else getattr(module, name + "Action", None)


def iterate_packages(rospack, mode=MODE_ACTION):
    """(package, folder) of each package of ``rospack``, a ``rospkg.RosPack``, with actions.

    :param mode: MODE_ACTION; nothing else is taken
    """
    _check(mode)
    for package in rospack.list():
        folder = os.path.join(rospack.get_path(package), "action")
        if os.path.isdir(folder):
            yield package, folder


def list_types(package, mode=MODE_ACTION):
    """``package/Name`` of all actions in ``package``, sorted.

    :param mode: MODE_ACTION; nothing else is taken
    :raises rospkg.ResourceNotFound: no such package.
    """
    _check(mode)
    folder = os.path.join(rospkg.RosPack().get_path(package), "action")
    names = sorted(os.listdir(folder)) if os.path.isdir(folder) else []
    return [resource_name(package, name[: -len(mode)]) for name in names if name.endswith(mode)]


def list_actions(package):
    """See :func:`list_types`."""
    return list_types(package)


def _check(mode):
    if mode != MODE_ACTION:
        raise ValueError(f"Unknown mode for list_types: {mode}")
