"""Going back to moments that were kept."""

from __future__ import annotations

import rospy
from ode_sim.timeline import Timeline

from gazebo_ros.api.handlers import Refused, advertise
from gazebo_ros.callbacks import Occasional
from gazebo_ros.server import Server
from gazebo_ros.srv import Timeline as TimelineService
from gazebo_ros.srv import TimelineRequest as Request


class TimelineServices:
    """``~timeline``. Nothing is done in a step while nothing is recorded."""

    def __init__(self, server: Server):
        self._server = server
        self._timeline = Timeline(server.world)
        self._recording = Occasional(server.after_step, self._timeline.after_step)
        self._actions = {
            Request.LIST: lambda request: None,
            Request.KEEP: lambda request: self._timeline.keep(),
            Request.RETURN: self._return,
            Request.RECORD: self._record,
            Request.FORGET: lambda request: self._timeline.forget(),
        }
        advertise(server, "timeline", TimelineService, self._serve)

    def _serve(self, request, response) -> str:
        if request.action not in self._actions:
            raise Refused(f"action {request.action} is none of 0 (list), 1 (keep), 2 (return), 3 (record), 4 (forget)")
        self._actions[request.action](request)
        moments = self._timeline.moments
        response.numbers = [moment.number for moment in moments]
        response.times = [rospy.Time(0, moment.time_ns) for moment in moments]
        response.period = self._timeline.period
        return f"Timeline: {len(moments)} moments are kept"

    def _return(self, request) -> None:
        moment = self._timeline.find(request.number)
        self._server.restore(moment.snapshot)
        self._timeline.went_back(moment)

    def _record(self, request) -> None:
        self._timeline.record(request.period)
        self._recording.needed(bool(self._timeline.period))
