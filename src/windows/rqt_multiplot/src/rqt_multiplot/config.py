"""What a table of plots shows, as dataclasses, and the XML files of rqt_multiplot. No ROS and no Qt in here.

The names of the attributes are those of the elements. Files are written with the bytes that rqt_multiplot wrote on Noetic, so
that a change of one title is a change of one line in version control.
"""

from __future__ import annotations

import copy
import dataclasses
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, fields, is_dataclass
from enum import IntEnum
from xml.sax.saxutils import escape

from qt_gui.errors import WindowError

MOST_PLOTS = 100  #: of a table: more cannot be seen, and a broken file must not bring down the window


class ConfigError(WindowError, ValueError):
    """A file that is no configuration; one line that names it and says why."""


class FieldType(IntEnum):
    DATA, RECEIPT_TIME = 0, 1


class ScaleType(IntEnum):
    AUTO, ABSOLUTE, RELATIVE = 0, 1, 2


class ColorType(IntEnum):
    AUTO, CUSTOM = 0, 1


class DataType(IntEnum):
    VECTOR, LIST, CIRCULAR_BUFFER, TIME_FRAME = 0, 1, 2, 3


class StyleType(IntEnum):
    LINES, STICKS, STEPS, POINTS = 0, 1, 2, 3


class Orientation(IntEnum):
    HORIZONTAL, VERTICAL = 1, 2


class PenStyle(IntEnum):
    NONE, SOLID, DASH, DOT, DASH_DOT, DASH_DOT_DOT = 0, 1, 2, 3, 4, 5


class TitleType(IntEnum):
    AUTO, CUSTOM = 0, 1


@dataclass
class Scale:
    type: ScaleType = ScaleType.AUTO
    absolute_minimum: float = 0.0
    absolute_maximum: float = 1000.0
    relative_minimum: float = -1000.0  #: to the newest value
    relative_maximum: float = 0.0


@dataclass
class CurveAxis:
    topic: str = ""
    type: str = ""
    field_type: FieldType = FieldType.DATA
    field: str = ""
    scale: Scale = dataclasses.field(default_factory=Scale)

    @property
    def complete(self) -> bool:
        return bool(self.topic) and (bool(self.field) or self.field_type == FieldType.RECEIPT_TIME)

    @property
    def name(self) -> str:
        """``topic/field``, as titles and exported files say it."""
        return self.topic + ("/receipt_time" if self.field_type == FieldType.RECEIPT_TIME else f"/{self.field}")


@dataclass
class CurveAxes:
    x_axis: CurveAxis = dataclasses.field(default_factory=CurveAxis)
    y_axis: CurveAxis = dataclasses.field(default_factory=CurveAxis)


@dataclass
class Color:
    type: ColorType = ColorType.AUTO
    custom_color: str = "#000000"


@dataclass
class Data:
    type: DataType = DataType.VECTOR
    circular_buffer_capacity: int = dataclasses.field(default=1000, metadata={"range": (1, 10_000_000), "absent": 10_000})
    time_frame_length: float = dataclasses.field(default=10.0, metadata={"range": (0.0, 1e9)})  #: in units of x


@dataclass
class Style:
    type: StyleType = StyleType.LINES
    lines_interpolate: bool = False
    sticks_orientation: Orientation = Orientation.VERTICAL
    sticks_baseline: float = 0.0
    steps_invert: bool = False
    pen_width: int = dataclasses.field(default=1, metadata={"range": (0, 100)})
    pen_style: PenStyle = PenStyle.SOLID
    render_antialias: bool = False


@dataclass
class Curve:
    title: str = "Untitled Curve"
    subscriber_queue_size: int = dataclasses.field(default=100, metadata={"range": (0, 1_000_000)})
    axes: CurveAxes = dataclasses.field(default_factory=CurveAxes)
    color: Color = dataclasses.field(default_factory=Color)
    data: Data = dataclasses.field(default_factory=Data)
    style: Style = dataclasses.field(default_factory=Style)

    @property
    def complete(self) -> bool:
        return self.axes.x_axis.complete and self.axes.y_axis.complete


