"""How the process of the simulator ends."""

import logging
import os
import sys

import pytest
from gazebo_ros import node
from ode_sim.errors import DescriptionError


@pytest.mark.parametrize(
    ("error", "traces"), [(DescriptionError("cannot find world 'worlds/empty.world'"), 0), (RuntimeError("a mistake of ours"), 1)]
)
def test_what_goes_wrong_at_the_start_is_no_success(monkeypatch, error, traces):
    def run():
        raise error

    codes, told = [], []
    monkeypatch.setattr(node, "_run", run)
    monkeypatch.setattr(logging, "shutdown", lambda: None)
    monkeypatch.setattr(os, "_exit", codes.append)
    monkeypatch.setattr(sys, "excepthook", lambda *what: told.append(what))
    node.main()
    assert (codes, len(told)) == ([1], traces)
