"""Definitions of installed types: their parts, and their text."""

import os

import roslib.message
import rosmsg
import rospkg
from qt_gui.errors import WindowError
from rqt_py_common import rosaction


class DefinitionError(WindowError, ValueError):
    """A type without a definition; one line says why."""


def parts(type_name: str, mode: str) -> list[tuple[str, object]]:
    """(name, empty message) of what ``type_name`` consists of: itself, request and response, or goal, result and feedback.

    :param mode: ``.msg``, ``.srv`` or ``.action``
    :raises DefinitionError: if it cannot be imported
    """
    try:
        if mode == ".msg":
            classes = {"": roslib.message.get_message_class(type_name)}
        elif mode == ".srv":
            found = roslib.message.get_service_class(type_name)
            classes = {"Request": getattr(found, "_request_class", None), "Response": getattr(found, "_response_class", None)}
        else:
            classes = {name: _action_part(type_name, name) for name in ("Goal", "Result", "Feedback")}
        if None not in classes.values():
            return [(name, cls()) for name, cls in classes.items()]
    except (ValueError, ImportError) as error:
        raise DefinitionError(f"{type_name}: {error}") from error
    raise DefinitionError(f"cannot import {type_name}; is its package built and sourced?")


def _action_part(type_name: str, name: str):
    return rosaction.get_action_class(type_name) and roslib.message.get_message_class(type_name + name)


def text(type_name: str, mode: str) -> str:
    """The definition of ``type_name`` as ``rosmsg show`` prints it, or the file of an action.

    :param mode: ``.msg``, ``.srv`` or ``.action``
    :raises DefinitionError: if there is none
    """
    try:
        if mode == ".msg":
            return rosmsg.get_msg_text(type_name)
        if mode == ".srv":
            return rosmsg.get_srv_text(type_name)
        package, name = type_name.split("/")
        with open(os.path.join(rospkg.RosPack().get_path(package), "action", name + ".action"), encoding="utf-8") as file:
            return file.read()
    except (rosmsg.ROSMsgException, rospkg.ResourceNotFound, OSError, ValueError) as error:
        raise DefinitionError(f"{type_name}: {error}") from error
