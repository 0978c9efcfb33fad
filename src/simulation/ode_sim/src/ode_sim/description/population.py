"""``<population>``: many copies of one model spread over a region."""

from __future__ import annotations

import math
import random
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ode_sim import math3
from ode_sim.description.model import FARTHEST, Pose, quoted
from ode_sim.description.xmlsource import child, clone, text_of

if TYPE_CHECKING:
    from ode_sim.description.sdf import SdfReader

_MOST = 1_000_000  # of anything counted


def population(reader: SdfReader, element: ET.Element, template: ET.Element | None) -> Iterator[ET.Element]:
    """Model elements named ``<model>_clone_<i>``; random places are the same in every run.

    :param reader: the :class:`~ode_sim.description.sdf.SdfReader` that reads the numbers and takes the warnings.
    :param template: the ``<model>`` to copy; None if there is none, or it could not be included.
    :param element: the ``<population>``.
    """
    if template is None:
        reader.warn(element, "a population needs a <model> or <include>; left out")
        return
    count = reader.whole(element, "model_count", 1, 0, _MOST)
    kind = text_of(element.find("distribution/type")) or "random"
    x_wr = reader.pose(element.find("pose"))
    size = reader.vector(element, "box/size", (1.0, 1.0, 1.0), most=FARTHEST)
    radius = reader.number(element, "cylinder/radius", 1.0, most=FARTHEST) if element.find("cylinder") is not None else None
    rows, cols = (reader.whole(element, f"distribution/{tag}", 1, 0, _MOST) for tag in ("rows", "cols"))
    total = rows * cols if kind == "grid" else count
    if not reader.room_for(total * sum(1 for _ in template.iter())):
        reader.warn(element, f"{total} copies of model '{quoted(template.get('name'))}' are too many; left out")
        return
    step = reader.vector(element, "distribution/step", (0.5, 0.5, 0.0), most=FARTHEST)
    rng = random.Random(f"population {element.get('name')}")
    name = template.get("name") or "model"
    for i in range(total):
        fraction = (i + 0.5) / count if count else 0.0
        if kind == "grid":
            row, col = divmod(i, cols)
            p = ((col - 0.5 * (cols - 1)) * step[0], (row - 0.5 * (rows - 1)) * step[1], 0.0)
        elif kind.startswith("linear-") and kind[-1] in "xyz":
            along = [(fraction - 0.5) * size[k] if "xyz"[k] == kind[-1] else 0.0 for k in range(3)]
            p = along[0], along[1], along[2]
        elif radius is not None:
            r, turn = radius * math.sqrt(rng.random()), rng.uniform(-math.pi, math.pi)
            p = (r * math.cos(turn), r * math.sin(turn), 0.0)
        elif kind == "uniform":  # near-square cells over the region
            cells = math.ceil(math.sqrt(count))
            row, col = divmod(i, cells)
            p = (((col + 0.5) / cells - 0.5) * size[0], ((row + 0.5) / cells - 0.5) * size[1], 0.0)
        else:
            p = math3.vec3(rng.uniform(-0.5, 0.5) * side for side in size)
        copy = clone(template)
        copy.set("name", f"{name}_clone_{i}")
        x_rm = math3.compose(Pose(p), reader.pose(template.find("pose")))
        x_wm = math3.compose(x_wr, x_rm)
        for old in copy.findall("pose"):
            copy.remove(old)
        child(copy, "pose", " ".join(repr(v) for v in (*x_wm.p, *x_wm.q)), {"rotation_format": "quat_xyzw"})
        yield copy
