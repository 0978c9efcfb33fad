"""Poses of models, lights and frames of a world that name a model or a frame (SDF 1.7, "Pose Frame Semantics")."""

import math

import pytest
from sdf_texts import finder, models, world

QUARTER = math.pi / 2
A = f'<model name="a"><static>1</static><pose>1 2 3 0 0 {QUARTER}</pose><link name="l"/></model>'
AHEAD_OF_A = (1.0, 3.0, 3.0)  # a looks along y


def standing(pose, name="b"):
    return f'<model name="{name}"><static>1</static>{pose}<link name="l"/></model>'


def places(body, finder):
    w, problems = world(body, finder, version="1.7")
    return {each.name: each.pose.p for each in (*w.models, *w.lights)}, [str(problem) for problem in problems]


@pytest.mark.parametrize(
    "body",
    [
        A + standing('<pose relative_to="a">1 0 0 0 0 0</pose>'),
        standing('<pose relative_to="a">1 0 0 0 0 0</pose>') + A,
        A + '<frame name="f" attached_to="a"/>' + standing('<pose relative_to="f">1 0 0 0 0 0</pose>'),
        A + '<frame name="f" attached_to="a"><pose>1 0 0 0 0 0</pose></frame>' + standing('<pose relative_to="f"/>'),
        standing('<pose relative_to="g"/>')
        + '<frame name="g"><pose relative_to="f">1 0 0 0 0 0</pose></frame>'
        + f'<frame name="f"><pose>1 2 3 0 0 {QUARTER}</pose></frame>',
        A + standing("<pose relative_to='a'>0 1 0 0 0 0</pose>", "c") + standing("<pose relative_to='c'>1 -1 0 0 0 0</pose>"),
        A + '<light name="b" type="point"><pose relative_to="a">1 0 0 0 0 0</pose></light>',
        f'<frame name="a"><pose>1 2 3 0 0 {QUARTER}</pose></frame>'
        '<light name="b" type="point"><pose relative_to="a">1 0 0 0 0 0</pose></light>',
        A + '<include><uri>model://box</uri><name>b</name><pose relative_to="a">1 0 0 0 0 0</pose></include>',
    ],
    ids=["model", "later", "attached", "attached_at", "frames", "chain", "light", "light_frame", "include"],
)
def test_what_a_pose_names(body, finder, models):
    models("box", f"<sdf version='1.7'>{standing('', 'box')}</sdf>")
    found, problems = places(body, finder)
    assert found["b"] == pytest.approx(AHEAD_OF_A) and not problems


@pytest.mark.parametrize(
    "body",
    [
        standing('<pose relative_to="lost">1 0 0 0 0 0</pose>'),
        '<light name="b" type="point"><pose relative_to="lost">1 0 0 0 0 0</pose></light>',
        '<frame name="f" attached_to="lost"><pose>1 0 0 0 0 0</pose></frame>' + standing('<pose relative_to="f"/>'),
    ],
    ids=["model", "light", "frame"],
)
def test_a_frame_that_is_not_there_is_told(body, finder):
    found, problems = places(body, finder)
    assert found["b"] == pytest.approx((1.0, 0.0, 0.0))
    assert len(problems) == 1 and "there is no frame 'lost'; using that of the world" in problems[0]


def test_a_circle_costs_nobody_else(finder):
    body = standing('<pose relative_to="c">1 0 0 0 0 0</pose>') + standing('<pose relative_to="b">0 1 0 0 0 0</pose>', "c") + A
    found, problems = places(body, finder)
    assert found["a"] == (1.0, 2.0, 3.0)
    assert found["b"] == (1.0, 0.0, 0.0) and found["c"] == (1.0, 1.0, 0.0)
    assert len(problems) == 1 and "refers to itself (b > c > b); it stands where its own numbers say" in problems[0]
