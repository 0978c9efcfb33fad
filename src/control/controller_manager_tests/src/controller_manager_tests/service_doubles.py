"""A controller manager that only has its services, for tests of what looks for controller managers."""
import rospy
from controller_manager_msgs.srv import (ListControllers, ListControllersResponse, ListControllerTypes,
                                         ListControllerTypesResponse, LoadController, LoadControllerResponse,
                                         ReloadControllerLibraries, ReloadControllerLibrariesResponse,
                                         SwitchController, SwitchControllerResponse, UnloadController,
                                         UnloadControllerResponse)


class ControllerManagerDummy:
    """All six services in ``namespace``; the answers are empty or say no.

    :param without: names of services to leave out.
    :param wrong_type: name of a service to offer with another type.
    """

    SERVICES = {
        "list_controllers": (ListControllers, ListControllersResponse),
        "list_controller_types": (ListControllerTypes, ListControllerTypesResponse),
        "load_controller": (LoadController, LoadControllerResponse),
        "unload_controller": (UnloadController, UnloadControllerResponse),
        "switch_controller": (SwitchController, SwitchControllerResponse),
        "reload_controller_libraries": (ReloadControllerLibraries, ReloadControllerLibrariesResponse),
    }

    def __init__(self, namespace="/controller_manager", without=(), wrong_type=None):
        self._services = []
        for name, (service, response) in self.SERVICES.items():
            if name in without:
                continue
            if name == wrong_type:
                service, response = ((LoadController, LoadControllerResponse) if service is not LoadController else
                                     (ListControllers, ListControllersResponse))
            self._services.append(rospy.Service(f"{namespace}/{name}", service,
                                                lambda _request, answer=response: answer()))

    def shutdown(self):
        for service in self._services:
            service.shutdown()
