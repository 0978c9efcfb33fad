"""The person that walks through worlds: bones and body.

Bones have the names and the order of those in Gazebo's walk.dae, so that skins, animations and plugins written for it fit; their
lengths, and the body round them, are our own. Lengths in metres; x forward, y left, z up, the origin at the bone ``Hips``.
"""

import math

import numpy as np

HIPS = 1.02  # m above the floor, of who stands
HIP, KNEE, ANKLE = 0.10, 0.51, 0.93  # below the hips
THIGH, SHANK = KNEE - HIP, ANKLE - KNEE
SOLE = HIPS - ANKLE  # of the ankle
TOES = 0.14  # before the ankle, the joint of the toes
TOE_HEIGHT = 0.03
HEEL = 0.05  # behind the ankle

SKIN, HAIR, SHIRT, TROUSERS, SHOES = (0.80, 0.58, 0.45), (0.18, 0.12, 0.08), (0.16, 0.36, 0.50), (0.20, 0.22, 0.30), (0.12, 0.11, 0.11)
EYES = (0.10, 0.10, 0.12)
COLOURS = {"skin": SKIN, "hair": HAIR, "shirt": SHIRT, "trousers": TROUSERS, "shoes": SHOES, "eyes": EYES}


def bones():
    """(name, parent, place seen from the parent, at rest and in the axes of the person) of each, parents first."""
    found = [("Hips", None, (0, 0, 0))]
    for side, y in (("Left", 1), ("Right", -1)):
        found += [
            (f"{side[0]}HipJoint", "Hips", (0, 0, 0)),
            (f"{side}UpLeg", f"{side[0]}HipJoint", (0, 0.09 * y, -HIP)),
            (f"{side}Leg", f"{side}UpLeg", (0, 0, -THIGH)),
            (f"{side}Foot", f"{side}Leg", (0, 0, -SHANK)),
            (f"{side}ToeBase", f"{side}Foot", (TOES, 0, TOE_HEIGHT - SOLE)),
        ]
    found += [
        ("LowerBack", "Hips", (0, 0, 0)),
        ("Spine", "LowerBack", (0, 0, 0.13)),
        ("Spine1", "Spine", (0, 0, 0.14)),
        ("Neck", "Spine1", (0, 0, 0)),
        ("Neck1", "Neck", (0.01, 0, 0.19)),
        ("Head", "Neck1", (0.015, 0, 0.08)),
    ]
    for side, y in (("Left", 1), ("Right", -1)):
        found += [
            (f"{side}Shoulder", "Spine1", (0, 0, 0)),
            (f"{side}Arm", f"{side}Shoulder", (0, 0.185 * y, 0.14)),
            (f"{side}ForeArm", f"{side}Arm", (0, 0, -0.29)),
            (f"{side}Hand", f"{side}ForeArm", (0, 0, -0.25)),
            (f"{side}FingerBase", f"{side}Hand", (0, 0, 0)),
            (f"{side}HandIndex1", f"{side}FingerBase", (0, 0, -0.09)),
            (f"{side[0]}Thumb", f"{side}Hand", (0, 0, 0)),
        ]
    return found


def places():
    """Name of a bone -> where it is at rest."""
    found = {}
    for name, parent, place in bones():
        found[name] = np.array(place, float) + (found[parent] if parent else 0.0)
    return found


def loft(sections, sides=14):
    """A closed body round ellipses, from the bottom up.

    :param sections: (x, y, z, half depth, half width) of each. :return: vertices (V, 3), triangles (T, 3).
    """
    angles = np.arange(sides) * 2.0 * math.pi / sides
    vertices = [(x + depth * math.cos(a), y + width * math.sin(a), z) for x, y, z, depth, width in sections for a in angles]
    triangles = []
    for row in range(len(sections) - 1):
        for i in range(sides):
            a, b = row * sides + i, row * sides + (i + 1) % sides
            triangles += [(a, b, b + sides), (a, b + sides, a + sides)]
    for first, section, up in ((0, sections[0], False), ((len(sections) - 1) * sides, sections[-1], True)):
        vertices.append(section[:3])
        middle = len(vertices) - 1
        for i in range(sides):
            a, b = first + i, first + (i + 1) % sides
            triangles.append((middle, a, b) if up else (middle, b, a))
    return np.array(vertices, float), np.array(triangles)


def limb(length, radius, end_radius, bulge=0.0, rings=4):
    """Round ends at the joints; hangs down from the origin. ``bulge``: how much thicker it is a third of the way down."""
    sections = []
    for a in (-75, -50, -25):
        r = math.radians(a)
        sections.append((0, 0, -length + end_radius * math.sin(r), end_radius * math.cos(r), end_radius * math.cos(r)))
    for i in range(rings + 1):
        part = i / rings
        thick = end_radius + (radius - end_radius) * part + bulge * math.sin(math.pi * part) ** 2 * part
        sections.append((0, 0, -length * (1.0 - part), thick, thick))
    for a in (25, 50, 75):
        r = math.radians(a)
        sections.append((0, 0, radius * math.sin(r), radius * math.cos(r), radius * math.cos(r)))
    return loft(sections)


def ball(x, y, z, depth, width, height, rows=7, sides=14):
    steps = np.linspace(-80, 80, rows)
    return loft(
        [
            (x, y, z + height * math.sin(math.radians(a)), depth * math.cos(math.radians(a)), width * math.cos(math.radians(a)))
            for a in steps
        ],
        sides,
    )


def lying(body, x=0.0, z=0.0):
    """Turned so that what was up points forward."""
    vertices, triangles = body
    return np.column_stack([vertices[:, 2] + x, vertices[:, 1], -vertices[:, 0] + z]), triangles


