"""Draws the meshes of the arm: python3 make_meshes.py [OUTPUT_DIR].

All lengths are millimetres in the frame of the link that shows the part; only the servo is stored in centimetres,
because the URDF scales it by 0.01. Joint axes and the plates that meet are where the joints of arm.urdf.xacro put them.
"""

import pathlib
import sys

import numpy as np
from lab_tools.meshes import box, hull, mirrored, ring, rod, save_stl


def base_link():
    """A stand: four splayed legs, a deck with its controller board, and the frame that carries the turntable.

    The front (+x) stays open at z = 25, where the camera looks out.
    """
    legs = []
    for sx in (-1, 1):
        for sy in (-1, 1):
            foot = rod("z", 7, -31.3, -28.3, (sx * 38.2, sy * 37.9, 0), 12)
            legs.append(foot)
            legs.append(hull(rod("z", 4, -29, -27, (sx * 38.2, sy * 38.0, 0), 16), rod("z", 4, 6, 9, (sx * 35, sy * 38, 0), 16)))
            legs.append(hull(rod("z", 4, 6, 9, (sx * 35, sy * 38, 0), 16), rod("z", 4, 27, 29, (sx * 31, sy * 37, 0), 16)))
            legs.append(hull(rod("z", 4, 27, 29, (sx * 31, sy * 37, 0), 16), rod("z", 4, 43, 46, (sx * 27, sy * 35, 0), 16)))
    lower = hull(*(rod("z", 5.2, -9, -6, (sx * 40, sy * 39.7, 0), 12) for sx in (-1, 1) for sy in (-1, 1)))
    deck = box((-40, -43, 6), (12, 43, 9))  # ends behind what the camera sees
    board = [
        box((-30, -30, -3.5), (30, 30, -2)),
        box((-12, -10, -2), (6, 8, 1)),
        box((14, -28, -2), (28, -18, 6)),
        box((12, 16, -2), (27, 28, 4)),
        box((-29, -22, -2), (-22, 24, 5)),
    ]
    board += [rod("z", 1.8, -6, -2, (sx * 27, sy * 27, 0), 12) for sx in (-1, 1) for sy in (-1, 1)]
    rims = mirrored(box((-38, 40, 9), (12, 43, 15)), "y") + [box((-40, -40, 9), (-37, 40, 29))]
    top = [box((-31.5, -39.5, 45.7), (31.5, 39.5, 48.7)), *mirrored(box((-31.5, 36.5, 38), (31.5, 39.5, 46)), "y")]
    # the servo that turns the table hangs under the top plate
    servo = [box((-16, -22, 33), (16, 28, 46)), rod("z", 8, 46, 48.7, (-1.1, 4.5, 0), 16)]
    # the full outline of the feet, which the listed size is about
    skirt = [hull(*(rod("z", 2, -31.3, -27.3, (sx * 43.2, y, 0), 16) for y in (-43.1, 42.9))) for sx in (-1, 1)]
    return legs + [lower, deck] + board + rims + top + servo + skirt


def base_turn():
    """The bearing plate under the turntable; its axis is at y = 15.5."""
    plate = hull(
        rod("z", 6, -1.9, 1.2, (-22.5, -21.9, 0)),
        rod("z", 6, -1.9, 1.2, (25.5, -21.9, 0)),
        rod("z", 6, -1.9, 1.2, (-22.5, 44.4, 0)),
        rod("z", 6, -1.9, 1.2, (25.5, 44.4, 0)),
    )
    races = [ring("z", 22, 28, 1.2, 3.4, (0, 15.5, 0), 48), ring("z", 10, 26, 3.4, 5.1, (0, 15.5, 0), 48)]
    screws = [rod("z", 2.2, 1.2, 2.6, (x, y, 0), 16) for x in (-23, 26) for y in (-22, 45)]
    return [plate, *races, *screws]


def base_turn_table_rot():
    """The turntable and the cradle that holds the shoulder servo."""
    disc = hull(rod("z", 27.8, -6.2, -2, (0, 0, 0), 64), box((-28, -4, -6.2), (28, 4, -2)))
    groove = ring("z", 20, 26, -7.1, -6.2, (0, 0, 0), 48)
    cradle = [box((-16, -20, -2), (16, 20, 0))]
    cradle += mirrored(hull(box((-16, 18, -2), (16, 20, 1)), box((-11, 18, 12.6), (11, 20, 13.6))), "y")
    screws = [
        rod("z", 1.8, -2, -0.6, (21.5 * np.cos(a), 21.5 * np.sin(a), 0), 16) for a in np.radians([15, 75, 105, 165, 195, 255, 285, 345])
    ]
    return [disc, groove, *cradle, *screws]