@dataclass
class PlotAxis:
    title_type: TitleType = TitleType.AUTO
    custom_title: str = "Untitled Axis"
    title_visible: bool = True


@dataclass
class PlotAxesPair:
    x_axis: PlotAxis = dataclasses.field(default_factory=PlotAxis)
    y_axis: PlotAxis = dataclasses.field(default_factory=PlotAxis)


@dataclass
class PlotAxes:
    axes: PlotAxesPair = dataclasses.field(default_factory=PlotAxesPair)  # one in the other: so are the files


@dataclass
class Legend:
    visible: bool = True


@dataclass
class Plot:
    title: str = dataclasses.field(default="Untitled Plot", metadata={"absent": "Untitled Curve"})
    plot_rate: float = dataclasses.field(default=30.0, metadata={"range": (0.01, 100.0)})  #: Hz
    legend: Legend = dataclasses.field(default_factory=Legend)
    axes: PlotAxes = dataclasses.field(default_factory=PlotAxes)
    curves: list[Curve] = dataclasses.field(default_factory=list)

    def axis_title(self, axis: str) -> str:
        """Title of ``x_axis`` or ``y_axis``; empty when it is hidden."""
        chosen: PlotAxis = getattr(self.axes.axes, axis)
        if not chosen.title_visible:
            return ""
        if chosen.title_type == TitleType.CUSTOM:
            return chosen.custom_title
        return ", ".join(dict.fromkeys(getattr(curve.axes, axis).name for curve in self.curves))


@dataclass
class Table:
    background_color: str = "#ffffff"
    foreground_color: str = "#000000"
    link_cursor: bool = False
    link_scale: bool = False
    track_points: bool = False
    plots: list[list[Plot]] = dataclasses.field(default_factory=lambda: [[Plot()]])

    @property
    def shape(self) -> tuple[int, int]:
        """Rows, columns."""
        return len(self.plots), len(self.plots[0]) if self.plots else 0

    def resize(self, rows: int, columns: int) -> None:
        """Add empty plots or drop the last ones until there are ``rows`` of ``columns`` each."""
        self.plots = [
            [self.plots[r][c] if r < len(self.plots) and c < len(self.plots[r]) else Plot() for c in range(columns)] for r in range(rows)
        ]


def automatic_color(index: int) -> tuple[int, int, int]:
    """(r, g, b) of the index-th curve: hues that halve the largest gap, from red on."""
    hue = int(f"{index % 256:08b}"[::-1], 2) / 255 * 6
    sector, part = int(hue), hue - int(hue)
    up, down = round(255 * part), round(255 * (1 - part))
    return {0: (255, up, 0), 1: (down, 255, 0), 2: (0, 255, up), 3: (0, down, 255), 4: (up, 0, 255)}.get(sector, (255, 0, down))


# Reading


def read(text: str, name: str = "the configuration") -> tuple[Table, list[str]]:
    """A table from the text of a file, and what was wrong in it, one line each: such values are left at their defaults.

    :param name: of the file, for messages. :raises ConfigError: no XML, or another kind of file.
    """
    try:
        root = ET.fromstring(text)
    except (ET.ParseError, ValueError) as error:
        raise ConfigError(f"{name} is no XML file: {error}") from None
    table = root.find("table") if root.tag == "rqt_multiplot" else None
    if table is None:
        raise ConfigError(f"{name} is no configuration of rqt_multiplot: it lacks <rqt_multiplot><table>")
    problems: list[str] = []
    read_table = _read(Table, table, "table", problems)
    rows = _numbered(table.find("plots"), "row")
    read_table.plots = [[_read_plot(plot, f"{row.tag}/{plot.tag}", problems) for plot in _numbered(row, "column")] for row in rows]
    columns = max((len(row) for row in read_table.plots), default=0)
    if len(rows) * columns > MOST_PLOTS:
        raise ConfigError(f"{name} has {len(rows)} x {columns} plots; at most {MOST_PLOTS} can be shown")
    read_table.resize(max(1, len(rows)), max(1, columns))
    return read_table, [f"{name}: {problem}" for problem in problems]


