"""Service to set the gains of one or several Pids in one call."""

from __future__ import annotations

import math
from typing import Any

import rospy

from control_toolbox.srv import SetPidGains, SetPidGainsResponse

from .pid import Pid


class PidGainsSetter:
    """Offers ``set_gains`` (control_toolbox/SetPidGains) in a namespace; the gains are kept as parameters there.

    :param nh: controller_interface.NodeHandle of the namespace; it owns the service.
    """

    def __init__(self, nh: Any, *pids: Pid):
        self._nh = nh
        self._pids: list[Pid] = list(pids)
        nh.service("set_gains", SetPidGains, self._set)

    def add(self, pid: Pid) -> None:
        """Let the service set the gains of ``pid`` too."""
        self._pids.append(pid)

    def _set(self, request: Any) -> SetPidGainsResponse:
        if not all(map(math.isfinite, (request.p, request.i, request.d, request.i_clamp))):
            raise rospy.ServiceException("the gains stay as they are: p, i, d and i_clamp must be finite numbers")
        clamp = abs(request.i_clamp)
        for pid in self._pids:
            pid.set_gains(request.p, request.i, request.d, clamp, -clamp, request.antiwindup)
        for name in ("p", "i", "d", "i_clamp", "antiwindup"):
            self._nh.set_param(name, getattr(request, name))
        return SetPidGainsResponse()
