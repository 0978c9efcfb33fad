"""The pipeline as packages of MoveIt's assistant of 2021 include it."""

import subprocess

import yaml

INCLUDED_AS_GENERATED = """<launch><group ns="move_group/planning_pipelines">
<include ns="pilz_industrial_motion_planner" file="$(find moveit_resources_prbt_moveit_config)/launch/planning_pipeline.launch.xml">
<arg name="pipeline" value="pilz_industrial_motion_planner"/></include></group></launch>"""


def test_the_pipeline_is_included(tmp_path):
    launch = tmp_path / "move_group.launch"
    launch.write_text(INCLUDED_AS_GENERATED)
    said = subprocess.run(["roslaunch", "--dump-params", str(launch)], capture_output=True, text=True, timeout=60, check=True)
    parameters = yaml.safe_load(said.stdout)
    pipeline = "/move_group/planning_pipelines/pilz_industrial_motion_planner/"
    assert parameters[pipeline + "planning_plugin"] == "pilz_industrial_motion_planner::CommandPlanner"
    assert parameters[pipeline + "capabilities"].split() == [
        "pilz_industrial_motion_planner/MoveGroupSequenceAction",
        "pilz_industrial_motion_planner/MoveGroupSequenceService",
    ]
    assert parameters[pipeline + "request_adapters"] == "default_planner_request_adapters/ResolveConstraintFrames"
