"""Where buildings are kept: one folder for each, with the plan, and the model that Gazebo Classic would open."""

from __future__ import annotations

import os
import re
from typing import Any

import yaml
from building_editor import preview, sdf_model
from building_editor.building import PlanError, building_of
from building_editor.plan_file import load_plan
from ode_sim.description import read_sdf_model
from ode_sim.whole_files import write_whole
from ode_sim_viewer.simulation import Refused

from gzclient.building.reopened import plan_of

#: As upstream's editor names it, in the home folder.
FOLDER = "building_editor_models"
PLAN = "plan.yaml"
MODEL = "model.sdf"
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_. -]{0,80}")


def folder() -> str:
    return os.path.join(os.path.expanduser("~"), FOLDER)


def checked_name(name: str) -> str:
    """A name that is one folder below :func:`folder`, whatever a page sends.

    :raises Refused: it is not
    """
    if not _NAME.fullmatch(name):
        raise Refused("A building's name has letters, digits, - _ . and blanks, at most 80; it names a folder.")
    return name


def names() -> list[str]:
    """Of the buildings that can be opened."""
    try:
        return sorted(
            name
            for name in os.listdir(folder())
            if _NAME.fullmatch(name) and any(os.path.isfile(os.path.join(folder(), name, file)) for file in (PLAN, MODEL))
        )
    except OSError:
        return []


def save(document: dict[str, Any]) -> str:
    """Write ``plan.yaml``, ``model.sdf``, ``model.config``, ``NAME.world`` and ``preview.png``; the folder.

    :raises Refused: nothing is drawn, or it cannot be written
    """
    name = checked_name(str(document.get("name", "")))
    target = os.path.join(folder(), name)
    try:
        building = building_of(document)
        os.makedirs(target, exist_ok=True)
        write_whole(os.path.join(target, PLAN), text_of(document))
        sdf_model.write(building, target + "/")
        sdf_model.write(building, os.path.join(target, f"{name}.world"))
        preview.save(building, os.path.join(target, "preview.png"))
    except PlanError as error:
        raise Refused(str(error)) from error
    except OSError as error:
        raise Refused(f"{error.filename or target}: {error.strerror or error}") from error
    return target


def text_of(document: dict[str, Any]) -> str:
    """The plan as YAML, an element a line."""
    ordered = {key: document[key] for key in ("name", *(key for key in document if key != "name")) if key in document}
    return "# A building for gzclient's editor and for rosrun building_editor build_world plan.yaml -o NAME.world\n" + yaml.safe_dump(
        ordered, sort_keys=False, default_flow_style=None, width=110
    )


def load(name: str) -> tuple[dict[str, Any], list[str]]:
    """The plan of a building that was saved, and what of it was not understood: Gazebo's editor writes no plan, only a model.

    :raises Refused: it cannot be read
    """
    file = os.path.join(folder(), checked_name(name), PLAN)
    if not os.path.exists(file) and os.path.exists(os.path.join(folder(), name, MODEL)):
        return _load_model(name, os.path.join(folder(), name, MODEL))
    try:
        document = load_plan(file)
    except ValueError as error:
        raise Refused(str(error)) from error
    if not isinstance(document, dict):
        raise Refused(f"{name}/{PLAN} holds no plan")
    return document, []


def _load_model(name: str, file: str) -> tuple[dict[str, Any], list[str]]:
    try:
        with open(file, encoding="utf-8") as stream:
            model, _ = read_sdf_model(stream.read(), name=name, file=file)
    except OSError as error:
        raise Refused(f"{file}: {error.strerror}") from error
    except ValueError as error:  # of its text, too
        raise Refused(str(error)) from error
    document, left = plan_of(model)
    if not any(part.get("walls") or part.get("stairs") for part in (document, *document.get("levels", ()))):
        raise Refused(f"{name}/{MODEL} has no link Wall_0, Wall_1 ... of boxes, as a building has")
    return document, left
