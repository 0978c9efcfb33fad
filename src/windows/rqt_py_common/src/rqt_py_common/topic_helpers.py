"""The Python types of message fields, from the message definitions alone: nothing need be published."""

import genpy
import roslib.message
from genmsg.msgs import is_valid_constant_type, parse_type
from rostopic import ROSTopicException, get_topic_type

_PRIMITIVE = {"string": str, "bool": bool, "float32": float, "float64": float}


def get_type_class(type_name):
    """The Python class of a message type or primitive type (``float64`` -> float); None when it cannot be imported.
    ``time`` and ``duration`` are genpy's."""
    if type_name in ("time", "duration"):
        return genpy.Time if type_name == "time" else genpy.Duration
    if is_valid_constant_type(type_name):
        return _PRIMITIVE.get(type_name, int)
    if type_name == "Header":
        type_name = "std_msgs/Header"
    try:
        return roslib.message.get_message_class(type_name)
    except ValueError:
        return None


def get_field_type(topic_name):
    """(type, whether it is an array) of the field of a topic that the master knows, say ``/odom/pose/pose/position/x``.

    :return: ``(None, False)`` when there is no such topic, field, or message definition
    """
    try:
        topic_type, real_name, _ = get_topic_type(topic_name)
    except ROSTopicException:
        return None, False
    message_class = get_type_class(topic_type) if topic_type else None
    if message_class is None:
        return None, False
    return get_slot_type(message_class, topic_name[len(real_name) :])


def get_slot_type(message_class, slot_path):
    """(type, whether it is an array) of a field within ``message_class``.

    :param slot_path: ``header/seq``, ``position[0]``; an index takes one element of an array
    :return: ``(None, False)`` when there is no such field
    """
    is_array = False
    for name in (part for part in slot_path.split("/") if part):
        try:
            name, _, index = parse_type(name)
        except Exception:  # genmsg has no class for brackets that do not close
            return None, False
        if name not in getattr(message_class, "__slots__", ()) or not hasattr(message_class, "_slot_types"):
            return None, False
        slot_type, slot_is_array, _ = parse_type(message_class._slot_types[message_class.__slots__.index(name)])
        is_array = slot_is_array and index is None
        message_class = get_type_class(slot_type)
    return message_class, is_array


def is_slot_numeric(topic_name):
    """(whether the field of a topic is a number or an array of them, whether it is an array, a sentence saying so)."""
    field_type, is_array = get_field_type(topic_name)
    if field_type in (int, float):
        kind = f"numeric array: {field_type}[]" if is_array else f"numeric: {field_type}"
        return True, is_array, f'topic "{topic_name}" is {kind}'
    return False, is_array, f'topic "{topic_name}" is NOT numeric: {field_type}'


def find_slots_by_type_dfs(msg_class, slot_type):
    """Paths of all fields of ``slot_type`` (name such as ``float64``, or class) within ``msg_class``, field by field in depth.

    Arrays are marked: ``poses[]/position``.
    """
    if msg_class == slot_type:
        return [""]
    paths = []
    for name, inner, class_or_none in _slots(msg_class):
        if inner == slot_type:
            paths.append(name)
        elif class_or_none is not None:
            paths += ["/".join(part for part in (name, path) if part) for path in find_slots_by_type_dfs(class_or_none, slot_type)]
    return paths


def find_slots_by_type_bfs(msg_class, slot_type):
    """As :func:`find_slots_by_type_dfs` for ``msg_class`` and ``slot_type``, those nearest to the message first."""
    paths, queue = [], [(msg_class, "")]
    while queue:
        current, path = queue.pop(0)
        if current == slot_type:
            paths.append(path)
            continue
        for name, inner, class_or_none in _slots(current):
            here = f"{path}/{name}" if path else name
            if inner == slot_type:
                paths.append(here)
            elif class_or_none is not None:
                queue.append((class_or_none, here))
    return paths


def _slots(msg_class):
    """(name with [] for arrays, type name, message class or None) of each field; types that cannot be imported are left out."""
    for name, type_name in zip(getattr(msg_class, "__slots__", ()), getattr(msg_class, "_slot_types", ())):
        inner, is_array, _ = parse_type(type_name)
        name += "[]" if is_array else ""
        if is_valid_constant_type(inner) or inner in ("time", "duration"):
            yield name, inner, None
        else:
            cls = get_type_class(inner)
            if cls is not None:
                yield name, inner, cls
