"""Actors: where the script has them at what time, what of them is in the world, and what broken files do."""

import json
import math
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from actor_files import BVH, WALK, actor, rig, world
from ode_sim.actors.animation import load_animation
from ode_sim.actors.script import Path, Script
from ode_sim.actors.skeleton import load_skeleton
from ode_sim.actors.skin import load_pieces
from ode_sim.actors.splines import PositionSpline, RotationSpline
from ode_sim.description import ResourceFinder, read_model
from ode_sim.description.model import ActorScript, DescriptionError, Pose, Trajectory, Waypoint
from ode_sim.description.sdf_writer import world_text
from ode_sim.math3 import quat_from_rpy
from ode_sim.mesh import load_surface, load_visual

FINDER = ResourceFinder(environment=False, package_path=lambda name: None)


@pytest.fixture
def skin(tmp_path):
    path = tmp_path / "walk.dae"
    path.write_text(rig())
    return str(path)


def load(*parts):
    loaded = ode_sim.World.load(finder=FINDER, source=world(*parts))
    assert not loaded.problems, [str(problem) for problem in loaded.problems]
    return loaded


def run_to(w, time):
    w.step(round((time - w.time) / w.dt))


def place(w, link="walker_pose"):
    return np.array(w.find_link(link).pose.p)


# ---------------------------------------------------------------------------------------------- curves, as ignition-math 6 has them

#: Of the points below at the middle third: closed, tension, index, parameter, x y z, qx qy qz qw; printed by ignition-math 6.10.
KNOWN = [
    (0, 0, 0, 0.35, 0.236250000, 0.671562500, 0.177843750, -0.011835647, 0.040048338, 0.202281567, 0.978436618),
    (0, 0, 1, 0.35, 1.745500000, 1.911625000, 0.339218750, 0.014276482, 0.151240150, 0.891430578, 0.426935737),
    (0, 0, 2, 0.35, 2.752375000, 0.334125000, 0.318718750, 0.165045388, 0.213248444, 0.754133989, -0.598804682),
    (0, 0, 3, 0.35, 2.557812500, -1.463750000, 0.758062500, -0.029451551, -0.042198201, -0.915985825, 0.397896830),
    (0, 0.4, 0, 0.35, 0.254450000, 0.628337500, 0.163056250, -0.011835647, 0.040048338, 0.202281567, 0.978436618),
    (0, 0.4, 1, 0.35, 1.672700000, 1.834275000, 0.347181250, 0.014276482, 0.151240150, 0.891430578, 0.426935737),
    (0, 0.4, 2, 0.35, 2.738725000, 0.375075000, 0.303931250, 0.165045388, 0.213248444, 0.754133989, -0.598804682),
    (0, 0.4, 3, 0.35, 2.560087500, -1.390950000, 0.742137500, -0.029451551, -0.042198201, -0.915985825, 0.397896830),
    (1, 0, 0, 0.35, 0.088375000, 0.745500000, 0.103906250, 0.002691835, 0.058681236, 0.287549623, 0.955962594),
    (1, 0, 1, 0.35, 1.745500000, 1.911625000, 0.339218750, 0.014276482, 0.151240150, 0.891430578, 0.426935737),
    (1, 0, 2, 0.35, 2.911625000, 0.254500000, 0.318718750, 0.159816133, 0.207803909, 0.767377597, -0.585156357),
    (1, 0, 3, 0.35, 1.254500000, -0.911625000, 0.738156250, -0.006165109, -0.026054995, -0.856725907, 0.515076546),
    (1, 0.4, 0, 0.35, 0.165725000, 0.672700000, 0.118693750, 0.002691835, 0.058681236, 0.287549623, 0.955962594),
    (1, 0.4, 1, 0.35, 1.672700000, 1.834275000, 0.347181250, 0.014276482, 0.151240150, 0.891430578, 0.426935737),
    (1, 0.4, 2, 0.35, 2.834275000, 0.327300000, 0.303931250, 0.159816133, 0.207803909, 0.767377597, -0.585156357),
    (1, 0.4, 3, 0.35, 1.327300000, -0.834275000, 0.730193750, -0.006165109, -0.026054995, -0.856725907, 0.515076546),
]
POINTS = [(0.0, 0.0, 0.0), (1.0, 2.0, 0.5), (3.0, 1.0, 0.0), (2.0, -1.0, 1.0)]
ANGLES = [(0, 0, 0), (0.1, 0.2, 1.5), (0, 0, 3.0), (0.3, -0.4, -2.5)]


