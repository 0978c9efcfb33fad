"""Filters that look at ranges, intensities and angles alone."""

from __future__ import annotations

import math

import numpy as np

from .base import BEYOND, Filter, FilterError, Scan, Setting


class RangeFilter(Filter):
    """Ranges outside two thresholds get values of their own."""

    settings = (
        Setting("lower_threshold", float, 0.0, 0.0, 1e5),
        Setting("upper_threshold", float, 1e5, 0.0, 1e5),
        Setting("use_message_range_limits", bool, False),
        Setting("lower_replacement_value", float, 0.0, 0.0, 1e5),
        Setting("upper_replacement_value", float, 1e5, 0.0, 1e5),
    )

    def apply(self, scan: Scan) -> None:
        v = self.values
        low, high = v["lower_threshold"], v["upper_threshold"]
        if v["use_message_range_limits"]:
            low, high = scan.range_min, scan.range_max
        below, above = scan.ranges <= low, scan.ranges >= high
        scan.ranges[above] = v["upper_replacement_value"]
        scan.ranges[below] = v["lower_replacement_value"]


class IntensityFilter(Filter):
    """Rays outside two thresholds of intensity lose their range, or their intensity."""

    settings = (
        Setting("lower_threshold", float, 8000.0, 0.0, 1e5),
        Setting("upper_threshold", float, 1e5, 0.0, 1e5),
        Setting("invert", bool, False),
        Setting("filter_override_range", bool, True),
        Setting("filter_override_intensity", bool, False),
    )

    def apply(self, scan: Scan) -> None:
        v, light = self.values, scan.intensities
        out = (light <= v["lower_threshold"]) | (light >= v["upper_threshold"])
        out = ~out if v["invert"] else out
        if v["filter_override_range"]:
            scan.ranges[: len(out)][out[: len(scan.ranges)]] = np.nan
        if v["filter_override_intensity"]:
            light[:] = np.where(out, 0.0, 1.0)


class AngularBoundsFilter(Filter):
    """The rays between two angles are left; the scan gets narrower."""

    settings = (Setting("lower_angle", float, live=False), Setting("upper_angle", float, live=False))

    def apply(self, scan: Scan) -> None:
        low, high = self.values["lower_angle"], self.values["upper_angle"]
        step, count = scan.angle_increment, len(scan.ranges)
        if not step:
            return
        ahead = (low - scan.angle_min) if step > 0 else (high - scan.angle_min)
        first = min(max(math.ceil(ahead / step - 1e-6), 0), count)
        beyond = (high - scan.angle_min) if step > 0 else (low - scan.angle_min)
        last = min(max(math.floor(beyond / step + 1e-6), first), count - 1)
        scan.ranges = scan.ranges[first : last + 1]
        scan.intensities = scan.intensities[first : last + 1]
        scan.angle_min += first * step
        scan.stamp += first * scan.time_increment


class AngularBoundsFilterInPlace(Filter):
    """The rays between two angles see nothing any more; the scan stays as wide."""

    settings = AngularBoundsFilter.settings

    def apply(self, scan: Scan) -> None:
        hide(scan, (scan.angles > self.values["lower_angle"]) & (scan.angles < self.values["upper_angle"]))


class SectorFilter(Filter):
    """What lies in a sector of a ring, or all that lies outside it, is hidden."""

    settings = (
        Setting("angle_min", float, 0.0, -math.pi, math.pi),
        Setting("angle_max", float, 0.0, -math.pi, math.pi),
        Setting("range_min", float, 0.0, 0.0, 1e5),
        Setting("range_max", float, 1e5, 0.0, 1e5),
        Setting("clear_inside", bool, True),
        Setting("invert", bool, False),
    )

    def apply(self, scan: Scan) -> None:
        v = self.values
        width, angle = v["angle_max"] - v["angle_min"], scan.angles - v["angle_min"]
        if width < 0:
            width += 2 * math.pi
            angle = np.where(angle < 0, angle + 2 * math.pi, angle)
        inside = (angle > 0) & (angle < width) & (scan.ranges > v["range_min"]) & (scan.ranges < v["range_max"])
        hide(scan, inside if v["clear_inside"] and not v["invert"] else ~inside)


class MaskFilter(Filter):
    """Rays by their numbers: ``masks`` has a list of them for each frame."""

    def prepare(self, given) -> None:
        masks = given.get("masks")
        if not isinstance(masks, dict) or not all(
            isinstance(mask, list) and all(isinstance(i, int) for i in mask) for mask in masks.values()
        ):
            raise FilterError(f"filter '{self.name}' needs masks: a list of numbers of rays for each frame")
        self._masks = masks

    def apply(self, scan: Scan) -> None:
        mask = np.array(self._masks.get(scan.frame, []), int)
        scan.ranges[mask[(mask >= 0) & (mask < len(scan.ranges))]] = np.nan


class InterpolationFilter(Filter):
    """What a ray did not see is put half way between what its neighbours saw."""

    def apply(self, scan: Scan) -> None:
        lost = (scan.ranges <= scan.range_min) | (scan.ranges >= scan.range_max)
        before = after = scan.range_max - 0.01
        i, count = 0, len(scan.ranges)
        while i < count:
            if not lost[i]:
                before = scan.ranges[i]
                i += 1
                continue
            seen = np.flatnonzero(~lost[i:])
            j = i + int(seen[0]) if len(seen) else count
            after = scan.ranges[j] if j < count else after
            scan.ranges[i:j] = (before + after) / 2
            before = after
            i = j + 1


