"""What upstream's transmissions, parser and loader do (ros_control 0.20), as values on paper; all are sums of powers of two."""

from math import inf, nan
from typing import NamedTuple


class Gear(NamedTuple):
    """``made``: (kind, n, m, offset, crosswise). ``ways``: (way, values in, values out), or empty: it is refused."""

    why: str
    made: tuple
    ways: list[tuple]

    def __str__(self) -> str:
        return self.why


SIMPLE = "simple", [4.0], [1.0], [0.5], False
DIFFERENTIAL = "differential", [4.0, 4.0], [2.0, 4.0], [1.0, -1.0], False
FOUR_BAR = "four_bar", [4.0, 8.0], [2.0, 4.0], [1.0, -1.0], False

GEARS = [
    Gear(
        "simple",
        SIMPLE,
        [
            ("position_to_joint", [6.0], [2.0]),
            ("position_to_actuator", [2.0], [6.0]),
            ("velocity_to_joint", [6.0], [1.5]),
            ("velocity_to_actuator", [1.5], [6.0]),
            ("effort_to_joint", [6.0], [24.0]),
            ("effort_to_actuator", [24.0], [6.0]),
            ("absolute_to_joint", [6.0], [2.0]),
        ],
    ),
    Gear(
        "turned round",
        ("simple", [-4.0], [1.0], [0.5], False),
        [
            ("position_to_joint", [6.0], [-1.0]),
            ("position_to_actuator", [-1.0], [6.0]),
            ("velocity_to_joint", [6.0], [-1.5]),
            ("effort_to_joint", [6.0], [-24.0]),
        ],
    ),
    Gear(
        "simple: not a number, and too much of one",
        SIMPLE,
        [
            ("position_to_joint", [nan], [nan]),
            ("effort_to_actuator", [nan], [nan]),
            ("position_to_joint", [inf], [inf]),
            ("effort_to_joint", [-inf], [-inf]),
            ("velocity_to_actuator", [1e308], [inf]),
        ],
    ),
    Gear(
        "differential: together only joint 1, against each other only joint 2",
        DIFFERENTIAL,
        [
            ("velocity_to_joint", [8.0, 8.0], [1.0, 0.0]),
            ("velocity_to_joint", [8.0, -8.0], [0.0, 0.5]),
            ("position_to_joint", [8.0, 8.0], [2.0, -1.0]),
            ("position_to_joint", [8.0, -8.0], [1.0, -0.5]),
            ("absolute_to_joint", [8.0, 8.0], [2.0, -1.0]),
            ("effort_to_joint", [1.0, 1.0], [16.0, 0.0]),
            ("effort_to_joint", [1.0, -1.0], [0.0, 32.0]),
        ],
    ),
    Gear(
        "differential: and back",
        DIFFERENTIAL,
        [
            ("velocity_to_actuator", [1.0, 0.0], [8.0, 8.0]),
            ("velocity_to_actuator", [0.0, 0.5], [8.0, -8.0]),
            ("position_to_actuator", [2.0, -1.0], [8.0, 8.0]),
            ("position_to_actuator", [1.0, -0.5], [8.0, -8.0]),
            ("effort_to_actuator", [16.0, 0.0], [1.0, 1.0]),
            ("effort_to_actuator", [0.0, 32.0], [1.0, -1.0]),
        ],
    ),
    Gear(
        "differential: absolute encoders on the joints, crosswise and without offset",
        (*DIFFERENTIAL[:4], True),
        [("absolute_to_joint", [3.0, 5.0], [5.0, 3.0]), ("position_to_joint", [8.0, 8.0], [2.0, -1.0])],
    ),
    Gear(
        "differential: NaN goes to both, infinities against each other are none",
        DIFFERENTIAL,
        [
            ("velocity_to_joint", [nan, 1.0], [nan, nan]),
            ("effort_to_joint", [inf, 1.0], [inf, inf]),
            ("velocity_to_joint", [inf, inf], [inf, nan]),
            ("position_to_actuator", [1.0, nan], [nan, nan]),
        ],
    ),
    Gear(
        "four bars: joint 1 takes joint 2 along",
        FOUR_BAR,
        [
            ("velocity_to_joint", [8.0, 0.0], [1.0, -0.25]),
            ("velocity_to_joint", [0.0, 8.0], [0.0, 0.25]),
            ("position_to_joint", [8.0, 0.0], [2.0, -1.25]),
            ("absolute_to_joint", [8.0, 0.0], [2.0, -1.25]),
            ("effort_to_joint", [1.0, 0.0], [8.0, -32.0]),
            ("effort_to_joint", [0.0, 1.0], [0.0, 32.0]),
        ],
    ),
    Gear(
        "four bars: and back; efforts keep no power",
        FOUR_BAR,
        [
            ("velocity_to_actuator", [1.0, -0.25], [8.0, 0.0]),
            ("velocity_to_actuator", [0.0, 0.25], [0.0, 8.0]),
            ("position_to_actuator", [2.0, -1.25], [8.0, 0.0]),
            ("effort_to_actuator", [8.0, 0.0], [1.0, 1.0]),
            ("effort_to_actuator", [0.0, 32.0], [0.0, 1.0]),
        ],
    ),
    Gear(
        "four bars: NaN of the second stays with it",
        FOUR_BAR,
        [
            ("velocity_to_joint", [8.0, nan], [1.0, nan]),
            ("velocity_to_joint", [nan, 1.0], [nan, nan]),
            ("effort_to_actuator", [8.0, nan], [1.0, nan]),
        ],
    ),
    *(
        Gear(f"a reduction of {bad}", (kind, n, m, [0.0] * len(n), False), [])
        for bad in (0.0, -0.0, nan, inf, -inf)
        for kind, n, m in (
            ("simple", [bad], [1.0]),
            ("differential", [1.0, bad], [1.0, 1.0]),
            ("differential", [1.0, 1.0], [bad, 1.0]),
            ("four_bar", [bad, 1.0], [1.0, 1.0]),
            ("four_bar", [1.0, 1.0], [1.0, bad]),
        )
    ),
    Gear("an offset that is no number", ("simple", [1.0], [1.0], [nan], False), []),
    Gear("an infinite offset", ("four_bar", [1.0, 1.0], [1.0, 1.0], [0.0, inf], False), []),
    *(
        Gear("not two numbers each", (kind, n, m, [0.0, 0.0], False), [])
        for kind in ("differential", "four_bar")
        for n, m in (([1.0], [1.0, 1.0]), ([1.0, 1.0], [1.0]), ([1.0, 1.0, 1.0], [1.0, 1.0]))
    ),
]