@pytest.mark.parametrize("closed, tension, index, t, known", [(*row[:4], row[4:]) for row in KNOWN])
def test_curves_are_those_of_the_original(closed, tension, index, t, known):
    points = POINTS + [(0.0, 0.0, 0.0) if closed else (4.0, -2.0, 0.0)]
    turns = [quat_from_rpy(*angles) for angles in ANGLES + [(0, 0, 0.0 if closed else -1.0)]]
    assert PositionSpline(points, tension).at(index, t) == pytest.approx(known[:3], abs=1e-8)
    assert abs(np.dot(RotationSpline(turns).at(index, t), known[3:])) == pytest.approx(1.0, abs=1e-8)


# ---------------------------------------------------------------------------------------------- scripts


def script(*trajectories, **rest):
    return Script(ActorScript(trajectories=trajectories, **rest), {"walk": 2.0, "wave": 3.0})


def straight(number, start, end, duration, kind="walk"):
    return Trajectory(number, kind, (Waypoint(0.0, Pose((start, 0.0, 0.0))), Waypoint(duration, Pose((end, 0.0, 0.0)))), tension=1.0)


def at(played, seconds):
    moment = played.moment(round(seconds * 1e9))
    return moment.clip.id, round(moment.time, 9), moment.round


def test_trajectories_follow_one_another_by_their_ids():
    played = script(straight(5, 1, 2, 4.0), straight(1, 0, 1, 2.0))
    assert [at(played, s) for s in (0.0, 1.5, 2.0, 2.5)] == [(1, 0.0, 0), (1, 1.5, 0), (1, 2.0, 0), (5, 0.5, 0)]


def test_it_loops_and_waits_anew_in_every_round():
    played = script(straight(0, 0, 1, 4.0), delay_start=1.0)
    assert [at(played, s) for s in (0.0, 0.9, 1.5, 4.9, 5.5, 6.5, 16.5)] == [
        (0, 0.0, 0),
        (0, 0.0, 0),
        (0, 0.5, 0),
        (0, 3.9, 0),
        (0, 0.0, 1),
        (0, 0.5, 1),
        (0, 0.5, 3),
    ]


def test_what_does_not_loop_stays_at_its_end():
    played = script(straight(0, 0, 1, 4.0), loop=False)
    assert at(played, 3.0) == (0, 3.0, 0) and at(played, 4.0) == at(played, 400.0) == (0, 4.0, 0)


def test_without_trajectories_the_first_animation_by_name_is_played_and_a_trajectory_without_points_lasts_as_long_as_its_own():
    assert at(script(), 1.5) == (0, 1.5, 0) and script().length == 2.0
    assert script(Trajectory(0, "wave"), straight(1, 0, 1, 1.0)).length == 4.0


def test_one_point_alone_is_where_it_stands():
    played = script(Trajectory(0, "walk", (Waypoint(0.0, Pose((3.0, 0.0, 0.0))),)))
    assert at(played, 77.0) == (0, 0.0, 0) and played.clips[0].path.pose(0.0).p == (3.0, 0.0, 0.0)


def test_the_first_point_counts_from_0_and_of_two_at_a_time_the_later():
    path = Path((Waypoint(1.0, Pose((1.0, 0.0, 0.0))), Waypoint(3.0, Pose((9.0, 9.0, 9.0))), Waypoint(3.0, Pose((3.0, 0.0, 0.0)))), 1.0)
    assert path.duration == 3.0 and path.pose(0.0).p == (1.0, 0.0, 0.0) and path.pose(3.0).p == (3.0, 0.0, 0.0)
    assert path.walked(3.0) == pytest.approx(2.0)


