"""Where a robot's description comes from, and the robot that it describes."""

from __future__ import annotations

import shlex
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import lenient_xml
import motion
import rospkg
from motion.files import resolve

from moveit_setup_assistant.errors import AssistantError, files_told


@dataclass
class RobotSource:
    """A URDF or xacro file: ``relative_path`` below ``package``, or an absolute path if it lies in no package."""

    package: str = ""
    relative_path: str = ""
    xacro_args: str = ""

    @classmethod
    @files_told()
    def from_file(cls, path, xacro_args: str = "") -> RobotSource:
        """The source that names ``path`` by the package around it, so that it is found on other machines too.

        :param xacro_args: ``name:=value name:=value``
        :raises AssistantError: there is no such file.
        """
        path = Path(path).expanduser().resolve()
        if not path.is_file():
            raise AssistantError(f"robot description '{path}': there is no such file")
        for folder in path.parents:
            manifest = folder / "package.xml"
            if manifest.is_file():
                return cls(_package_name(manifest), str(path.relative_to(folder)), xacro_args)
        return cls("", str(path), xacro_args)

    @files_told()
    def file(self) -> Path:
        """The file's absolute path.

        :raises AssistantError: the package is not found (source the workspace that holds it), or lacks the file.
        """
        if not self.package:
            path = Path(self.relative_path)
            where = ""
        else:
            try:
                path = Path(rospkg.RosPack().get_path(self.package)) / self.relative_path
            except rospkg.ResourceNotFound as error:
                raise AssistantError(
                    f"the robot description is in package '{self.package}', which is not found; source the "
                    f"setup.bash of the workspace that holds it"
                ) from error
            where = f" of package '{self.package}'"
        if not path.is_file():
            raise AssistantError(f"robot description '{self.relative_path}'{where}: there is no such file")
        return path

    @property
    def is_xacro(self) -> bool:
        """Whether the file goes through xacro: by its name, or because it says so inside."""
        path = Path(self.relative_path)
        if path.suffix == ".xacro" or self.xacro_args:
            return True
        try:
            return "xmlns:xacro" in self.file().read_text(encoding="utf-8", errors="replace")
        except (OSError, AssistantError):
            return False

    @files_told()
    def load(self, progress: Callable[[str], None] | None = None) -> Robot:
        """Read, expand and parse the description.

        :raises AssistantError: the file, an argument or the XML cannot be used.
        """
        path = self.file()
        if progress:
            progress(f"reading {path}")
        text = expanded(path, self.xacro_args) if self.is_xacro else path.read_text(encoding="utf-8", errors="replace")
        return Robot.from_text(text, str(path))


def _package_name(manifest: Path) -> str:
    try:
        return (ET.parse(manifest).getroot().findtext("name") or "").strip() or manifest.parent.name
    except ET.ParseError:
        return manifest.parent.name


def expanded(path: Path, arguments: str) -> str:
    """What xacro makes of the file ``path``.

    :param arguments: ``name:=value name:=value``
    :raises AssistantError: an argument or the file cannot be used.
    """
    import xacro  # late: a plain URDF does without

    mappings: dict[str, str] = {}
    for word in shlex.split(arguments):
        if word in ("--inorder", "-i"):
            continue
        name, separator, value = word.partition(":=")
        if not separator:
            raise AssistantError(f"xacro argument '{word}' has no ':='; write name:=value")
        mappings[name] = value
    try:
        return xacro.process_file(str(path), mappings=mappings).toxml()
    except SystemExit as error:
        raise AssistantError(f"xacro cannot expand '{path}'; run  xacro {path} {arguments}  to see why") from error
    except Exception as error:  # xacro raises many kinds; all of them say what is wrong in their text
        raise AssistantError(f"xacro cannot expand '{path}': {_reason(error)}") from error


def _reason(error: Exception) -> str:
    """What an exception of xacro says, in one line; it may hold another one, whose text it often says twice."""
    text, inner = str(error), str(getattr(error, "exc", None) or "")
    if inner and text.count(inner) > 1:
        text = inner
    return " ".join(text.split())[:300]


def _xml_fault(text: str) -> str:
    """Where the XML ends to be XML, which urdf's parser does not say; '' if it is some."""
    try:
        lenient_xml.fromstring(text)
    except ET.ParseError as error:
        return f"its XML cannot be read: {error}"
    return ""


def _missing_visuals(urdf: str) -> list[str]:
    """One line for each mesh that cannot be drawn because there is no such file; the motion library looks at collisions alone."""
    lines: dict[str, str] = {}
    for link in lenient_xml.fromstring(urdf).findall("link"):
        for mesh in link.findall("visual/geometry/mesh"):
            uri = mesh.get("filename") or ""
            if not resolve(uri):
                lines.setdefault(uri, f"link '{link.get('name')}': a <visual> is not drawn: mesh '{uri}' is not found")
    return list(lines.values())


@dataclass
class Robot:
    """A parsed description. ``warnings``: what was left out, one line each (missing meshes, for one)."""

    name: str
    urdf: str
    model: motion.RobotModel
    warnings: list[str] = field(default_factory=list)

    @classmethod
    def from_text(cls, urdf: str, origin: str) -> Robot:
        """The robot that the text ``urdf`` describes.

        :raises AssistantError: the text is no robot; ``origin`` names it in the message.
        """
        try:
            model = motion.load_model(urdf)
        except motion.MotionError as error:
            raise AssistantError(f"'{origin}' is no robot description: {_xml_fault(urdf) or error}") from error
        return cls(model.name, urdf, model, [*model.warnings, *_missing_visuals(urdf)])

    def with_srdf(self, srdf: str) -> motion.RobotModel:
        """The model with the groups of an SRDF text.

        :raises AssistantError: the text cannot be used with this robot.
        """
        try:
            return motion.load_model(self.urdf, srdf)
        except motion.MotionError as error:
            raise AssistantError(f"the SRDF does not fit the robot: {error}") from error

    @property
    def movable_joints(self) -> list[str]:
        """Joints that somebody can move: neither fixed nor mimicking another."""
        return list(self.model.active_joints)
