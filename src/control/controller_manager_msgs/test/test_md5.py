"""The types must be those that compiled tools of Noetic speak: same MD5 sums."""

from controller_manager_msgs import msg, srv

MESSAGES = {
    "HardwareInterfaceResources": "f25b55cbf1d1f76e82e5ec9e83f76258",
    "ControllerState": "aeb6b261d97793ab74099a3740245272",
    "ControllerStatistics": "697780c372c8d8597a1436d0e2ad3ba8",
    "ControllersStatistics": "a154c347736773e3700d1719105df29d",
}
SERVICES = {
    "ListControllerTypes": "c1d4cd11aefa9f97ba4aeb5b33987f4e",
    "ListControllerTypesRequest": "d41d8cd98f00b204e9800998ecf8427e",
    "ListControllerTypesResponse": "c1d4cd11aefa9f97ba4aeb5b33987f4e",
    "ListControllers": "1341feb2e63fa791f855565d0da950d8",
    "ListControllersRequest": "d41d8cd98f00b204e9800998ecf8427e",
    "ListControllersResponse": "1341feb2e63fa791f855565d0da950d8",
    "LoadController": "647e5c54b8d6468952d8d31f1efe96c0",
    "LoadControllerRequest": "c1f3d28f1b044c871e6eff2e9fc3c667",
    "LoadControllerResponse": "6f6da3883749771fac40d6deb24a8c02",
    "UnloadController": "647e5c54b8d6468952d8d31f1efe96c0",
    "UnloadControllerRequest": "c1f3d28f1b044c871e6eff2e9fc3c667",
    "UnloadControllerResponse": "6f6da3883749771fac40d6deb24a8c02",
    "ReloadControllerLibraries": "40e8c411fd1797d2e2c486018f846040",
    "ReloadControllerLibrariesRequest": "18442b59be9479097f11c543bddbac62",
    "ReloadControllerLibrariesResponse": "6f6da3883749771fac40d6deb24a8c02",
    "SwitchController": "b29a7abc673b2c54c14b54e50f8d06a5",
    "SwitchControllerRequest": "36d99a977432b71d4bf16ce5847949d7",
    "SwitchControllerResponse": "6f6da3883749771fac40d6deb24a8c02",
}


def test_sums():
    assert {name: getattr(msg, name)._md5sum for name in MESSAGES} == MESSAGES
    assert {name: getattr(srv, name)._md5sum for name in SERVICES} == SERVICES


def test_constants():
    assert (srv.SwitchControllerRequest.BEST_EFFORT, srv.SwitchControllerRequest.STRICT) == (1, 2)
