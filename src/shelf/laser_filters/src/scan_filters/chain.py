"""Chains of filters, made of the parameters that launch files and YAML carry."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from . import arrays, places, values
from .base import Filter, FilterError, Scan, Transform

KINDS = {
    "LaserArrayFilter": arrays.ArrayFilter,
    "LaserMedianFilter": arrays.MedianFilter,
    "LaserScanAngularBoundsFilter": values.AngularBoundsFilter,
    "LaserScanAngularBoundsFilterInPlace": values.AngularBoundsFilterInPlace,
    "LaserScanBoxFilter": places.BoxFilter,
    "LaserScanFootprintFilter": places.FootprintFilter,
    "LaserScanIntensityFilter": values.IntensityFilter,
    "LaserScanMaskFilter": values.MaskFilter,
    "LaserScanPolygonFilter": places.PolygonFilter,
    "LaserScanRangeFilter": values.RangeFilter,
    "LaserScanSectorFilter": values.SectorFilter,
    "LaserScanSpeckleFilter": values.SpeckleFilter,
    "InterpolationFilter": values.InterpolationFilter,
    "ScanBlobFilter": values.BlobFilter,
    "ScanShadowsFilter": values.ShadowsFilter,
    "StaticLaserScanPolygonFilter": places.StaticPolygonFilter,
}


def chain(entries: Any, transform: Transform | None = None) -> list[Filter]:
    """The filters of ``entries``, a list of ``{name, type, params}``; a type may go without ``laser_filters/``.

    :param transform: brings points from one frame into another; filters for the scan's own frame need none.
    :raises FilterError: one line that names the entry and says what is wrong with it.
    """
    if not isinstance(entries, list):
        raise FilterError("a chain of filters is a list of {name, type, params}")
    made: list[Filter] = []
    for entry in entries:
        if not isinstance(entry, dict) or not isinstance(entry.get("type"), str):
            raise FilterError(f"an entry of a chain of filters needs a name and a type: {entry!r}")
        kind = entry["type"].rsplit("/", 1)[-1]
        name = str(entry.get("name", kind))
        if kind not in KINDS:
            raise FilterError(f"filter '{name}': there is no type '{entry['type']}'; there are laser_filters/{', '.join(sorted(KINDS))}")
        if name in {other.name for other in made}:
            raise FilterError(f"two filters of a chain are called '{name}'")
        given = entry.get("params") or {}
        if not isinstance(given, dict):
            raise FilterError(f"filter '{name}': params has to be a table of names and values")
        made.append(KINDS[kind](name, given, transform))
    return made


def run(filters: list[Filter], scan: Scan, failed: Callable[[str], None]) -> bool:
    """Send ``scan`` through ``filters``, in place; False, and ``failed`` with one line, where a filter cannot."""
    for one in filters:
        try:
            one.apply(scan)
        except FilterError as error:
            failed(str(error))
            return False
    return True
