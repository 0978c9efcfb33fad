"""What all tests of this folder need."""

import os
import pathlib
import shutil
import time

import pytest
from lab_check.isolation import control_group, sandbox
from teachers import WHO, Teacher

_MODE = "RAY_AUTH_MODE"  # set once per process by who connects to a cluster; each test is a process of its own in that


@pytest.fixture(autouse=True)
def no_cluster_is_remembered():
    before = os.environ.get(_MODE)
    yield
    if before is None:
        os.environ.pop(_MODE, None)
    else:
        os.environ[_MODE] = before


@pytest.fixture
def walled():
    """A machine on which submissions can be shut in; else the test is left out."""
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))


@pytest.fixture(params=WHO)
def teacher(request, walled):
    if os.getuid() != 0 and request.param != "a user":
        pytest.skip("these tests do not run as root")
    with control_group.bounded(10, 1e9) as place:
        if request.param == "root" and not control_group.counts_memory(place):
            pytest.skip("no control group can be made here")
    place = pathlib.Path(f"/tmp/lab_check_walls.{os.getpid()}.{time.monotonic_ns()}")  # pytest's own folder is closed to other users
    place.mkdir()
    yield Teacher(request.param, place)
    shutil.rmtree(place)
