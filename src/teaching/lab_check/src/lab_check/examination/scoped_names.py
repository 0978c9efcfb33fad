"""Names of the simulated world: ``model``, ``model::link``, ``model::link::visual``."""


def belongs(name: str, to: str) -> bool:
    """``name`` is ``to``, or a part of it. :param to: "": the world, to which everything belongs"""
    return not to or name == to or name.startswith(f"{to}::")
