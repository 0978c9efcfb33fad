"""Lists of strings in settings files, which give one element back as a string and none as nothing."""


def pack(data):
    """What to store for a list of strings, or of items with a method ``text()``."""
    texts = [item.text() if hasattr(item, "text") else item for item in data]
    if not texts:
        return ""
    return texts[0] if len(texts) == 1 else texts


def unpack(data):
    """The list that :func:`pack` was given, from what the settings return."""
    if data is None or data == "":
        return []
    return [data] if is_string(data) else data


def is_string(s):
    return isinstance(s, str)
