"""rosmon as a ROS node: ``~state``, ``~start_stop`` and ``/diagnostics``."""

from __future__ import annotations

import asyncio
import re

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rosmon_msgs.msg import NodeState, State
from rosmon_msgs.srv import StartStop, StartStopRequest, StartStopResponse

from rosmon_core.cli import Options
from rosmon_core.monitor import Monitor, Usage
from rosmon_core.process import NodeProcess
from rosmon_core.process import State as ProcessState

_PERIOD = 1.0  # s
_ACTIONS = {StartStopRequest.START: "start", StartStopRequest.STOP: "stop", StartStopRequest.RESTART: "restart"}


class RosInterface:
    """Publishes once a second and carries out service calls in the loop's thread.

    Create it outside the loop's thread: :func:`rospy.init_node` talks to the master.
    """

    def __init__(self, monitor: Monitor, options: Options, name: str | None, loop: asyncio.AbstractEventLoop) -> None:
        self._monitor, self._options, self._loop = monitor, options, loop
        rospy.init_node(name or "rosmon", anonymous=name is None, disable_signals=True)
        self._state = rospy.Publisher("~state", State, queue_size=1, latch=True)
        self._diagnostics = None
        if not options.disable_diagnostics:
            self._diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1, latch=True)
        self._service = rospy.Service("~start_stop", StartStop, self._start_stop)

    @property
    def name(self) -> str:
        return rospy.get_name()

    async def run(self) -> None:
        """Publish until cancelled."""
        while True:
            self._monitor.sample()
            self.publish()
            await asyncio.sleep(_PERIOD)

    def publish(self) -> None:
        stamp, nodes = rospy.Time.now(), self._monitor.nodes
        usage = {node: self._monitor.usage.get(node, Usage()) for node in nodes}
        state = State(
            nodes=[
                NodeState(
                    name=node.name,
                    ns=node.namespace.rstrip("/"),
                    state=int(node.state),
                    restart_count=node.restart_count,
                    user_load=usage[node].user_load,
                    system_load=usage[node].system_load,
                    memory=usage[node].memory,
                )
                for node in nodes
            ]
        )
        state.header.stamp = stamp
        self._state.publish(state)
        if self._diagnostics:
            array = DiagnosticArray(status=[self._status(node, usage[node]) for node in nodes])
            array.header.stamp = stamp
            self._diagnostics.publish(array)

    def shutdown(self) -> None:
        """Say that there are no nodes any more and leave the ROS graph."""
        self._state.publish(State())
        rospy.signal_shutdown("rosmon ends")

    def _status(self, node: NodeProcess, usage: Usage) -> DiagnosticStatus:
        load, spec = usage.user_load + usage.system_load, node.spec
        prefix = self._options.diagnostics_prefix
        complaints = []
        if 0 <= spec.restart_warn_threshold < node.restart_count:
            complaints.append(f"restart count > {spec.restart_warn_threshold}")
        if usage.memory > spec.memory_limit:
            complaints.append(f"memory {usage.memory / 2**20:.0f} MiB > {spec.memory_limit / 2**20:.0f} MiB")
        if load > spec.cpu_limit:
            complaints.append(f"CPU load {load:.2f} > {spec.cpu_limit:g}")
        level, message = DiagnosticStatus.OK, "Process is " + node.state.name.lower()
        if node.state == ProcessState.CRASHED:
            level, message = DiagnosticStatus.ERROR, "Process has crashed"
        elif complaints:
            level, message = DiagnosticStatus.WARN, "; ".join(complaints)
        return DiagnosticStatus(
            level=level,
            message=message,
            hardware_id=node.name,
            name=f"{prefix if prefix is not None else self.name.lstrip('/')}:{self._monitor.label(node)}",
            values=[
                KeyValue("CPU Load", f"{load:.2f}"),
                KeyValue("used memory", f"{usage.memory / 2**20:.1f} MiB"),
                KeyValue("restart count", str(node.restart_count)),
            ],
        )

    def _start_stop(self, request: StartStopRequest) -> StartStopResponse:
        if request.action not in _ACTIONS:
            raise rospy.ServiceException(f"action {request.action} is none of START 1, STOP 2, RESTART 3")
        try:
            nodes = self._monitor.matching(request.node, request.ns)
        except re.error as error:
            raise rospy.ServiceException(f"'{request.ns}/{request.node}' is no regular expression: {error}") from None
        if not nodes:
            names = ", ".join(node.spec.full_name for node in self._monitor.nodes)
            raise rospy.ServiceException(f"no node matches '{request.ns}/{request.node}'; there are {names}")
        for node in nodes:
            self._loop.call_soon_threadsafe(self._monitor.act, node, _ACTIONS[request.action])
        return StartStopResponse()
