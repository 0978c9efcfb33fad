"""Reloading a plugin brings its code along: what was edited since it was imported is imported anew."""

import importlib
import os
import sys

_KEPT = ("qt_gui", "rqt_gui", "rqt_gui_py", "node_signals", "python_qt_binding", "rqt_testing")  # the window itself


class ReloadImporter:
    """Remembers which code runs, and forgets modules whose files have changed.

    :param everything: at each reload forget all modules of workspaces, changed or not, whichever package they are of
    """

    def __init__(self, everything=False):
        self._everything = everything
        self._times = {}  # module name -> time of its file when it was imported, in ns

    def note(self, descriptor):
        """The plugin has been imported."""
        for name, path in self._modules(descriptor):
            self._times.setdefault(name, _time(path))

    def forget(self, descriptor):
        """The plugin is about to be imported again. True when it will be anew."""
        modules = self._modules(descriptor)
        changed = self._everything or any(self._times.get(name, _time(path)) != _time(path) for name, path in modules)
        if changed:
            importlib.invalidate_caches()
            for name, _ in modules:
                sys.modules.pop(name, None)
                self._times.pop(name, None)
        return changed

    def _modules(self, descriptor):
        """(name, file) of the loaded modules of the plugin's top-level package; of all workspaces with ``everything``."""
        top = descriptor.attributes().get("module_name", "").split(".")[0]
        found = []
        for name, module in list(sys.modules.items()):
            path = getattr(module, "__file__", None)
            first = name.split(".")[0]
            if path and path.endswith(".py") and first not in _KEPT and (first == top or self._everything and _is_ours(path)):
                found.append((name, path))
        return found


def _is_ours(path):
    """Whether a file is somebody's workspace's rather than the system's."""
    return not path.startswith((sys.prefix + os.sep, sys.base_prefix + os.sep, "/usr/"))


def _time(path):
    try:
        return os.stat(path).st_mtime_ns
    except OSError:
        return None
