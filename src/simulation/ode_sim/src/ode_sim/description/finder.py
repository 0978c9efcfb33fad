"""Finds the files that worlds and robots name, in Gazebo Classic's search order. Never uses the network."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from urllib.parse import quote, unquote

from ode_sim.description.model import DescriptionError, quoted
from ode_sim.description.xmlsource import parse_xml, read_bytes, text_of

STOCK_VARIABLE = "ODE_SIM_STOCK_PATH"
_NEWEST_SDF = (1, 7)
#: Where the editors of Gazebo's window save; it puts these folders on its model path.
_EDITORS = ("~/model_editor_models", "~/building_editor_models")


def _entries(variable: str) -> list[str]:
    return [entry for entry in os.environ.get(variable, "").split(":") if entry]


def find_ros_package(name: str) -> str | None:
    """Directory of a ROS package below ROS_PACKAGE_PATH, by its folder name; None if there is none."""
    for root in _entries("ROS_PACKAGE_PATH"):
        for folder, folders, files in os.walk(root):
            if "package.xml" in files:
                if os.path.basename(folder) == name:
                    return folder
                folders.clear()
            folders[:] = [f for f in folders if not f.startswith(".")]
    return None


def _installed() -> list[str]:
    """Where projects without ROS put their models and worlds, beside GAZEBO_MODEL_PATH of find_package(gazebo)."""
    folders = [os.path.join(prefix, "share/gazebo-11") for prefix in _entries("CMAKE_PREFIX_PATH")]
    return [folder for folder in folders if os.path.isdir(folder)]


def _leads_up(name: str) -> bool:
    return os.path.normpath(name.lstrip("/")).split("/")[0] == ".."


def _below(folder: str, name: str) -> list[str]:
    """``name`` in ``folder``; nothing if it lies elsewhere. Links are followed: a catkin workspace is full of them."""
    return [] if _leads_up(name) else [os.path.join(folder, os.path.normpath(name.lstrip("/")))]


class ResourceFinder:
    """Resolves ``model://``, ``file://``, ``package://`` and relative names to absolute paths.

    :param model_paths: directories of models behind those of the environment (``gazebo_model_path`` exports).
    :param resource_paths: the same for worlds and media (``gazebo_media_path`` exports).
    :param package_path: ``f(package name) -> directory or None``; by default a search below ROS_PACKAGE_PATH.
    :param stock: directory with the simulator's own ``models``, ``worlds`` and ``media``, searched last so that a
        course's own model of the same name wins; by default $ODE_SIM_STOCK_PATH, else the package ``gazebo_stock``.
    :param environment: read GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH, ~/.gazebo/models, what was installed for Gazebo 11 into a
        prefix, and what the window's editors saved.
    """

    def __init__(
        self,
        model_paths: Iterable[str] | None = None,
        resource_paths: Iterable[str] | None = None,
        package_path: Callable[[str], str | None] | None = None,
        stock: str | None = None,
        environment: bool = True,
    ):
        self._package_path = package_path or find_ros_package
        if stock is None:
            stock = os.environ.get(STOCK_VARIABLE) or self._package_path("gazebo_stock") or ""
        self.stock = str(stock)
        models = [os.path.expanduser("~/.gazebo/models")] + _entries("GAZEBO_MODEL_PATH") if environment else []
        resources = _entries("GAZEBO_RESOURCE_PATH") if environment else []
        models += [str(path) for path in model_paths or ()]
        resources += [str(path) for path in resource_paths or ()]
        if environment:
            installed = _installed()
            models += [os.path.join(folder, "models") for folder in installed] + [os.path.expanduser(path) for path in _EDITORS]
            resources += installed
        if self.stock:
            models.append(os.path.join(self.stock, "models"))
            resources.append(self.stock)
        self.model_paths: list[str] = list(dict.fromkeys(models))
        self.resource_paths: list[str] = list(dict.fromkeys(resources))

    # ------------------------------------------------------------------ names to files

    def find(self, uri: str, base: str = "") -> str | None:
        """Absolute path of the existing file or directory ``uri``, or None.

        A URI never leads out of the folder that it names (``model://cup/../../secret`` is not found): what is loaded may
        come from a stranger. A plain path may lead anywhere.

        :param base: directory of the file that says so; a relative name is tried there first.
        """
        uri = uri.strip()
        scheme, _, rest = uri.partition("://")
        if not rest:
            return self._first(self._relative(uri, base))
        rest = unquote(rest)
        if scheme == "model":
            return self._in_models(rest)
        if scheme in ("http", "https"):  # of the model databases only what is here under the same name
            name = rest.rstrip("/").rpartition("/")[2]
            return self._in_models(name) or self._in_models(name.lower().replace(" ", "_"))
        if scheme == "package":
            package, _, inside = rest.partition("/")
            folder = self._package_path(package) if package not in ("", ".", "..") else None
            found = self._first(_below(folder, inside)) if folder else None
            # URDF meshes that name a package of models: Gazebo turns package:// into model://
            return found or self._in_models(rest)
        if scheme == "file":
            if os.path.isabs(rest):
                return self._first([rest]) or self._in_models(rest)
            return self._first(path for path in self._relative(rest, base) if not _leads_up(rest))
        return None

    def explain(self, uri: str) -> str:
        """Where :meth:`find` looked for ``uri``, for a message."""
        scheme, _, rest = uri.strip().partition("://")
        if scheme == "package" and rest:
            package = rest.partition("/")[0]
            folder = self._package_path(package)
            return f"searched {folder}" if folder else f"there is no ROS package '{quoted(package)}'"
        if scheme in ("http", "https", "model") and rest:
            return (
                ("" if scheme == "model" else "the network is never used; ")
                + "searched "
                + (":".join(self.model_paths) or "nothing, GAZEBO_MODEL_PATH is empty")
                + self._package_for_model(scheme, rest)
            )
        if os.path.isabs(rest or uri):
            elsewhere = self._package_uri(unquote(rest) if rest else uri)
            return "no such file" + (f"; {elsewhere} is one, on any machine that has the package" if elsewhere else "")
        return "searched " + ":".join([os.getcwd()] + self.resource_paths)

    def _package_uri(self, path: str) -> str:
        """A ``package://`` for the end of an absolute path of another machine, if a package here has that file; else ''."""
        parts = path.strip("/").split("/")
        for at, package in enumerate(parts[:-1]):
            inside = "/".join(parts[at + 1 :])
            folder = self._package_path(package) if package not in ("", ".", "..") else None
            if folder and self._first(_below(folder, inside)):
                return f"package://{package}/{quote(inside)}"
        return ""

    def _package_for_model(self, scheme: str, rest: str) -> str:
        package, _, inside = unquote(rest).partition("/")
        folder = self._package_path(package) if scheme == "model" and inside and package not in ("", ".", "..") else None
        if not folder or not self._first(_below(folder, inside)):
            return ""
        return (
            f"; the ROS package '{quoted(package)}' has it: name its parent in GAZEBO_MODEL_PATH, "
            f"export GAZEBO_MODEL_PATH=$GAZEBO_MODEL_PATH:{os.path.dirname(folder)}"
        )

    def find_world(self, name: str) -> str | None:
        """A world file by path, URI, or name relative to the resource paths (``worlds/empty.world``)."""
        found = self.find(name)
        return found if found and os.path.isfile(found) else None

    def _in_models(self, name: str) -> str | None:
        return self._first(candidate for path in self.model_paths for candidate in _below(path, name)) if name else None

    def _relative(self, name: str, base: str) -> Iterator[str]:
        """Where a plain name may be meant to be."""
        if os.path.isabs(name):
            yield name
            for path in self.model_paths:
                yield from _below(path, name)
            return
        if base:
            yield os.path.join(base, name)
        yield os.path.join(os.getcwd(), name)
        for path in self.resource_paths:
            for folder in ("", "models", "media/models", "Media/models"):
                yield from _below(os.path.join(path, folder), name)

    @staticmethod
    def _first(candidates: Iterable[str]) -> str | None:
        for candidate in candidates:
            if os.path.exists(candidate):
                return os.path.abspath(candidate)
        return None

    # ------------------------------------------------------------------ models

    def find_model_sdf(self, uri: str, base: str = "") -> str | None:
        """The SDF file of a model directory, chosen by its model.config, or of a ``uri`` that names a file; ``base`` as for :meth:`find`.

        :raises DescriptionError: the directory is there, but its model.config or SDF file is not usable.
        """
        found = self.find(uri, base)
        if found is None or os.path.isfile(found):
            return found
        for name in ("model.config", "manifest.xml"):
            if os.path.isfile(os.path.join(found, name)):
                return self._sdf_of_config(os.path.join(found, name))
        if os.path.isfile(os.path.join(found, "model.sdf")):
            return os.path.join(found, "model.sdf")
        raise DescriptionError(f"{found}: no model.config, so '{quoted(uri)}' is not a model directory")

    @staticmethod
    def _sdf_of_config(config: str) -> str:
        root = parse_xml(read_bytes(config), config)
        entries: list[tuple[tuple[int, ...], str]] = []
        for entry in root.iter("sdf"):
            try:
                version = tuple(int(part) for part in (entry.get("version") or "1.0").split("."))
            except ValueError:
                continue
            entries.append((version, text_of(entry)))
        if not entries:
            raise DescriptionError(f"{config}: has no <sdf version='1.6'>model.sdf</sdf> entry")
        supported = [entry for entry in entries if entry[0] <= _NEWEST_SDF]
        best = max(supported)[1] if supported else min(entries)[1]  # a newer one is read as far as it is known
        file = os.path.join(os.path.dirname(config), best)
        if os.path.isabs(best) or _leads_up(best) or not os.path.isfile(file):
            raise DescriptionError(f"{config}: names '{quoted(best)}', which is not there")
        return file

    def models(self) -> dict[str, str]:
        """Models of the model path: name of the folder -> its SDF file. Of two of a name the first one counts."""
        found: dict[str, str] = {}
        for path in self.model_paths:
            for config in sorted(Path(path).glob("*/model.config")):
                if config.parent.name not in found:
                    try:
                        found[config.parent.name] = self._sdf_of_config(str(config))
                    except DescriptionError:
                        continue  # whoever asks for it by name is told
        return found

    def stock_models(self) -> list[str]:
        """Names of the models that come with the simulator."""
        folder = Path(self.stock) / "models"
        return sorted(f.parent.name for f in folder.glob("*/model.config")) if self.stock else []

    def stock_worlds(self) -> list[str]:
        """Names of the worlds that come with the simulator, such as ``worlds/empty.world``."""
        folder = Path(self.stock) / "worlds"
        return sorted(f"worlds/{f.name}" for f in folder.glob("*.world")) if self.stock else []