def test_a_loop_of_one_trajectory_walks_on():
    played = script(straight(0, 0, 3, 3.0))
    walked = [played.walked(played.moment(round(s * 1e9))) for s in (0.0, 3.0, 3.5, 7.5)]
    assert walked[0] == 0.0 and walked[2] - walked[0] > 6.0 and walked == sorted(walked)
    assert walked[3] - walked[2] > 6.0


# ---------------------------------------------------------------------------------------------- files


@pytest.mark.parametrize("unit", [1.0, 0.01])
def test_bones_rest_and_move_as_the_file_says(tmp_path, unit):
    path = tmp_path / "walk.dae"
    path.write_text(rig(unit=unit))
    skeleton, animation = load_skeleton(str(path)), load_animation(str(path))
    assert [bone.name for bone in skeleton.bones] == ["hips", "arm"]
    assert skeleton.model_frames()[:, 2, 3] == pytest.approx([1.0, 1.5])
    places, turns = animation.pose_at(0.5)
    assert places[0] == pytest.approx([0.25, 0.0, 1.05]) and places[1] == pytest.approx([0.0, 0.0, 0.5])
    assert turns[1] == pytest.approx(quat_from_rpy(0.0, math.radians(22.5), 0.0))
    assert animation.pose_at(2.5)[0] == pytest.approx(places) and animation.length == 2.0
    assert animation.time_at(0.25) == pytest.approx(0.5) and animation.time_at(2.25) == pytest.approx(0.5)


@pytest.mark.parametrize("unit", [1.0, 0.01])
def test_a_skin_of_a_plain_mesh_is_there_as_it_was_bound(tmp_path, unit):
    path = tmp_path / "person.dae"
    shifted = rig(unit=unit).replace("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</bind", f"1 0 0 {3 / unit} 0 1 0 0 0 0 1 0 0 0 0 1</bind")
    path.write_text(shifted)
    parts = load_visual(str(path))
    corners = np.concatenate([part.vertices for part in parts])
    assert corners.min(axis=0) == pytest.approx([3.0, 0.0, 1.0]) and corners.max(axis=0) == pytest.approx([3.2, 0.2, 1.7])
    assert {part.material.diffuse for part in parts} == {(1.0, 0.0, 0.0, 1.0)}
    assert len(load_surface(str(path)).triangles) == len(load_surface(str(path), submesh="it").triangles) == 8
    path.write_text(shifted.replace('url="#skin-of-it"', 'url="#nothing"'))
    with pytest.raises(DescriptionError, match="person.dae: holds no triangles"):
        load_surface(str(path))


def test_a_skin_is_cut_into_one_piece_for_each_bone_in_its_frame(skin):
    pieces = load_pieces(skin)
    assert set(pieces) == {"hips", "arm"}
    for parts in pieces.values():
        assert [part.material.diffuse for part in parts] == [(1.0, 0.0, 0.0, 1.0)]
        assert np.concatenate([part.vertices for part in parts]).max(axis=0) == pytest.approx([0.2, 0.2, 0.2])
    bent = load_pieces(skin, skin)
    assert np.concatenate([part.vertices for part in bent["arm"]]).max(axis=0) == pytest.approx([0.2, 0.2, 0.2])


BROKEN = {
    "no skin": (rig().replace("instance_controller", "instance_nothing"), "no skin on a skeleton"),
    "no bone of a joint": (rig(joints="hips leg"), "'leg'"),
    "one joint only": (rig(joints="hips"), "bind matrices"),
    "a weight of no joint": (rig(v="0 0 0 0 0 0 0 0 1 0 1 0 1 0 7 0"), "weight"),
    "weights that end": (rig(v="0 0 0 0"), "do not fit"),
    "no number": (rig().replace("<v>0", "<v>nan"), "no finite number"),
    "cut off": (rig()[:2000], "broken"),
    "entities": (rig().replace('<?xml version="1.0"?>', '<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "a">]>'), "entit"),
    "a flat bind matrix": (rig().replace("1 0 0 0 0 1 0 0 0 0 1 -1.0 0 0 0 1", "0 0 0 0 0 1 0 0 0 0 1 -1.0 0 0 0 1"), "inverted"),
    "no file": (None, "cannot find"),
}


