"""Launch files that cannot be read, in one line."""

import pytest
from launch_gallery import launches


def test_a_package_that_is_not_here_is_named(tmp_path):
    file = tmp_path / "a.launch"
    file.write_text('<launch><include file="$(find no_such_package)/b.launch"/></launch>')
    with pytest.raises(launches.LaunchError, match="^package no_such_package is not here: [^/]*$"):
        launches.content(launches.find(str(file))[0], {})


def test_an_argument_that_the_file_settles_itself_wants_no_value(tmp_path):
    file = tmp_path / "a.launch"
    file.write_text(
        '<launch><arg name="paused" default="false"/><arg name="robot"/><arg unless="$(arg paused)" name="option" value=""/>'
        '<arg if="$(arg paused)" name="option" value="-u"/></launch>'
    )
    (launch,) = launches.find(str(file))
    assert launches.arguments(launch, {"robot": "r"}) == {"robot": "r"}
    with pytest.raises(launches.LaunchError, match="^needs a value for argument robot: add robot:=...$"):
        launches.arguments(launch, {})


def test_two_packages_of_one_name_are_one_line(tmp_path, monkeypatch):
    def load(*_, **__):  # as catkin says it, of a workspace that has them
        raise RuntimeError('Multiple packages found with the same name "twice":\n- a/twice\n- b/twice')

    monkeypatch.setattr(launches, "load_config_default", load)
    (tmp_path / "c.launch").write_text("<launch/>")
    with pytest.raises(launches.LaunchError, match='^Multiple packages found with the same name "twice": - a/twice - b/twice$'):
        launches.content(launches.find(str(tmp_path / "c.launch"))[0], {})
