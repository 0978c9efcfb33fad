"""Messages, requests and goals that a spec writes: whether they fit their types."""

from __future__ import annotations

import io
from typing import Any

from ..errors import LabError


class MisfitError(LabError, ValueError):
    """The values do not fit the type; a sentence that says which do not."""


def filled(message: Any, values: dict[str, Any], what: str) -> Any:
    """``message``, of any ROS type, with the ``values`` of a spec in its fields.

    :param what: the beginning of the sentence: ``the spec's goal does not fit a/TypeGoal``
    :raises MisfitError: a field is not there, or takes other values
    """
    import genpy

    try:
        genpy.message.fill_message_args(message, [values])
        message.serialize(io.BytesIO())
    except (genpy.MessageException, TypeError, ValueError, AttributeError) as error:
        raise MisfitError(f"{what}: {error}") from error
    return message


def misfit(command: dict[str, Any]) -> str:
    """What is wrong with the message or goal of ``command``, an entry of a task's list; '' where it fits, or where its type is not known
    before the submission is built, as that of a call is not.
    """
    ((kind, wanted),) = command.items()
    if kind not in ("publish", "action"):
        return ""
    name = wanted["type"] if kind == "publish" else wanted["type"][: -len("Action")] + "Goal"
    try:
        import roslib.message

        made = roslib.message.get_message_class(name)
    except (ImportError, ValueError):  # no sourced workspace
        return ""
    try:
        if made is not None:
            filled(made(), wanted.get("message" if kind == "publish" else "goal", {}), f"does not fit {name}")
    except MisfitError as error:
        return str(error)
    return ""
