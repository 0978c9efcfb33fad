"""What all tests of this folder need."""
import os

import pytest

_MODE = "RAY_AUTH_MODE"  # set once per process by who connects to a cluster; each test is a process of its own in that


@pytest.fixture(autouse=True)
def no_cluster_is_remembered():
    before = os.environ.get(_MODE)
    yield
    if before is None:
        os.environ.pop(_MODE, None)
    else:
        os.environ[_MODE] = before
