"""Words of the command line."""
import pytest

from rosmon_core import RosmonError, cli


def test_options_stand_anywhere_and_arguments_last():
    options = cli.parse(["--no-start", "rosmon_core", "--stop-timeout=2.5", "pair.launch", "answer:=1", "--name=x"])
    assert options.file.endswith("test/launch/deep/er/pair.launch")
    assert (options.no_start, options.stop_timeout, options.name, options.arguments) == (True, 2.5, "x", ["answer:=1"])


def test_a_path_alone(tmp_path):
    path = tmp_path / "a.launch"
    path.write_text("<launch/>")
    assert cli.parse([str(path)]).file == str(path)


@pytest.mark.parametrize("text, size", [("15MB", 15_000_000), ("1.5 KiB", 1536), ("1000", 1000), ("2GiB", 2 << 30)])
def test_memory(text, size):
    assert cli.parse_memory(text) == size


@pytest.mark.parametrize("words, remedy", [
    ([], "PACKAGE FILE"), (["a", "b", "c"], "PACKAGE FILE"), (["no_such_package_here", "x.launch"], "sourced"),
    (["rosmon_core", "x.launch"], "it has .*pair.launch"), (["nowhere.launch"], "Could not find"),
    (["rosmon_core", "pair.launch", "a:=1", "b"], "'b' stands behind"), (["--memory-limit=much", "x"], "15MB"),
    (["--stop-timeout=-1", "x"], "zero or more"), (["--stop-timeout", "x"], "zero or more"),
    (["--output-attr=perhaps", "x"], "not known"), (["--no-start=1", "x"], "not known"), (["--log", "x"], "lacks")])
def test_mistakes_are_named(words, remedy):
    with pytest.raises(RosmonError, match=remedy):
        cli.parse(words)


def test_two_files_of_one_name_are_refused(tmp_path, monkeypatch):
    for folder in ("a", "b"):
        (tmp_path / "pkg" / folder).mkdir(parents=True)
        (tmp_path / "pkg" / folder / "same.launch").write_text("<launch/>")
    (tmp_path / "pkg" / "package.xml").write_text("<package><name>pkg</name></package>")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    with pytest.raises(RosmonError, match="multiple launch files"):
        cli.find_launch_file("pkg", "same.launch")