class Description(NamedTuple):
    """``xml``: of a robot whose actuators a and b stand at 8 and 16 and take all three commands (c, at 4, only positions).

    ``parsed``: transmissions as name:joints/actuators. ``joints``: name, position, commands (p, v, e); None: it is not loaded.
    """

    why: str
    xml: str
    parsed: str
    joints: object

    def __str__(self) -> str:
        return self.why


def joint(name="j", *interfaces, inside=""):
    tags = "".join(
        f"<hardwareInterface>{name if '/' in name or not name else 'hardware_interface/' + name}</hardwareInterface>"
        for name in interfaces or ("EffortJointInterface",)
    )
    return f'<joint name="{name}">{inside}{tags}</joint>'


def actuator(name="a", reduction="4", role=""):
    return f'<actuator name="{name}"><role>{role}</role><mechanicalReduction>{reduction}</mechanicalReduction></actuator>'


def of(*inside, kind="Simple", name=' name="t"'):
    return f"<transmission{name}><type>transmission_interface/{kind}Transmission</type>{''.join(inside)}</transmission>"


def two(kind="Differential", roles=("joint2", "joint1", "actuator2", "actuator1"), inside=("", "")):
    return of(
        joint("k", inside=f"<role>{roles[0]}</role>{inside[0]}"),
        joint("j", inside=f"<role>{roles[1]}</role>{inside[1]}"),
        actuator("b", role=roles[2]),
        actuator("a", role=roles[3]),
        kind=kind,
    )


T = "t:j/a"
BOTH = "t:kj/ba"

