"""Values of a server's parameters in YAML files, as dynparam and rqt_reconfigure have always written them."""

import yaml
from qt_gui.errors import WindowError

from .dynamic import Config

_TAG = "tag:yaml.org,2002:python/object/new:dynamic_reconfigure.encoding.Config"


class SavedValuesError(WindowError, ValueError):
    """A file without values; one line says why."""


class _Loader(yaml.SafeLoader):
    """Knows one object more than plain YAML: Config, which is a dictionary."""


def _config(loader, node):
    content = loader.construct_mapping(node, deep=True)
    items = content.get("dictitems", content.get("state", {}))
    return items if isinstance(items, dict) else {}


_Loader.add_constructor(_TAG, _config)


def save(path: str, config: dict) -> None:
    """Write ``config``, name -> value, into the file ``path``.

    :raises OSError: if it cannot be written
    """
    with open(path, "w", encoding="utf-8") as file:
        yaml.dump(Config(config), file)


def load(path: str) -> dict:
    """Names to values; groups are left out.

    :raises SavedValuesError: if the file cannot be read, or holds something else
    """
    try:
        with open(path, encoding="utf-8") as file:
            values = yaml.load(file, _Loader)
    except OSError as error:
        raise SavedValuesError(f"{path}: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as error:
        raise SavedValuesError(f"{path} is no YAML file of parameters: {' '.join(str(error).split())[:150]}") from error
    if not isinstance(values, dict):
        raise SavedValuesError(f"{path} is no YAML file of parameters: it holds no names with values")
    return {
        str(name): value for name, value in values.items() if name not in ("groups", "state") and isinstance(value, (bool, int, float, str))
    }
