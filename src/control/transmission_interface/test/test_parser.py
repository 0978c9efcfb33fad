"""<transmission> elements, good and bad."""

import re

import pytest
from transmission_interface import TransmissionError, parse_transmissions

JOINT = '<joint name="j"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>'
ACTUATOR = '<actuator name="a"><mechanicalReduction>50</mechanicalReduction></actuator>'


def robot(*transmissions):
    return f"<robot name='r'><link name='l'/>{''.join(transmissions)}</robot>"


def transmission(inside, attributes='name="t"'):
    return f"<transmission {attributes}>{inside}</transmission>"


GOOD = transmission("<type> transmission_interface/SimpleTransmission </type>" + JOINT + ACTUATOR)


def test_good():
    infos, problems = parse_transmissions(robot(GOOD))
    assert problems == []
    (info,) = infos
    assert (info.name, info.type) == ("t", "transmission_interface/SimpleTransmission")
    assert info.joints[0].name == "j"
    assert info.joints[0].hardware_interfaces == ("hardware_interface/EffortJointInterface",)
    assert info.actuators[0].name == "a" and info.actuators[0].hardware_interfaces == ()


def test_several_interfaces_and_roles():
    joint = (
        '<joint name="j"><role>joint1</role><hardwareInterface>A</hardwareInterface><hardwareInterface>\n B </hardwareInterface></joint>'
    )
    (info,) = parse_transmissions(robot(transmission("<type>T</type>" + joint + ACTUATOR)))[0]
    assert info.joints[0].hardware_interfaces == ("A", "B") and info.joints[0].role == "joint1"


@pytest.mark.parametrize(
    "bad, says",
    [
        (transmission("<type>T</type>" + JOINT + ACTUATOR, ""), "number 2.*has no name"),
        (transmission("<type>T</type>" + JOINT + ACTUATOR, 'name=""'), "has no name"),
        (transmission(JOINT + ACTUATOR), "'t'.*no <type>"),
        (transmission("<type> </type>" + JOINT + ACTUATOR), "no <type>"),
        (transmission("<type>T</type>" + ACTUATOR), "no usable <joint>"),
        (transmission("<type>T</type>" + JOINT), "no <actuator"),
        (transmission("<type>T</type><joint/>" + JOINT + ACTUATOR), "<joint> in it has no name"),
        (transmission("<type>T</type>" + JOINT + "<actuator/>"), "<actuator> in it has no name"),
        (transmission('<type>T</type><joint name="k"/>' + ACTUATOR), "joint 'k'.*no <hardwareInterface>"),
        (
            transmission('<type>T</type><joint name="k"/><actuator name="a"><hardwareInterface>E</hardwareInterface></actuator>'),
            "belongs into <joint>",
        ),
    ],
)
def test_a_bad_one_is_left_out_and_named(bad, says):
    infos, problems = parse_transmissions(robot(GOOD, bad))
    assert [info.name for info in infos] == ["t"]
    assert len(infos[0].joints) == 1
    assert any(re.search(says, problem) for problem in problems), problems


def test_a_bad_joint_leaves_the_others():
    infos, problems = parse_transmissions(robot(transmission('<type>T</type><joint name="k"/>' + JOINT + ACTUATOR)))
    assert [joint.name for joint in infos[0].joints] == ["j"]
    assert len(problems) == 1


def test_foreign_elements_are_ignored():
    infos, problems = parse_transmissions(robot(transmission("<robotNamespace>/arm</robotNamespace><type>T</type>" + JOINT + ACTUATOR)))
    assert len(infos) == 1 and not problems


def test_no_xml():
    with pytest.raises(TransmissionError, match="no valid XML"):
        parse_transmissions("<robot>")
