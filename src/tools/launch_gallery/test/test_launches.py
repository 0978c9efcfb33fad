"""Launch files that cannot be read, in one line."""
import pytest
from launch_gallery import launches


def test_a_package_that_is_not_here_is_named(tmp_path):
    file = tmp_path / "a.launch"
    file.write_text('<launch><include file="$(find no_such_package)/b.launch"/></launch>')
    with pytest.raises(launches.LaunchError, match="^package no_such_package is not here: [^/]*$"):
        launches.content(launches.find(str(file))[0], {})
