"""A controller manager that only has its services, for tests of what looks for controller managers."""

import rospy
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllersResponse,
    ListControllerTypes,
    ListControllerTypesResponse,
    LoadController,
    LoadControllerResponse,
    ReloadControllerLibraries,
    ReloadControllerLibrariesResponse,
    SwitchController,
    SwitchControllerResponse,
    UnloadController,
    UnloadControllerResponse,
)


class ControllerManagerDummy:
    """All six services in ``ns``. Attributes and methods have upstream's names, as tests change them.

    ``*_resp`` are the answers: empty lists, and success. ``list_ctrl``, ``list_types``, ``load_ctrl``, ``unload_ctrl``,
    ``switch_ctrl`` and ``reload_libs`` are the services (rospy.Service).

    :param without: names of services to leave out.
    :param wrong_type: name of a service to offer with another type.
    """

    #: service -> its type, its attribute
    SERVICES = {
        "list_controllers": (ListControllers, "list_ctrl"),
        "list_controller_types": (ListControllerTypes, "list_types"),
        "load_controller": (LoadController, "load_ctrl"),
        "unload_controller": (UnloadController, "unload_ctrl"),
        "switch_controller": (SwitchController, "switch_ctrl"),
        "reload_controller_libraries": (ReloadControllerLibraries, "reload_libs"),
    }

    def __init__(self, ns="/controller_manager", without=(), wrong_type=None):
        self.list_ctrl_resp = ListControllersResponse()
        self.list_types_resp = ListControllerTypesResponse()
        self.load_ctrl_resp = LoadControllerResponse(ok=True)
        self.unload_ctrl_resp = UnloadControllerResponse(ok=True)
        self.switch_ctrl_resp = SwitchControllerResponse(ok=True)
        self.reload_libs_resp = ReloadControllerLibrariesResponse(ok=True)
        for name, (kind, attribute) in self.SERVICES.items():
            if name in without:
                continue
            if name == wrong_type:
                kind = ListControllers if kind is LoadController else LoadController
            setattr(self, attribute, rospy.Service(f"{ns.rstrip('/')}/{name}", kind, getattr(self, f"_{attribute}_cb")))

    def _list_ctrl_cb(self, _request):
        return self.list_ctrl_resp

    def _list_types_cb(self, _request):
        return self.list_types_resp

    def _load_ctrl_cb(self, _request):
        return self.load_ctrl_resp

    def _unload_ctrl_cb(self, _request):
        return self.unload_ctrl_resp

    def _switch_ctrl_cb(self, _request):
        return self.switch_ctrl_resp

    def _reload_libs_cb(self, _request):
        return self.reload_libs_resp

    def shutdown(self):
        for _, attribute in self.SERVICES.values():
            if hasattr(self, attribute):
                getattr(self, attribute).shutdown()