def _trunk():
    # fmt: off
    return [
        ("Hips", "trousers", loft([(0, 0, -0.155, 0.05, 0.09), (0, 0, -0.13, 0.095, 0.14), (-0.008, 0, -0.09, 0.112, 0.168),
                                   (-0.008, 0, -0.03, 0.112, 0.172), (0, 0, 0.03, 0.102, 0.158), (0, 0, 0.07, 0.09, 0.14)], 18)),
        ("LowerBack", "shirt", loft([(0, 0, -0.035, 0.112, 0.17), (0, 0, 0.03, 0.11, 0.166), (0, 0, 0.10, 0.101, 0.152),
                                     (0, 0, 0.17, 0.10, 0.15)], 18)),
        ("Spine", "shirt", loft([(0, 0, -0.03, 0.101, 0.152), (0.003, 0, 0.05, 0.105, 0.158), (0.006, 0, 0.12, 0.112, 0.17),
                                 (0.006, 0, 0.19, 0.112, 0.172)], 18)),
        ("Spine1", "shirt", loft([(0.006, 0, -0.03, 0.11, 0.168), (0.008, 0, 0.04, 0.116, 0.178), (0.006, 0, 0.10, 0.112, 0.186),
                                  (0.0, 0, 0.145, 0.094, 0.186), (-0.004, 0, 0.175, 0.074, 0.15), (-0.004, 0, 0.195, 0.062, 0.095),
                                  (0, 0, 0.21, 0.055, 0.065)], 18)),
        ("Neck", "skin", loft([(0, 0, 0.15, 0.055, 0.06), (0.003, 0, 0.205, 0.05, 0.052), (0.01, 0, 0.24, 0.049, 0.05)])),
        ("Neck1", "skin", loft([(-0.004, 0, -0.02, 0.05, 0.052), (0.002, 0, 0.04, 0.049, 0.05), (0.012, 0, 0.10, 0.055, 0.055)])),
        ("Head", "skin", loft([(0.035, 0, -0.045, 0.03, 0.03), (0.028, 0, -0.035, 0.056, 0.046), (0.018, 0, 0.0, 0.080, 0.062),
                               (0.010, 0, 0.045, 0.092, 0.072), (0.006, 0, 0.09, 0.097, 0.077), (0.002, 0, 0.13, 0.093, 0.074),
                               (0.0, 0, 0.165, 0.072, 0.058), (0.0, 0, 0.185, 0.035, 0.03)], 18)),
        ("Head", "hair", loft([(-0.030, 0, 0.035, 0.066, 0.066), (-0.026, 0, 0.07, 0.078, 0.079), (-0.016, 0, 0.105, 0.092, 0.084),
                               (-0.004, 0, 0.135, 0.100, 0.082), (-0.002, 0, 0.17, 0.080, 0.066), (-0.002, 0, 0.195, 0.035, 0.03)], 18)),
        ("Head", "skin", ball(0.103, 0, 0.045, 0.016, 0.013, 0.026, 5, 8)),
        ("Head", "skin", ball(0.0, 0.074, 0.055, 0.018, 0.008, 0.030, 5, 8)),
        ("Head", "skin", ball(0.0, -0.074, 0.055, 0.018, 0.008, 0.030, 5, 8)),
        ("Head", "eyes", ball(0.091, 0.030, 0.075, 0.008, 0.011, 0.007, 5, 8)),
        ("Head", "eyes", ball(0.091, -0.030, 0.075, 0.008, 0.011, 0.007, 5, 8)),
    ]
    # fmt: on


def _side(side, y):
    foot = loft(
        [
            (-0.004, 0, -0.055, 0.030, 0.030),
            (-0.008, 0, -0.04, 0.044, 0.040),
            (-0.008, 0, 0.04, 0.044, 0.042),
            (-0.012, 0, 0.10, 0.032, 0.043),
            (-0.018, 0, 0.155, 0.024, 0.045),
        ]
    )
    toes = loft([(0, 0, -0.02, 0.024, 0.045), (0, 0, 0.03, 0.020, 0.043), (0.003, 0, 0.065, 0.014, 0.034), (0.005, 0, 0.083, 0.007, 0.018)])
    return [
        (f"{side}UpLeg", "trousers", limb(THIGH, 0.088, 0.060, 0.006)),
        (f"{side}Leg", "trousers", limb(SHANK, 0.059, 0.046, 0.012)),
        (f"{side}Foot", "shoes", lying(foot, 0.0, -0.057)),
        (f"{side}ToeBase", "shoes", lying(toes, 0.0, -0.004)),
        (f"{side}Arm", "shirt", limb(0.29, 0.060, 0.045, 0.004)),
        (f"{side}ForeArm", "skin", limb(0.25, 0.041, 0.029, 0.006)),
        (f"{side}Hand", "skin", ball(0.005, 0, -0.055, 0.042, 0.020, 0.060, 7, 10)),
        (f"{side}FingerBase", "skin", ball(0.006, 0.002 * -y, -0.120, 0.034, 0.016, 0.062, 7, 10)),
        (f"{side[0]}Thumb", "skin", ball(0.040, 0.004 * -y, -0.065, 0.014, 0.013, 0.045, 5, 8)),
    ]


def solids():
    """(bone, colour, vertices, triangles) of each piece, in the frame of its bone at rest."""
    found = _trunk() + _side("Left", 1) + _side("Right", -1)
    return [(bone, colour, vertices, triangles) for bone, colour, (vertices, triangles) in found]