def read_curve(text: str) -> Curve:
    """A curve from :func:`write_curve`'s text. :raises ConfigError: another text."""
    try:
        root = ET.fromstring(text)
    except (ET.ParseError, ValueError):
        root = None
    if root is None or root.tag != "curve":
        raise ConfigError("that is no curve of rqt_multiplot")
    return _read(Curve, root, "curve", [])


def _numbered(parent: ET.Element | None, prefix: str) -> list[ET.Element]:
    """Children ``prefix_N`` in the order of their numbers."""
    found = [
        (int(match.group(1)), child)
        for child in (parent if parent is not None else ())
        for match in [re.fullmatch(prefix + r"_(\d{1,9})", child.tag)]
        if match
    ]
    return [child for _, child in sorted(found, key=lambda pair: pair[0])]


def _read_plot(element: ET.Element, path: str, problems: list[str]) -> Plot:
    plot = _read(Plot, element, path, problems)
    plot.curves = [_read(Curve, curve, f"{path}/{curve.tag}", problems) for curve in _numbered(element.find("curves"), "curve")]
    return plot


def _read(kind, element: ET.Element | None, path: str, problems: list[str]):
    read_value = kind()
    for item in fields(kind):
        default = getattr(read_value, item.name)
        if isinstance(default, list):
            continue
        child = element.find(item.name) if element is not None else None
        where = f"{path}/{item.name}"
        if is_dataclass(default):
            setattr(read_value, item.name, _read(type(default), child, where, problems))
        elif child is None:
            setattr(read_value, item.name, item.metadata.get("absent", default))
        else:
            try:
                setattr(read_value, item.name, _parse((child.text or "").strip(), default, item.metadata.get("range")))
            except ValueError as error:
                problems.append(f"{where}: {error}; {_format(default)} is taken")
    return read_value


def _parse(text: str, default, bounds):
    if isinstance(default, bool):
        return text not in ("false", "0", "")  # as QVariant sees it
    if isinstance(default, IntEnum):
        return type(default)(int(text))
    if isinstance(default, str):
        if re.fullmatch(r"#[0-9a-fA-F]{6}", default) and not re.fullmatch(r"#[0-9a-fA-F]{3,8}|[A-Za-z]+", text):
            raise ValueError(f"'{text[:40]}' is no colour")
        return text
    try:
        value = type(default)(text)
    except ValueError:
        raise ValueError(f"'{text[:40]}' is no number") from None
    if not math.isfinite(value) or bounds and not bounds[0] <= value <= bounds[1]:
        raise ValueError(f"{text[:40]} is outside its range" + (f" of {bounds[0]} to {bounds[1]}" if bounds else ""))
    return value


# Writing


def write(table: Table) -> str:
    """The text of a file."""
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', "<rqt_multiplot>"]
    _write("table", table, lines, 1)
    return "\n".join(lines + ["</rqt_multiplot>", ""])


def write_curve(curve: Curve) -> str:
    """A curve as text, for the clipboard."""
    lines: list[str] = []
    _write("curve", curve, lines, 0)
    return "\n".join(lines)


def _write(name: str, value, lines: list[str], depth: int) -> None:
    indent = "    " * depth
    if is_dataclass(value):
        children = {item.name: getattr(value, item.name) for item in fields(value)}
    elif isinstance(value, list):
        prefix = {"plots": "row", "curves": "curve"}.get(name, "column")
        children = {f"{prefix}_{i}": item for i, item in enumerate(value)}
    else:
        lines.append(f"{indent}<{name}>{escape(_format(value))}</{name}>")
        return
    if not children:
        return  # a group without entries is no group of QSettings
    lines.append(f"{indent}<{name}>")
    for key in sorted(children):
        _write(key, children[key], lines, depth + 1)
    lines.append(f"{indent}</{name}>")


def _format(value) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value).removesuffix(".0")
    return str(int(value)) if isinstance(value, int) else value


def copied(value):
    """A deep copy, to be changed in a dialog."""
    return copy.deepcopy(value)
