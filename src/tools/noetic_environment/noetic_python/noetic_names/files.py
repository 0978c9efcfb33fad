"""PyYAML 6 and KDL 1.5."""

from noetic_names import add


def _yaml(module):
    add(module, YAMLLoadWarning=type("YAMLLoadWarning", (RuntimeWarning,), {}))
    if module.load.__defaults__:
        return
    new_load, new_load_all = module.load, module.load_all

    def load(stream, Loader=module.FullLoader):
        """The first document of a stream; as in PyYAML 5, without a Loader by FullLoader."""
        return new_load(stream, Loader)

    def load_all(stream, Loader=module.FullLoader):
        """All documents of a stream; as in PyYAML 5, without a Loader by FullLoader."""
        return new_load_all(stream, Loader)

    module.load, module.load_all = load, load_all


def _pykdl(module):
    """Debian's KDL, 1.5, calls the type of a joint that does not move "Fixed"; Noetic's, 1.4, "None"."""
    new_name = module.Joint.getTypeName

    def getTypeName(self):
        name = new_name(self)
        return "None" if name == "Fixed" else name

    module.Joint.getTypeName = getTypeName


COMPLETE = {"yaml": _yaml, "PyKDL": _pykdl}
