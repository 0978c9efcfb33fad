"""Robots for the tests, as URDF and SRDF text. Sizes and limits are those of the real arms, shapes are simple."""

from math import pi, radians

UR5 = [  # joint, type, xyz, rpy, axis, lower, upper
    ("shoulder_pan_joint", (0, 0, 0.089159), (0, 0, 0), (0, 0, 1), -2 * pi, 2 * pi),
    ("shoulder_lift_joint", (0, 0.13585, 0), (0, pi / 2, 0), (0, 1, 0), -2 * pi, 2 * pi),
    ("elbow_joint", (0, -0.1197, 0.425), (0, 0, 0), (0, 1, 0), -pi, pi),
    ("wrist_1_joint", (0, 0, 0.39225), (0, pi / 2, 0), (0, 1, 0), -2 * pi, 2 * pi),
    ("wrist_2_joint", (0, 0.093, 0), (0, 0, 0), (0, 0, 1), -2 * pi, 2 * pi),
    ("wrist_3_joint", (0, 0, 0.09465), (0, 0, 0), (0, 1, 0), -2 * pi, 2 * pi),
]
UR5_TIP = ((0, 0.0823, 0), (-pi / 2, 0, 0))

PANDA = [
    ("panda_joint1", (0, 0, 0.333), (0, 0, 0), (0, 0, 1), -2.8973, 2.8973),
    ("panda_joint2", (0, 0, 0), (-pi / 2, 0, 0), (0, 0, 1), -1.7628, 1.7628),
    ("panda_joint3", (0, -0.316, 0), (pi / 2, 0, 0), (0, 0, 1), -2.8973, 2.8973),
    ("panda_joint4", (0.0825, 0, 0), (pi / 2, 0, 0), (0, 0, 1), -3.0718, -0.0698),
    ("panda_joint5", (-0.0825, 0.384, 0), (-pi / 2, 0, 0), (0, 0, 1), -2.8973, 2.8973),
    ("panda_joint6", (0, 0, 0), (pi / 2, 0, 0), (0, 0, 1), -0.0175, 3.7525),
    ("panda_joint7", (0.088, 0, 0), (pi / 2, 0, 0), (0, 0, 1), -2.8973, 2.8973),
]
PANDA_TIP = ((0, 0, 0.107), (0, 0, 0))

IIWA = [
    ("iiwa_joint_1", (0, 0, 0.1575), (0, 0, 0), (0, 0, 1), -2.9671, 2.9671),
    ("iiwa_joint_2", (0, 0, 0.2025), (pi / 2, 0, pi), (0, 0, 1), -2.0944, 2.0944),
    ("iiwa_joint_3", (0, 0.2045, 0), (pi / 2, 0, pi), (0, 0, 1), -2.9671, 2.9671),
    ("iiwa_joint_4", (0, 0, 0.2155), (pi / 2, 0, 0), (0, 0, 1), -2.0944, 2.0944),
    ("iiwa_joint_5", (0, 0.1845, 0), (-pi / 2, pi, 0), (0, 0, 1), -2.9671, 2.9671),
    ("iiwa_joint_6", (0, 0, 0.2155), (pi / 2, 0, 0), (0, 0, 1), -2.0944, 2.0944),
    ("iiwa_joint_7", (0, 0.081, 0), (-pi / 2, pi, 0), (0, 0, 1), -3.0543, 3.0543),
]
IIWA_TIP = ((0, 0, 0.045), (0, 0, 0))