@pytest.mark.parametrize("text, reason", BROKEN.values(), ids=BROKEN)
def test_a_broken_skin_is_one_line_and_the_rest_of_the_world_is_there(tmp_path, text, reason):
    path = tmp_path / "walk.dae"
    if text is not None:
        path.write_text(text)
    w = ode_sim.World.load(finder=FINDER, source=world(actor(str(path)), '<model name="rock"><link name="l"/></model>'))
    lines = [str(problem) for problem in w.problems]
    assert len(lines) == 1 and reason in lines[0] and "walker" in lines[0] + str(path) and "\n" not in lines[0]
    assert list(w.models) == ["walker", "rock"]
    w.step(1000)
    assert w.models["walker"].pose.p[:2] == pytest.approx((1.0, 2.0), abs=0.4)  # it goes its way, unseen


def test_times_without_end_and_frames_without_number_are_refused(tmp_path):
    path = tmp_path / "walk.dae"
    for old, new, reason in (
        ("0 1 2</float_array>", "0 1 1e300</float_array>", "no clock"),
        ("0 90</float_array>", "0 90 5</float_array>", "3 values"),
    ):
        path.write_text(rig().replace(old, new))
        with pytest.raises(DescriptionError, match=reason):
            load_animation(str(path))


def test_motion_capture_is_played_in_the_bones_of_the_skin(tmp_path, skin):
    path = tmp_path / "wave.bvh"
    path.write_text(BVH)
    w = load(actor(skin, animation=f'<animation name="walk"><filename>{path}</filename></animation>'))
    run_to(w, 0.5)
    assert place(w)[2] == 0.0  # the path alone says where it is
    arm = w.find_link("arm").pose
    assert np.subtract(arm.p, place(w)) == pytest.approx([0.0, 0.0, 0.5])
    assert arm.q == pytest.approx(quat_from_rpy(0.0, math.radians(45.0), 0.0), abs=0.02)


@pytest.mark.parametrize(
    "old, new, reason",
    [
        ("HIERARCHY", "", "does not begin"),
        ("MOTION", "", "no MOTION"),
        ("Frames: 3", "Frames: 0", "0 usable frames"),
        ("0.5", "1e9", "nothing to play"),
        ("5 6 7 0 0 0 0 90 0", "5 6 7 0 0 0 0 nan 0", "none"),
        ("  JOINT arm\n  {\n    OFFSET", "  JOINT less\n  {\n OFFSET 0 0 1\n CHANNELS 0\n JOINT arm\n  {\n    OFFSET", "is not that of"),
        ("CHANNELS 3 Zrotation Yrotation Xrotation", "", "without CHANNELS"),
        ("  End Site", "  JOINT more", "without CHANNELS"),
    ],
)
def test_broken_motion_capture_is_one_line(tmp_path, skin, old, new, reason):
    path = tmp_path / "wave.bvh"
    path.write_text(BVH.replace(old, new, 1))
    animation = f'<animation name="walk"><filename>{path}</filename></animation>'
    w = ode_sim.World.load(finder=FINDER, source=world(actor(skin, animation=animation)))
    assert len(w.problems) == 1 and reason in str(w.problems[0]) and str(path) in str(w.problems[0])
    w.step(100)


def test_an_animation_of_another_skeleton_is_left_out_by_name(tmp_path, skin):
    other = tmp_path / "other.dae"
    other.write_text(rig().replace('<node id="arm-id"', '<node id="more" name="more" sid="more" type="JOINT"/><node id="arm-id"'))
    animation = f'<animation name="walk"><filename>{other}</filename></animation>'
    w = ode_sim.World.load(finder=FINDER, source=world(actor(skin, animation=animation)))
    assert len(w.problems) == 1 and "'walk'" in str(w.problems[0]) and str(other) in str(w.problems[0])
    w.step(1)
    assert w.models["walker"].pose.p == pytest.approx((0.0, 2.0, 0.0), abs=0.01)


