import motion
from moveit_setup_assistant import collisions
from robots import FIVE, joint, link, robot


def reasons(urdf, **options):
    return collisions.compute_disabled(motion.load_model(urdf), **options)


def test_links_around_one_without_geometry_are_adjacent():
    found = reasons(FIVE, trials=200)
    assert found[("base", "column")] == "Adjacent"
    assert found[("column", "inside")] == "Adjacent" and found[("column", "far")] == "Adjacent"
    assert not any("bare" in pair or "stand" in pair for pair in found)


def test_what_touches_at_the_start_is_default_and_comes_first():
    assert reasons(FIVE, trials=200)[("base", "inside")] == "Default"


def test_what_nearly_always_touches_is_always():
    # At 0 the slider is outside, as soon as it moves it is inside: the default state is free, all others are not.
    urdf = robot(
        link("base", "0.2 0.2 0.2"),
        link("mid", "0.01 0.01 0.01"),
        link("block", "0.2 0.2 0.2"),
        joint("slide", "base", "mid", "0.2005 0.0 0", "prismatic", "-1 0 0", 'lower="0" upper="0.1"'),
        joint("next", "mid", "block", "0 0 0", "fixed"),
    )
    found = reasons(urdf, find_never=False)
    assert found[("base", "block")] == "Always"
    assert reasons(urdf, find_never=False, always_fraction=1.0).get(("base", "block")) is None, "200 of 200 is not more than 200"


def test_what_never_touches_is_never_and_what_may_is_checked():
    found = reasons(FIVE, trials=2000)
    assert found[("base", "far")] == "Never" and found[("far", "inside")] == "Never"
    model = motion.load_model(FIVE)
    table = {(one, other): reason for one, other, reason in collisions.collision_table(model, found)}
    assert len(table) == 10, "five links with geometry"
    assert table[("column", "swing")] == "" and ("column", "swing") not in found


def test_links_joined_to_the_swing_are_adjacent_through_the_stand():
    assert reasons(FIVE, trials=1)[("far", "swing")] == "Adjacent"


def test_the_same_seed_gives_the_same_matrix():
    assert reasons(FIVE, trials=300, seed=7) == reasons(FIVE, trials=300, seed=7)


def test_a_stopped_search_gives_nothing():
    assert reasons(FIVE, trials=5000, progress=lambda fraction: fraction < 0.1) == {}
