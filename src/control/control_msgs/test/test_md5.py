"""The types must be those that compiled tools of Noetic speak: same MD5 sums."""

from control_msgs import msg, srv

MESSAGES = {
    "GripperCommand": "680acaff79486f017132a7f198d40f08",
    "JointControllerState": "987ad85e4756f3aef7f1e5e7fe0595d1",
    "JointJog": "1685da700c8c2e1254afc92a5fb89c96",
    "JointTolerance": "f544fe9c16cf04547e135dd6063ff5be",
    "JointTrajectoryControllerState": "10817c60c2486ef6b33e97dcd87f4474",
    "PidState": "b138ec00e886c10e73f27e8712252ea6",
    "FollowJointTrajectoryAction": "bc4f9b743838566551c0390c65f1a248",
    "GripperCommandAction": "950b2a6ebe831f5d4f4ceaba3d8be01e",
    "JointTrajectoryAction": "a04ba3ee8f6a2d0985a6aeaf23d9d7ad",
    "PointHeadAction": "7252920f1243de1b741f14f214125371",
    "SingleJointPositionAction": "c4a786b7d53e5d0983decf967a5a779e",
    "FollowJointTrajectoryActionGoal": "cff5c1d533bf2f82dd0138d57f4304bb",
    "GripperCommandActionGoal": "aa581f648a35ed681db2ec0bf7a82bea",
    "JointTrajectoryActionGoal": "a99e83ef6185f9fdd7693efe99623a86",
    "PointHeadActionGoal": "b53a8323d0ba7b310ba17a2d3a82a6b8",
    "SingleJointPositionActionGoal": "4b0d3d091471663e17749c1d0db90f61",
    "FollowJointTrajectoryActionResult": "c4fb3b000dc9da4fd99699380efcc5d9",
    "GripperCommandActionResult": "143702cb2df0f163c5283cedc5efc6b6",
    "JointTrajectoryActionResult": "1eb06eeff08fa7ea874431638cb52332",
    "PointHeadActionResult": "1eb06eeff08fa7ea874431638cb52332",
    "SingleJointPositionActionResult": "1eb06eeff08fa7ea874431638cb52332",
    "FollowJointTrajectoryActionFeedback": "d8920dc4eae9fc107e00999cce4be641",
    "GripperCommandActionFeedback": "653dff30c045f5e6ff3feb3409f4558d",
    "JointTrajectoryActionFeedback": "aae20e09065c3809e8a8e87c4c8953fd",
    "PointHeadActionFeedback": "33c9244957176bbba97dd641119e8460",
    "SingleJointPositionActionFeedback": "3503b7cf8972f90d245850a5d8796cfa",
    "FollowJointTrajectoryGoal": "69636787b6ecbde4d61d711979bc7ecb",
    "GripperCommandGoal": "86fd82f4ddc48a4cb6856cfa69217e43",
    "JointTrajectoryGoal": "2a0eff76c870e8595636c2a562ca298e",
    "PointHeadGoal": "8b92b1cd5e06c8a94c917dc3209a4c1d",
    "SingleJointPositionGoal": "fbaaa562a23a013fd5053e5f72cbb35c",
    "FollowJointTrajectoryResult": "493383b18409bfb604b4e26c676401d2",
    "GripperCommandResult": "e4cbff56d3562bcf113da5a5adeef91f",
    "JointTrajectoryResult": "d41d8cd98f00b204e9800998ecf8427e",
    "PointHeadResult": "d41d8cd98f00b204e9800998ecf8427e",
    "SingleJointPositionResult": "d41d8cd98f00b204e9800998ecf8427e",
    "FollowJointTrajectoryFeedback": "10817c60c2486ef6b33e97dcd87f4474",
    "GripperCommandFeedback": "e4cbff56d3562bcf113da5a5adeef91f",
    "JointTrajectoryFeedback": "d41d8cd98f00b204e9800998ecf8427e",
    "PointHeadFeedback": "cce80d27fd763682da8805a73316cab4",
    "SingleJointPositionFeedback": "8cee65610a3d08e0a1bded82f146f1fd",
}
SERVICES = {
    "QueryCalibrationState": "28af3beedcb84986b8e470dc5470507d",
    "QueryCalibrationStateRequest": "d41d8cd98f00b204e9800998ecf8427e",
    "QueryCalibrationStateResponse": "28af3beedcb84986b8e470dc5470507d",
    "QueryTrajectoryState": "ec93cdecbd8062d761aa52b7c90cd44b",
    "QueryTrajectoryStateRequest": "556a4fb76023a469987922359d08a844",
    "QueryTrajectoryStateResponse": "1f1a6554ad060f44d013e71868403c1a",
}


def test_sums():
    assert {name: getattr(msg, name)._md5sum for name in MESSAGES} == MESSAGES
    assert {name: getattr(srv, name)._md5sum for name in SERVICES} == SERVICES


def test_error_codes():
    result = msg.FollowJointTrajectoryResult
    assert [
        result.SUCCESSFUL,
        result.INVALID_GOAL,
        result.INVALID_JOINTS,
        result.OLD_HEADER_TIMESTAMP,
        result.PATH_TOLERANCE_VIOLATED,
        result.GOAL_TOLERANCE_VIOLATED,
    ] == [0, -1, -2, -3, -4, -5]