# ---------------------------------------------------------------------------------------------- in the world


def test_it_is_where_the_script_has_it_with_its_bones(skin):
    w = load(actor(skin))
    assert list(w.models["walker"].links) == ["walker_pose", "hips", "arm"]
    for time in (0.001, 0.5, 1.7, 3.9, 4.2, 9.0):
        run_to(w, time)
        shown = math.floor(round(time, 6) * 30) / 30 % 4.0
        x = Path((Waypoint(0.0, Pose((0.0, 2.0, 0.0))), Waypoint(4.0, Pose((4.0, 2.0, 0.0))))).pose(shown).p[0]
        assert place(w)[:2] == pytest.approx([x, 2.0], abs=1e-6)
        assert 1.0 <= place(w)[2] <= 1.1 and place(w) == pytest.approx(place(w, "hips"))
    arm = w.find_link("arm").pose
    assert np.linalg.norm(np.subtract(arm.p, place(w))) == pytest.approx(0.5)


def test_with_the_way_the_animation_goes_on_and_without_with_time(skin):
    by_time = f'<animation name="walk"><filename>{skin}</filename></animation>'
    w = load(actor(skin), actor(skin, animation=by_time, name="other"))
    run_to(w, 1.0)
    bends = [2.0 * math.asin(w.models[name].links["arm"].pose.q[1]) for name in ("walker", "other")]
    walked = w.models["walker"].pose.p[0]
    assert bends == pytest.approx([math.radians(90.0) * walked, math.radians(45.0)], abs=0.03)


def test_without_trajectories_it_goes_where_the_animation_goes(skin):
    w = load(actor(skin, script="<loop>false</loop>"))
    run_to(w, 1.0)
    assert place(w) == pytest.approx([0.5, 0.0, 1.1], abs=0.02)
    run_to(w, 5.0)
    assert place(w) == pytest.approx([1.0, 0.0, 1.0], abs=1e-6)


def test_a_scaled_skin_scales_bones_and_way(skin):
    w = load(actor(skin, scale=0.5))
    run_to(w, 2.0)
    assert place(w)[:2] == pytest.approx([1.0, 1.0], abs=0.02)
    assert np.linalg.norm(np.subtract(place(w, "arm"), place(w))) == pytest.approx(0.25)


def test_boxes_move_as_their_actor_without_any_skin():
    w = load(
        '<actor name="walker"><link name="box"><collision name="c"><geometry><box><size>.2 .2 .2</size></box></geometry>'
        f"</collision></link><script>{WALK}</script></actor>"
    )
    run_to(w, 2.0)
    assert place(w, "box") == pytest.approx([2.0, 2.0, 0.0], abs=0.05)


def test_a_snapshot_whose_actors_are_damaged_changes_nothing(skin):
    w = load(actor(skin))
    early = w.save()
    run_to(w, 1.0)
    now = bytes(w.save())
    for damaged in ("[]", "[[1, 2]]", '[["x", true, 0, null, 0.0, false]]', "[null]"):
        kept = json.loads(early.generators)
        kept["actors"] = json.loads(damaged)
        with pytest.raises(ValueError, match="its random numbers or actors are damaged"):
            w.restore(replace(early, generators=json.dumps(kept).encode()))
        assert bytes(w.save()) == now, damaged


def test_the_same_bits_in_every_run_after_a_reset_and_after_going_back(skin):
    def states(w):
        found = []
        for _ in range(5):
            w.step(177)
            found.append(bytes(w.save()))
        return found

    first, second = load(actor(skin)), load(actor(skin))
    known = states(first)
    assert states(second) == known
    first.reset()
    assert states(first) == known
    run_to(first, 2.0)
    kept = first.save()
    ahead = states(first)
    first.restore(kept)
    assert states(first) == ahead
    second.restore(kept)
    assert states(second) == ahead


