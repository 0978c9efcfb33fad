"""What RViz's tab Manipulation asks for: the things on the table come into the planning scene (action ``recognize_objects``, of
the simulator, which knows them), and a block is gripped from above (service ``plan_grasps``)."""

import actionlib
import node_signals
import rospy
from moveit_commander import PlanningSceneInterface
from moveit_msgs.msg import MoveItErrorCodes
from moveit_msgs.srv import GraspPlanning, GraspPlanningResponse
from object_recognition_msgs.msg import ObjectRecognitionAction, ObjectRecognitionResult, RecognizedObject

from myur5_pick_place import table


def plan_grasps(request):
    target = request.target
    found = []
    if len(target.primitives) == 1 and target.primitives[0].type == target.primitives[0].BOX:
        found = table.grasps(target.pose, target.primitives[0].dimensions)
    if not found:
        rospy.logwarn(f"no grasp for '{target.id}': the gripper holds one upright box of at most {100 * table.WIDEST:g} cm")
    code = MoveItErrorCodes.SUCCESS if found else MoveItErrorCodes.FAILURE
    return GraspPlanningResponse(grasps=found, error_code=MoveItErrorCodes(code))


class Recognizer:
    def __init__(self):
        self._scene = PlanningSceneInterface(synchronous=True)
        self._server = actionlib.SimpleActionServer("recognize_objects", ObjectRecognitionAction, self._recognize, auto_start=False)
        self._server.start()

    def _recognize(self, _):
        result = ObjectRecognitionResult()
        try:
            names = table.fill_scene(self._scene)
            for pose in self._scene.get_object_poses(names).values():
                seen = RecognizedObject(confidence=1.0)
                seen.header.frame_id = seen.pose.header.frame_id = "world"
                seen.pose.pose.pose = pose
                result.recognized_objects.objects.append(seen)
        except (rospy.ServiceException, rospy.ROSException) as error:
            return self._server.set_aborted(text=str(error))
        self._server.set_succeeded(result)


def main():
    node_signals.init_node("table_perception")
    rospy.wait_for_service("apply_planning_scene")
    rospy.Service("plan_grasps", GraspPlanning, plan_grasps)
    recognizer = Recognizer()  # noqa: F841 - it serves as long as it is kept
    node_signals.spin()
