"""Draws the meshes of the UR5: python3 make_meshes.py [OUTPUT_DIR].

Millimetres in the frame of the link. Each joint is a stubby housing; the housing whose motor drives the next joint
carries a blue-grey cap, and where two links meet there is a dark seam.
"""

import pathlib
import sys

from lab_tools.meshes import box, hull, ring, rod, save_dae, save_stl, turned

JOINT = (0.17, 0.17, 0.18)
TUBE = (0.42, 0.42, 0.42)
CAP = (0.25, 0.35, 0.41)
SEAM = (0.05, 0.05, 0.05)


def housing(axis, radius, start, end, centre=(0, 0, 0)):
    """A joint housing from its flange at `start` to its rounded back at `end`."""
    sign = 1 if end > start else -1
    back = [(end - sign * 12, radius), (end - sign * 6, 0.965 * radius), (end - sign * 2, 0.86 * radius), (end, 0.70 * radius)]
    profile = [(start, 0.93 * radius), (start + sign * 3, 0.93 * radius), (start + sign * 4, radius), *back]
    return turned(axis, profile if sign > 0 else profile[::-1], centre, 48)


def capped(axis, radius, start, end, centre=(0, 0, 0)):
    """A housing from its flange at `start`, closed at `end` by a cap. Returns (housing, cap, seams)."""
    sign = 1 if end > start else -1
    thick = 0.24 * radius
    lid = end - sign * thick
    body = turned(
        axis,
        sorted([(start, 0.93 * radius), (start + sign * 3, 0.93 * radius), (start + sign * 4, radius), (lid - sign * 1.5, radius)]),
        centre,
        48,
    )
    cap = turned(
        axis,
        sorted(
            [(lid, radius), (end - sign * 0.12 * radius, 0.985 * radius), (end - sign * 0.04 * radius, 0.90 * radius), (end, 0.74 * radius)]
        ),
        centre,
        48,
    )
    gap = rod(axis, 0.96 * radius, *sorted((lid - sign * 1.5, lid)), centre, 48)
    return body, cap, gap


def flange(axis, radius, start, end, centre=(0, 0, 0)):
    """The dark seam where the next link turns."""
    return ring(axis, 0.5 * radius, 0.9 * radius, *sorted((start, end)), centre, 48)


def base():
    foot = hull(rod("z", 73.6, -3, 11, sections=64), rod("z", 71, -3, 15, sections=64))
    stub = rod("y", 9, -110, -60, (0, 0, 8))
    screws = [rod("z", 5, 11, 16.5, (x, y, 0), 16) for x, y in ((47, 47), (-47, 47), (47, -47), (-47, -47))]
    return {TUBE: [foot], SEAM: [ring("z", 40, 58, 15, 21, sections=64), stub, *screws]}


def shoulder():
    column, cap, gap = capped("z", 58, -65.2, 68.5)
    side = housing("y", 59.4, 68.5, -59.7)
    return {JOINT: [column, side], CAP: [cap], SEAM: [gap, flange("y", 59.4, 68, 70.5)]}


def upperarm():
    parts = {JOINT: [], CAP: [], SEAM: []}
    for z in (0, 425):
        body, cap, gap = capped("y", 59.7, -63.2, 68.6, (0, 0, z))
        parts[JOINT].append(body)
        parts[CAP].append(cap)
        parts[SEAM] += [gap, flange("y", 59.7, -65.2, -62, (0, 0, z))]
    tube = turned("z", [(30, 54), (64, 54), (78, 50), (300, 50), (345, 53), (368, 54), (395, 54)], (0, 0, 0), 48)
    rims = [rod("z", 55.5, z, z + 5, sections=48) for z in (59, 361)]
    return {**parts, TUBE: [tube, *rims]}


def forearm():
    elbow = housing("y", 58, 52.5, -57.2)
    body, cap, gap = capped("y", 39, 45, -57.2, (0, 0, 392.25))
    tube = turned("z", [(30, 47), (62, 47), (84, 42), (110, 38), (320, 37), (370, 37)], (0, 0, 0), 48)
    rims = [rod("z", 48.5, 58, 63, sections=48), rod("z", 38.2, 346, 351, sections=48)]
    return {
        JOINT: [elbow, body],
        CAP: [cap],
        TUBE: [tube, *rims],
        SEAM: [gap, flange("y", 58, 52, 54.5), flange("y", 39, 44.5, 47, (0, 0, 392.25))],
    }


def wrist(along, across, centre, start):
    """Both wrist elements: a housing along one axis, crossed at its middle by the motor of the next joint."""
    tube = housing(along, 38.7, start + 2, 132.9)
    motor, cap, gap = capped(across, 38.7, 45.5, -57.2, centre)
    return {JOINT: [tube, motor], CAP: [cap], SEAM: [gap, flange(along, 38.7, start, start + 2.5), flange(across, 38.7, 45, 47.5, centre)]}


def wrist1():
    return wrist("y", "z", (0, 93, 0), 47.5)


def wrist2():
    return wrist("z", "y", (0, 0, 94.65), 49.1)


def wrist3():
    disc = turned("y", [(49, 36), (51, 37.5), (79, 37.5), (81.8, 35)], (0, 0, 0), 48)
    lug = hull(rod("y", 5, 56, 70, (0, 0, 38)), box((-8, 56, 30), (8, 70, 34)))
    return {TUBE: [disc], SEAM: [flange("y", 37.5, 47.3, 50), ring("y", 16, 31.5, 81.2, 81.8), lug]}


def outline(name):
    """What contacts see: the same outlines from plain rods."""
    rods = {
        "base": [rod("z", 73.6, -3, 15), rod("z", 58, 15, 21), rod("y", 9, -110, -60, (0, 0, 8), 16)],
        "shoulder": [rod("z", 58, -65.2, 68.5), rod("y", 59.4, -59.7, 70.5)],
        "upperarm": [rod("y", 59.7, -65.2, 68.6), rod("y", 59.7, -65.2, 68.6, (0, 0, 425)), rod("z", 54, 30, 395)],
        "forearm": [rod("y", 58, -57.2, 54.5), rod("y", 39, -57.2, 47, (0, 0, 392.25)), rod("z", 47, 30, 100), rod("z", 38, 100, 370)],
        "wrist1": [rod("y", 38.7, 47.5, 132.9), rod("z", 38.7, -57.2, 47.5, (0, 93, 0))],
        "wrist2": [rod("z", 38.7, 49.1, 132.9), rod("y", 38.7, -57.2, 47.5, (0, 0, 94.65))],
        "wrist3": [rod("y", 37.5, 47.3, 81.8), box((-8, 56, 30), (8, 70, 43))],
    }
    return rods[name]


PARTS = (base, shoulder, upperarm, forearm, wrist1, wrist2, wrist3)


def main(directory):
    for kind in ("visual", "collision"):
        (directory / kind).mkdir(parents=True, exist_ok=True)
    for part in PARTS:
        save_dae(directory / "visual" / (part.__name__ + ".dae"), part(), scale=0.001)
        save_stl(directory / "collision" / (part.__name__ + ".stl"), outline(part.__name__), scale=0.001)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1] / "meshes" / "ur5")