def test_a_reset_of_poses_begins_the_script_anew_and_one_of_time_does_not(skin):
    w = load(actor(skin))
    run_to(w, 2.0)
    before = place(w)
    w.reset_time()
    w.step(10)
    assert w.time == pytest.approx(0.01) and place(w) == pytest.approx(before, abs=0.05)
    w.reset_poses()
    assert place(w) == pytest.approx([0.0, 2.0, 1.0])  # at once, as while paused nothing else shows it
    w.step(10)
    assert place(w)[0] == pytest.approx(0.0, abs=0.05)


def test_it_comes_and_goes_while_the_world_runs(skin):
    w = load()
    w.step(1000)
    model, problems = read_model(f'<sdf version="1.6">{actor(skin)}</sdf>', finder=FINDER)
    assert not problems
    w.spawn(model)
    w.step(500)
    assert place(w)[0] == pytest.approx(Path(model.actor.script.trajectories[0].waypoints).pose(0.5).p[0], abs=0.05)
    w.remove("walker")
    w.step(10)
    assert not w.models and not w.actors


def test_it_waits_where_it_begins(skin):
    w = load(
        actor(skin, script=f"<delay_start>1</delay_start>{WALK}"), actor(skin, script=f"<auto_start>false</auto_start>{WALK}", name="idle")
    )
    run_to(w, 0.9)
    assert place(w) == pytest.approx([0.0, 2.0, 1.0]) and w.models["idle"].links["hips"].pose.p == pytest.approx((7.0, 7.0, 7.0))
    run_to(w, 3.0)
    assert place(w)[0] > 1.0 and w.models["idle"].links["hips"].pose.p == pytest.approx((7.0, 7.0, 7.0))


BALL = """<model name="ball"><pose>1 2 1.05 0 0 0</pose><link name="l"><gravity>0</gravity><inertial><mass>0.1</mass></inertial>
<collision name="c"><geometry><sphere><radius>0.2</radius></sphere></geometry></collision></link></model>"""


def test_rays_see_its_skin_and_nothing_feels_it(skin):
    w = load(actor(skin), BALL)
    run_to(w, 0.2)
    ranges, hits = w.cast_rays([(-3.0, 2.02, 1.05)], [(1.0, 0.0, 0.0)], 10.0)
    assert ranges[0] == pytest.approx(3.0 + place(w)[0], abs=0.1) and w.collision(hits[0]).name == "hips_skin"
    run_to(w, 3.0)
    assert w.models["ball"].pose.p == pytest.approx((1.0, 2.0, 1.05))


def test_what_was_let_collide_pushes(skin):
    extra = '<link name="belly"><collision name="c"><geometry><sphere><radius>0.3</radius></sphere></geometry></collision></link>'
    w = load(actor(skin, extra=extra), BALL)
    w.actors["walker"].let_collide()
    run_to(w, 1.5)
    ball = w.models["ball"].pose.p
    assert ball[0] > place(w)[0] + 0.3 and ball[0] < 6.0
    w.reset()
    run_to(w, 0.9)  # just before they touch
    kept = w.save()
    w.step(300)
    ahead = bytes(w.save())
    w.restore(kept)
    w.step(300)
    assert bytes(w.save()) == ahead and w.models["ball"].pose.p[0] > 1.05


def test_a_saved_world_has_the_actor_again(skin):
    from ode_sim_viewer.saving import describe_now

    w = load(actor(skin))
    run_to(w, 1.0)
    again = ode_sim.World.load(finder=FINDER, source=world_text(describe_now(w)))
    assert not again.problems and list(again.models["walker"].links) == ["walker_pose", "hips", "arm"]
    again.step(1000)
    assert again.models["walker"].pose.p[0] > 0.5


def test_it_travels_to_other_processes_whole(skin):
    from ode_sim.description import exchange

    description = load(actor(skin)).models["walker"].description
    assert exchange.loads(exchange.dumps(description)).actor == description.actor


def test_scales_that_lead_too_far_are_one_line(skin):
    animation = f'<animation name="walk"><filename>{skin}</filename><scale>1e6</scale></animation>'
    w = load(actor(skin, animation=animation, scale=1e6))
    w.step(1000)
    assert [line for line in w.messages if "walker" in line and "stays where it is" in line] == w.messages and len(w.messages) == 1
