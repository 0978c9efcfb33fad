"""Draws kinect.dae: python3 make_meshes.py [OUTPUT_DIR].

Millimetres; the sensor bar lies along x, the lenses look along -y, z is up; centred on the bounding box.
"""

import pathlib
import sys

from lab_tools.meshes import box, hull, ring, rod, save_dae, turned

BLACK = (0.05, 0.05, 0.055)
GLOSS = (0.10, 0.10, 0.11)
GLASS = (0.02, 0.03, 0.06)
SILVER = (0.55, 0.55, 0.56)
GREEN = (0.10, 0.75, 0.20)

FRONT = -36.3  # y of the lenses' rims


def kinect():
    ends = [rod("x", 4, *sorted((s * 131, s * 139.3)), (0, y, z), 16) for s in (-1, 1) for y in (-27, 27) for z in (1, 31)]
    bar = hull(*ends, box((-134, -31, -3), (134, 31, 35)))
    face = hull(box((-130, -33.5, 2), (130, -31, 30)), box((-126, -34, 5), (126, -31, 27)))
    lenses, glass = [], []
    for x, radius in ((-62, 8), (8, 8), (40, 9)):
        lenses.append(ring("y", radius - 2.5, radius, FRONT, -33, (x, 0, 16), 32))
        glass.append(rod("y", radius - 2.5, -35, -33, (x, 0, 16), 32))
    lamp = rod("y", 2, -34.6, -33, (-24, 0, 16), 16)
    neck = turned("z", [(-27, 22), (-22, 15), (-8, 14), (-3, 18)], (0, 0, 0), 32)
    foot = hull(box((-40, -32, -35), (40, 32, -31)), box((-34, -26, -31), (34, 26, -26)))
    back = hull(box((-120, 31, 4), (120, 36.2, 28)), box((-126, 30, 1), (126, 31, 31)))
    return {BLACK: [bar, neck, foot, back], GLOSS: [face], SILVER: lenses, GLASS: glass, GREEN: [lamp]}


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[1] / "meshes"
    folder.mkdir(parents=True, exist_ok=True)
    save_dae(folder / "kinect.dae", kinect(), scale=0.001)
