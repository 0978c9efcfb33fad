"""What tests do with a controller manager: its services as functions."""

import xmlrpc.client
from typing import Any

import rosgraph
import rospy
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllerTypes,
    LoadController,
    ReloadControllerLibraries,
    SwitchController,
    SwitchControllerRequest,
    UnloadController,
)
from test_support import wait_until

STRICT = SwitchControllerRequest.STRICT
BEST_EFFORT = SwitchControllerRequest.BEST_EFFORT


def sends(node, topic):
    """Whether ``node`` is connected to this process and sends it ``topic``."""
    me = rospy.get_name()
    proxy: Any = xmlrpc.client.ServerProxy(rosgraph.Master(me).lookupNode(node))
    _, _, connections = proxy.getBusInfo(me)
    return any(connection[1:5] == [me, "o", "TCPROS", topic] for connection in connections)


class ManagerClient:
    """The services of the controller manager in ``namespace``."""

    def __init__(self, namespace=""):
        self._prefix = f"{namespace}/controller_manager/"

    def _call(self, name, service_type, *arguments):
        rospy.wait_for_service(self._prefix + name, timeout=60.0)
        return rospy.ServiceProxy(self._prefix + name, service_type)(*arguments)

    def wait_until_running(self, name):
        """A loaded controller refuses goals until it is started, some moments later."""
        wait_until(lambda: self.states().get(name) == "running", f"{name} to run")

    def load(self, name):
        return self._call("load_controller", LoadController, name).ok

    def unload(self, name):
        return self._call("unload_controller", UnloadController, name).ok

    def switch(self, start=(), stop=(), strictness=STRICT, start_asap=False, timeout=0.0):
        """As ControllerManager.switch_controller: ``start``, ``stop``, ``strictness``, ``start_asap``, ``timeout`` (s). :return: ok"""
        return self._call("switch_controller", SwitchController, list(start), list(stop), strictness, start_asap, timeout).ok

    def start(self, *names):
        return self.switch(start=names)

    def stop(self, *names):
        return self.switch(stop=names)

    def reload(self, force_kill):
        return self._call("reload_controller_libraries", ReloadControllerLibraries, force_kill).ok

    def controllers(self):
        return self._call("list_controllers", ListControllers).controller

    def states(self):
        """name -> state, in load order."""
        return {controller.name: controller.state for controller in self.controllers()}

    def types(self):
        return self._call("list_controller_types", ListControllerTypes)

    def clear(self):
        """Stop and unload everything."""
        names = list(self.states())
        assert self.switch(stop=names, strictness=BEST_EFFORT)
        assert all([self.unload(name) for name in names])