class SpeckleFilter(Filter):
    """Single points near by, without neighbours at their distance, go."""

    settings = (
        Setting("filter_type", int, 0, 0, 1),
        Setting("max_range", float, 2.0, 0.0, 100.0),
        Setting("max_range_difference", float, 0.4, 0.0, 100.0),
        Setting("filter_window", int, 4, 0, 100),
    )

    def apply(self, scan: Scan) -> None:
        v, count = self.values, len(scan.ranges)
        window = v["filter_window"]
        if count <= window + 1:
            raise FilterError(f"filter '{self.name}': a scan of {count} rays is too small for a window of {window}")
        with np.errstate(invalid="ignore"):
            keep = scan.ranges > v["max_range"]
            alone = self._apart if v["filter_type"] == 0 else self._lonely
            for first in np.flatnonzero(~alone(scan, window, v["max_range_difference"])):
                keep[first : first + window] = True
        scan.ranges[~keep] = np.nan

    @staticmethod
    def _apart(scan: Scan, window: int, difference: float) -> np.ndarray:
        """Whether the window that begins at a ray has a point that is further from its first one than ``difference``."""
        starts = len(scan.ranges) - window + 1
        first = scan.ranges[:starts]
        together = ~np.isnan(first)
        for k in range(1, window):
            together &= np.abs(scan.ranges[k : k + starts] - first) <= difference
        return ~together

    @staticmethod
    def _lonely(scan: Scan, window: int, distance: float) -> np.ndarray:
        """Whether fewer than ``window`` of the points that many rays to either side are within ``distance`` m."""
        count, starts = len(scan.ranges), len(scan.ranges) - window + 1
        padded = np.concatenate((np.full(window, np.nan), scan.ranges, np.full(window, np.nan)))
        near = np.zeros(starts, int)
        r = scan.ranges[:starts]
        for k in list(range(-window, 0)) + list(range(1, window + 1)):
            other = padded[window + k : window + k + count][:starts]
            near += np.sqrt(np.maximum(r * r + other * other - 2 * r * other * math.cos(k * scan.angle_increment), 0.0)) <= distance
        return near < window


class BlobFilter(Filter):
    """Of each run of more than ``min_points`` points that lie together the one in the middle is left: feet of people and chairs.

    What is not left keeps its distance as a negative range. A run ends where a range is negative or NaN, as after a shadows filter.
    """

    settings = (Setting("max_radius", float, live=False), Setting("min_points", int, live=False))

    def apply(self, scan: Scan) -> None:
        given = scan.ranges.astype(float)
        scan.ranges = -np.abs(scan.ranges)
        seen = np.concatenate(([False], given >= 0, [False]))
        edges = np.flatnonzero(seen[1:] != seen[:-1]).reshape(-1, 2)
        for first, end in edges[edges[:, 1] - edges[:, 0] > self.values["min_points"]]:
            run = given[first:end]
            with np.errstate(invalid="ignore"):
                radius = np.abs(run - run.mean()).max()  # upstream's second axis is the first one, times angle_increment
            if radius * max(1.0, abs(scan.angle_increment)) < self.values["max_radius"]:
                middle = first + (end - first) // 2
                scan.ranges[middle] = given[middle]


class ShadowsFilter(Filter):
    """Points between two things, where a ray grazed the edge of the nearer one: the line to a neighbour points at the sensor."""

    remembers = False
    settings = (
        Setting("min_angle", float, None, 0.0, 360.0),
        Setting("max_angle", float, None, 0.0, 360.0),
        Setting("window", int, None, 0, 100),
        Setting("neighbors", int, 0, 0, 100),
        Setting("remove_shadow_start_point", bool, False),
    )

    def prepare(self, given) -> None:
        if given:
            self.values.update(min_angle=min(max(self.values["min_angle"], 0.0), 90.0))
            self.values.update(max_angle=min(max(self.values["max_angle"], 90.0), 180.0))
        self._min, self._max = math.radians(self.values["min_angle"]), math.radians(self.values["max_angle"])

    def apply(self, scan: Scan) -> None:
        window, reach, count = self.values["window"], self.values["neighbors"], len(scan.ranges)
        given = scan.ranges.copy()
        shadows = np.zeros(count, bool)
        with np.errstate(invalid="ignore"):
            for k in [k for k in range(-window, window + 1) if k and abs(k) < count]:
                here, there = (given[-k:], given[:k]) if k < 0 else (given[:-k], given[k:])
                turn = k * scan.angle_increment
                angle = np.arctan2(np.abs(there * math.sin(turn)), here - there * math.cos(turn))
                hit = (angle > 0) & (angle < self._min) | (angle > self._max) & (angle < math.pi)
                shadows[-k:] |= hit if k < 0 else False
                shadows[: count - k] |= hit if k > 0 else False
        for i in np.flatnonzero(shadows):
            near = slice(max(i - reach, 0), min(i + reach, count - 1) + 1)
            scan.ranges[near][given[near] > given[i]] = np.nan
            if self.values["remove_shadow_start_point"]:
                scan.ranges[i] = np.nan


def hide(scan: Scan, rays: np.ndarray) -> None:
    """Let ``rays`` (N,) bool or indices of ``scan`` see nothing, as a range beyond the greatest says it."""
    scan.ranges[rays] = scan.range_max + BEYOND
    scan.intensities[rays[: len(scan.intensities)]] = 0.0
