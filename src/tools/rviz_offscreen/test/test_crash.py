"""RViz that crashes is started once more, and no more than once. Without ROS and without RViz."""

import contextlib

import pytest
from rviz_offscreen import cli


@pytest.fixture
def take(monkeypatch, tmp_path):
    """``take(crashes)``: the runs of RViz that a picture took, the first ``crashes`` of which end by a signal."""

    def call(crashes):
        runs = []

        def run(job, environment, limit):
            runs.append(job)
            if len(runs) <= crashes:
                raise cli.RvizCrashed("RViz crashed (SIGABRT)")
            return {"not_ok": {}, "unpublished": {}, "seconds": 1.0}

        monkeypatch.setattr(cli, "run_grabber", run)
        monkeypatch.setattr(cli, "backend", lambda name, size: contextlib.nullcontext({}))
        monkeypatch.setattr(cli, "check_config", lambda path: None)
        monkeypatch.setattr(cli.rosgraph, "is_master_online", lambda: True)
        cli.take(str(tmp_path / "a.rviz"), [], str(tmp_path / "a.png"))
        return len(runs)

    return call


def test_once_more(take):
    assert take(0) == 1
    assert take(1) == 2


def test_no_more_than_once(take):
    with pytest.raises(cli.RvizCrashed):
        take(2)
