"""Exports of packages in a folder of their own."""

import pytest
import rospkg
from plugin_loader import PluginError, exported_values, find_plugins

MANIFEST = """<package format="2"><name>{name}</name><version>0.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>BSD-3-Clause</license><{depend}>base</{depend}>
<export><base plugin="${{prefix}}/plugins.xml" path="${{prefix}}/models"/></export></package>"""


@pytest.fixture
def package(tmp_path):
    def make(name, classes, depend="depend", code="class Thing:\n    pass\n"):
        folder = tmp_path / name
        (folder / "src").mkdir(parents=True)
        (folder / "package.xml").write_text(MANIFEST.format(name=name, depend=depend))
        (folder / "plugins.xml").write_text(f'<library path="src">{classes}</library>')
        (folder / "src" / f"{name}_module.py").write_text(code)
        return folder

    return make


def find(tmp_path):
    return find_plugins("base", rospack=rospkg.RosPack([str(tmp_path)]))


def test_a_class_is_found_by_its_name_and_imported(package, tmp_path):
    package("one", '<class name="one/Thing" type="one_module.Thing" base_class_type="B"><description> d </description></class>')
    found, problems = find(tmp_path)
    plugin = found["one/Thing"]
    assert not problems and plugin.package == "one" and plugin.base == "B" and plugin.description == "d"
    assert plugin.load().__name__ == "Thing"


def test_only_packages_that_depend_on_the_base_count(package, tmp_path):
    package("two", '<class name="two/Thing" type="two_module.Thing"/>', depend="build_depend")
    assert find(tmp_path)[0] == {}


def test_a_compiled_class_is_listed_and_refused_by_name(package, tmp_path):
    package("three", '<class name="three/Fast" type="three::Fast"/>')
    with pytest.raises(PluginError, match="'three/Fast' of package three is a compiled C\\+\\+ plugin"):
        find(tmp_path)[0]["three/Fast"].load()


@pytest.mark.parametrize("type_name, code", [("four_module.Gone", "x = 1\n"), ("four_module.Thing", "raise ValueError('no')\n")])
def test_an_import_that_fails_is_one_line(package, tmp_path, type_name, code):
    package("four", f'<class name="four/Thing" type="{type_name}"/>', code=code)
    with pytest.raises(PluginError, match="'four/Thing' of package four cannot be imported") as caught:
        find(tmp_path)[0]["four/Thing"].load()
    assert "\n" not in str(caught.value)


def test_a_broken_plugin_file_is_a_problem_and_hides_no_other(package, tmp_path):
    (package("five", "<class") / "plugins.xml").write_text("<library")
    package("six", '<class name="six/Thing" type="six_module.Thing"/>')
    found, problems = find(tmp_path)
    assert list(found) == ["six/Thing"] and len(problems) == 1 and "package five" in problems[0]


def test_several_libraries_without_an_element_around_them(package, tmp_path):
    """As pluginlib takes it, and vendors write it."""
    library = '<library path="src"><class name="{0}" type="two::{0}"/></library>'
    (package("eight", "") / "plugins.xml").write_text(
        '<?xml version="1.0"?>\n' + library.format("A") + "\n<!-- x -->\n" + library.format("B")
    )
    found, problems = find(tmp_path)
    assert sorted(found) == ["A", "B"] and not problems


def test_values_of_an_attribute_with_the_package_folder_filled_in(package, tmp_path):
    folder = package("seven", "")
    assert exported_values("base", "path", rospkg.RosPack([str(tmp_path)])) == [f"{folder}/models"]