DESCRIPTIONS = [
    Description("one joint", of(joint(), actuator()), T, "j 2 e"),
    Description("with an offset", of(joint(inside="<offset>0.5</offset>"), actuator()), T, "j 2.5 e"),
    Description(
        "a joint's own reduction is none of a simple one",
        of(joint(inside="<mechanicalReduction>9</mechanicalReduction>"), actuator()),
        T,
        "j 2 e",
    ),
    Description("not even when it is no number", of(joint(inside="<mechanicalReduction>x</mechanicalReduction>"), actuator()), T, "j 2 e"),
    Description("blanks round words", of(joint("j", " hardware_interface/EffortJointInterface\n"), actuator(reduction=" 4 ")), T, "j 2 e"),
    Description("a unit behind the number", of(joint(), actuator(reduction="4:1")), T, "j 2 e"),
    Description("several interfaces", of(joint("j", "PositionJointInterface", "VelocityJointInterface"), actuator()), T, "j 2 pv"),
    Description("both ways", of(joint("j", "BiDirectionalEffortJointInterface"), actuator()), T, "j 2 e"),
    Description("no more than its state", of(joint("j", "JointStateInterface"), actuator()), T, "j 2 "),
    Description("an unknown interface beside a known one", of(joint("j", "Foo", "EffortJointInterface"), actuator()), T, "j 2 e"),
    Description("unknown alone", of(joint("j", "Foo"), actuator()), T, None),
    *(
        Description(f"{written} is unknown", of(joint("j", written), actuator()), T, None)
        for written in ("other/EffortJointInterface", "/EffortJointInterface", "EffortJointInterfaces", "BiDirectionalJointStateInterface")
    ),
    Description(
        "an interface that the actuator lacks, beside one that it has",
        of(joint("j", "EffortJointInterface", "PositionJointInterface"), actuator("c")),
        "t:j/c",
        "j 1 p",
    ),
    Description("one that it lacks alone", of(joint("j", "EffortJointInterface"), actuator("c")), "t:j/c", None),
    Description("an actuator that is not there", of(joint(), actuator("z")), "t:j/z", None),
    *(
        Description(f"a reduction '{bad}'", of(joint(), actuator(reduction=bad)), T, None)
        for bad in ("", "fast", "0", "nan", "inf", "1e999")
    ),
    Description("no reduction", of(joint(), '<actuator name="a"/>'), T, None),
    *(
        Description(f"an offset '{bad}'", of(joint(inside=f"<offset>{bad}</offset>"), actuator()), T, None)
        for bad in ("", "far", "nan", "-inf")
    ),
    Description("two joints in a simple one", of(joint(), joint("k"), actuator()), "t:jk/a", None),
    Description("one joint in a differential", of(joint(), actuator(), kind="Differential"), T, None),
    Description("three actuators in a differential", two().replace("</type>", "</type>" + actuator("c")), "t:kj/cba", None),
    Description("a type that is not there", of(joint(), actuator(), kind="Magic"), T, None),
    Description("a differential, in the order of its roles", two(), BOTH, "j 3 e, k -1 e"),
    Description(
        "with reductions and offsets",
        two(inside=("<mechanicalReduction>2</mechanicalReduction>", "<offset>1</offset>")),
        BOTH,
        "j 4 e, k -0.5 e",
    ),
    Description("four bars, in the order of their roles", two("FourBarLinkage"), BOTH, "j 2 e, k 2 e"),
    *(
        Description(f"roles {' '.join(roles)}", two(kind, roles), BOTH, None)
        for kind in ("Differential", "FourBarLinkage")
        for roles in (
            ("joint1", "joint1", "actuator2", "actuator1"),
            ("joint2", "joint1", "actuator1", "actuator1"),
            ("", "joint1", "actuator2", "actuator1"),
            ("joint2", "joint1", "actuator2", "actuator3"),
            ("2", "1", "2", "1"),
        )
    ),
    Description("a joint's reduction that is no number", two(inside=("", "<mechanicalReduction>x</mechanicalReduction>")), BOTH, None),
    Description("a joint's reduction of 0", two(inside=("<mechanicalReduction>0</mechanicalReduction>", "")), BOTH, None),
    Description(
        "a mark of absolute encoders at one joint is none", two(inside=("<ignoreTransmissionAbsoluteEncoder/>", "")), BOTH, "j 3 e, k -1 e"
    ),
    Description("joints with other interfaces", two().replace("Effort", "Position", 1), BOTH, None),
    Description(
        "as many, but others",
        of(
            joint("j", "PositionJointInterface", "PositionJointInterface", inside="<role>joint1</role>"),
            joint("k", "PositionJointInterface", "EffortJointInterface", inside="<role>joint2</role>"),
            actuator("a", role="actuator1"),
            actuator("b", role="actuator2"),
            kind="Differential",
        ),
        "t:jk/ab",
        None,
    ),
    Description(
        "the same in another order",
        of(
            joint("j", "PositionJointInterface", "EffortJointInterface", inside="<role>joint1</role>"),
            joint("k", "EffortJointInterface", "PositionJointInterface", inside="<role>joint2</role>"),
            actuator("a", role="actuator1"),
            actuator("b", role="actuator2"),
            kind="Differential",
        ),
        "t:jk/ab",
        "j 3 pe, k -1 pe",
    ),
    Description("twice the same", 2 * of(joint(), actuator()), f"{T} {T}", "j 2 e"),
    Description("none at all", "", "", None),
    Description("no name", of(joint(), actuator(), name=""), "", None),
    Description("an empty name", of(joint(), actuator(), name=' name=""'), "", None),
    Description("no type", of(joint(), actuator()).replace("<type>transmission_interface/SimpleTransmission</type>", ""), "", None),
    Description("an empty type", of(joint(), actuator()).replace("transmission_interface/SimpleTransmission", " "), "", None),
    Description("a joint without interface, and another", of('<joint name="k"/>', joint(), actuator()), T, "j 2 e"),
    Description("a joint with an empty interface", of('<joint name="j"><hardwareInterface/></joint>', actuator()), "", None),
    Description("a joint with an empty name, and another", of(joint(""), joint(), actuator()), T, "j 2 e"),
    Description("a joint without a name takes the transmission with it", of("<joint/>", joint(), actuator()), "", None),
    Description("an actuator with an empty name, and another", of(joint(), actuator(""), actuator()), T, "j 2 e"),
    Description("an actuator without a name takes the transmission with it", of(joint(), "<actuator/>", actuator()), "", None),
    Description("no actuator", of(joint()), "", None),
    Description("a bad one beside a good one", of(joint("k")) + of(joint(), actuator()), T, "j 2 e"),
    Description("other elements", of("<robotNamespace>/arm</robotNamespace>", joint(), actuator()), T, "j 2 e"),
]