FETCH = [  # None: no limit, a continuous joint
    ("shoulder_pan_joint", (0.12, 0, 0.35), (0, 0, 0), (0, 0, 1), -1.6056, 1.6056),
    ("shoulder_lift_joint", (0.117, 0, 0.06), (0, 0, 0), (0, 1, 0), -1.221, 1.518),
    ("upperarm_roll_joint", (0.219, 0, 0), (0, 0, 0), (1, 0, 0), None, None),
    ("elbow_flex_joint", (0.133, 0, 0), (0, 0, 0), (0, 1, 0), -2.251, 2.251),
    ("forearm_roll_joint", (0.197, 0, 0), (0, 0, 0), (1, 0, 0), None, None),
    ("wrist_flex_joint", (0.1245, 0, 0), (0, 0, 0), (0, 1, 0), -2.16, 2.16),
    ("wrist_roll_joint", (0.1385, 0, 0), (0, 0, 0), (1, 0, 0), None, None),
]
FETCH_TIP = ((0.16645, 0, 0), (0, 0, 0))

JACO = [  # of six joints, with three fingers
    ("joint_1", (0, 0, 0.15675), (0, pi, 0), (0, 0, 1), None, None),
    ("joint_2", (0, 0.0016, -0.11875), (-pi / 2, 0, pi), (0, 0, 1), radians(47), radians(313)),
    ("joint_3", (0, -0.41, 0), (0, pi, 0), (0, 0, 1), radians(19), radians(341)),
    ("joint_4", (0, 0.2073, -0.0114), (-pi / 2, 0, pi), (0, 0, 1), None, None),
    ("joint_5", (0, -0.03703, -0.06414), (pi / 3, 0, pi), (0, 0, 1), None, None),
    ("joint_6", (0, -0.03703, -0.06414), (pi / 3, 0, pi), (0, 0, 1), None, None),
]
JACO_TIP = ((0, 0, -0.16), (pi, 0, pi / 2))

ARMS = {"ur5": (UR5, UR5_TIP), "panda": (PANDA, PANDA_TIP), "iiwa": (IIWA, IIWA_TIP), "fetch": (FETCH, FETCH_TIP), "jaco": (JACO, JACO_TIP)}


def _numbers(values):
    return " ".join(repr(float(v)) for v in values)


def arm(name, radius=0.04, extra=""):
    """(URDF, SRDF) of an arm with the group "arm" from base_link to tool; each moving link is a ball at its joint."""
    joints, (tip_xyz, tip_rpy) = ARMS[name]
    urdf = [
        f'<robot name="{name}"><link name="base_link"><collision><origin xyz="0 0 0.02"/><geometry>'
        '<cylinder radius="0.06" length="0.04"/></geometry></collision></link>'
    ]
    parent = "base_link"
    for index, (joint, xyz, rpy, axis, lower, upper) in enumerate(joints):
        link = f"link_{index + 1}"
        limit = (
            '<limit velocity="3" effort="10"/>'
            if lower is None
            else f'<limit lower="{lower!r}" upper="{upper!r}" velocity="3" effort="10"/>'
        )
        urdf.append(
            f'<link name="{link}"><collision><geometry><sphere radius="{radius}"/></geometry></collision></link>'
            f'<joint name="{joint}" type="{"continuous" if lower is None else "revolute"}"><parent link="{parent}"/>'
            f'<child link="{link}"/><origin xyz="{_numbers(xyz)}" rpy="{_numbers(rpy)}"/><axis xyz="{_numbers(axis)}"/>'
            f"{limit}</joint>"
        )
        parent = link
    urdf.append(
        f'<link name="tool"/><joint name="tool_joint" type="fixed"><parent link="{parent}"/><child link="tool"/>'
        f'<origin xyz="{_numbers(tip_xyz)}" rpy="{_numbers(tip_rpy)}"/></joint>{extra}</robot>'
    )
    links = ["base_link"] + [f"link_{i + 1}" for i in range(len(joints))]
    pairs = "".join(
        f'<disable_collisions link1="{a}" link2="{b}" reason="Adjacent"/>' for i, a in enumerate(links) for b in links[i + 1 : i + 3]
    )
    srdf = f'<robot name="{name}"><group name="arm"><chain base_link="base_link" tip_link="tool"/></group>{pairs}</robot>'
    return "".join(urdf), srdf