def dyn():
    """A bus servo, 50 x 32 x 40: horn and idler on the z axis, body towards +x."""

    def slab(z0, z1, inset):
        return hull(*(rod("z", 3, z0, z1, (x, y, 0), 16) for x in (-8.5 + inset, 35.5 - inset) for y in (-13 + inset, 13 - inset)))

    body = [slab(-14.5, 16, 0)]
    body += [hull(slab(16, 16.5, 0), slab(17.5, 18, 1.5)), hull(slab(-15, -14.5, 0), slab(-17, -16, 1.5))]
    seam = hull(*(rod("z", 3, -1, 1, (x, y, 0), 16) for x in (-8.5, 35.5) for y in (-13, 13)))
    horn = [rod("z", 11, 18, 19.6, (0, 0, 0), 32), rod("z", 4, 19.6, 21, (0, 0, 0), 24)]
    horn += [rod("z", 1.3, 19.6, 20.5, (8 * np.cos(a), 8 * np.sin(a), 0), 12) for a in np.radians([0, 90, 180, 270])]
    idler = [rod("z", 8, -18.4, -17, (0, 0, 0), 32), rod("z", 3, -19, -18.4, (0, 0, 0), 24)]
    ears = [rod("z", 2.4, -17.6, 18.6, (x, y, 0), 16) for x in (14, 33) for y in (-12.5, 12.5)]
    plug = [box((18, -6, 18), (30, 6, 19)), box((18, -6, -18), (30, 6, -17))]
    return body + [seam] + horn + idler + ears + plug


def f4_n_f3():
    """Two U brackets back to back: the long one rides on the horn at y = -47, the short one holds the next servo."""
    parts = []
    for x0, x1 in ((-27.4, -25.2), (18.4, 20.6)):  # cheeks with round ends about the axis
        parts.append(hull(rod("x", 13.3, x0, x1, (0, -47, 0)), box((x0, -8, -14.3), (x1, -2, 14.3))))
        parts.append(ring("x", 4, 8, x0, x1, (0, -47, 0)))
    parts.append(box((-27.4, -2.2, -14.3), (20.6, 1, 14.3)))
    for x0, x1 in ((-25.7, -23.5), (16.8, 19.0)):
        parts.append(hull(box((x0, 1, -14.3), (x1, 6, 14.3)), box((x0, 28, -10.3), (x1, 31.3, 10.3))))
    parts.append(box((-25.7, 1, -14.3), (19, 3.2, 14.3)))
    parts += mirrored(hull(box((-23.5, 3, 9.3), (16.8, 5, 11.3)), box((-19, 24, 9.3), (12, 26, 11.3))), "z")
    parts += [rod("y", 1.8, 3.2, 4.4, (x, 0, z), 16) for x in (-17, 10) for z in (-6, 6)]
    return parts


def wrist():
    """An L: cheeks about the axis at y = -13, z = -17, and a tray on which the gripper servo lies."""
    parts = []
    for x0, x1 in ((-20.2, -18.0), (25.8, 28.0)):
        parts.append(hull(rod("x", 14.3, x0, x1, (0, -13, -17.2)), box((x0, -27.3, -2), (x1, 1.6, 3))))
        parts.append(hull(box((x0, -27.3, 1), (x1, 27.4, 4)), box((x0, -22, 10.5), (x1, 22, 11.5))))
    parts.append(box((-20.2, -27.3, 1), (28, 27.4, 3.2)))
    parts += [rod("z", 1.8, 3.2, 4.4, (x, y, 0), 16) for x in (-10, 18) for y in (-20, 20)]
    return parts


def the_crawer_base():
    """The T plate of the gripper, with the rail on which the fingers run."""
    stem = hull(rod("z", 4, -2, 0.6, (-12.8, -20, 0)), rod("z", 4, -2, 0.6, (12.8, -20, 0)), box((-16.8, -4, -2), (16.8, 0, 0.6)))
    bar = hull(*(rod("z", 5, -2, 0.6, (sx * 47.2, y, 0)) for sx in (-1, 1) for y in (0, 28.8)))
    rails = [box((-48, y, 0.6), (48, y + 2, 3)) for y in (0, 28)]
    hub = ring("z", 4, 9, 0.6, 1.8, (0, 15, 0))
    return [stem, bar, *rails, hub]


def the_crawer():
    """A finger along +x: a foot, a flat pad (z = -14.2) that grips, and two ribs that taper to the tip."""
    foot = box((-14.7, -15.6, -14.2), (-11.7, 15.6, 26.7))
    pad = box((-14.7, -15.6, -14.2), (48.2, 15.6, -11.7))
    rib = hull(box((-14.7, 13.1, -14.2), (-11.7, 15.6, 26.7)), box((46, 13.1, -14.2), (48.2, 15.6, 1.3)))
    back = hull(box((8, -15.6, 16.0), (9, 15.6, 17.5)), box((46.5, -15.6, -0.4), (48.2, 15.6, 1.3)))
    tip = box((46, -15.6, -14.2), (48.2, 15.6, 1.3))
    grip = [box((x, -13, -14.2), (x + 1.5, 13, -11)) for x in range(10, 46, 5)]
    return [foot, pad, *mirrored(rib, "y"), back, tip, *grip]


PARTS = (base_link, base_turn, base_turn_table_rot, dyn, f4_n_f3, wrist, the_crawer_base, the_crawer)


def main(directory):
    directory.mkdir(parents=True, exist_ok=True)
    for part in PARTS:
        save_stl(directory / (part.__name__ + ".stl"), part(), scale=0.1 if part is dyn else 1.0)


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1] / "meshes")
