"""The action ``execute_trajectory``, and the service ``execute_kinematic_path`` of old configurations."""

from __future__ import annotations

import rospy
from moveit_core.errors import PlanningError, code_name
from moveit_msgs.msg import ExecuteTrajectoryAction, MoveItErrorCodes
from moveit_msgs.srv import ExecuteKnownTrajectory
from moveit_ros_planning.trajectory_execution import ExecutionError, error_code

from ..capability import ActionCapability, Capability, serve


class ExecuteTrajectory(ActionCapability):
    """Executes a trajectory as it is, without a look at the scene."""

    title = "ExecuteTrajectoryAction"
    action_name = "execute_trajectory"
    action = ExecuteTrajectoryAction

    def __init__(self, context):
        self._execution = None
        super().__init__(context)

    def preempt(self) -> None:
        super().preempt()
        running = self._execution
        if running is not None:
            running.stop()

    def serve(self, goal, result) -> str:
        if self.context.execution is None:
            return self.failed(
                result, MoveItErrorCodes.CONTROL_FAILED, "Cannot execute trajectory since ~allow_trajectory_execution was set to false"
            )
        rospy.loginfo("Execution request received")
        self.feedback("MONITOR")
        try:
            self._execution = self.context.execution.start([goal.trajectory], stops=self.stops)
        except ExecutionError as error:
            rospy.logerr("%s", error)
            return self.failed(result, MoveItErrorCodes.CONTROL_FAILED, str(error))
        if self.stop.is_set():
            self._execution.stop()
        while not self._execution.wait(0.2) and not rospy.is_shutdown():
            pass
        execution, self._execution = self._execution, None
        result.error_code.val = error_code(execution.status)
        if result.error_code.val == MoveItErrorCodes.SUCCESS:
            return "Trajectory was successfully executed."
        if result.error_code.val == MoveItErrorCodes.PREEMPTED:
            return "Execution was stopped."
        rospy.loginfo("Execution completed: %s", execution.status.value)
        return execution.reason or code_name(result.error_code.val)


class ExecuteService(Capability):
    """Executes a trajectory; waits for its end if told to. Not among the default capabilities: the action can be cancelled."""

    title = "ExecutePathService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("execute_kinematic_path", ExecuteKnownTrajectory, self._execute)

    def _execute(self, request, response) -> None:
        codes, execution = MoveItErrorCodes, self.context.execution
        if execution is None:
            raise PlanningError(codes.CONTROL_FAILED, "Cannot execute trajectory since ~allow_trajectory_execution was set to false")
        rospy.loginfo("Received new trajectory execution service request...")
        try:
            running = execution.start([request.trajectory], stops=execution.stops)
        except ExecutionError as error:
            raise PlanningError(codes.CONTROL_FAILED, str(error)) from error
        response.error_code.val = codes.SUCCESS
        if request.wait_for_execution:
            while not running.wait(0.2) and not rospy.is_shutdown():
                pass
            response.error_code.val = error_code(running.status)
            rospy.loginfo("Execution completed: %s", running.status.value)
