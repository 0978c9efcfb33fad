"""Text files of scenes (``.scene``): the Python face of ``moveit/planning_scene/scene_text.h``, which says how they look."""

from __future__ import annotations

import io

from moveit_msgs.msg import PlanningScene

from . import _scene_text  # type: ignore[attr-defined]  # compiled


def write(scene: PlanningScene) -> str:
    """The objects of a scene as text; all of them must be given in the scene's own frame."""
    data = io.BytesIO()
    scene.serialize(data)
    return _scene_text.write(data.getvalue())


def read(text: str, frame: str = "") -> PlanningScene:
    """A scene (a diff) with the objects of a text.

    :param frame: that the poses are given in.
    :raises ValueError: the text is no scene; the line is named.
    """
    return PlanningScene().deserialize(_scene_text.read(text, frame))
