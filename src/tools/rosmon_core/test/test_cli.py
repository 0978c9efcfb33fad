"""Words of the command line."""

import pytest
from rosmon_core import RosmonError, cli


def test_options_stand_anywhere_and_arguments_last():
    options = cli.parse(["--no-start", "rosmon_core", "--stop-timeout=2.5", "pair.launch", "answer:=1", "--name=x"])
    assert options.file.endswith("test/launch/deep/er/pair.launch")
    assert (options.no_start, options.stop_timeout, options.name, options.arguments) == (True, 2.5, "x", ["answer:=1"])


FORMS = [["--stop-timeout=3"], ["--stop-timeout", "3"], ["--stop", "3"], ["--stop=3"], ["--s", "3"]]


@pytest.mark.parametrize("form", FORMS, ids=" ".join)
@pytest.mark.parametrize("behind", [False, True])
def test_getopt_long_reads_an_option_in_all_its_forms(form, behind):
    words = ["rosmon_core", "pair.launch", "answer:=1"]
    options = cli.parse(words + form if behind else form + words)
    assert (options.stop_timeout, options.arguments) == (3.0, ["answer:=1"])


@pytest.mark.parametrize(
    "words, attribute, value",
    [
        (["--name", "x"], "name", "x"),
        (["--na", "x"], "name", "x"),
        (["--log", "a.log"], "log", "a.log"),
        (["--log="], "log", None),
        (["--cpu-limit", "2"], "cpu_limit", 2.0),
        (["--mem", "1kB"], "memory_limit", 1000),
        (["--mem", "1KB"], "memory_limit", 1000),
        (["--out", "obey"], "obey_output", True),
        (["--auto", "6"], "spawn_increment", 6.0),
        (["--diagnostics-prefix", "p"], "diagnostics_prefix", "p"),
        (["--disable-u"], "disable_ui", True),
        (["--no"], "no_start", True),
        (["--bench"], "benchmark", True),
        (["--list"], "list_args", True),
        (["--flush-s"], "flush_stdout", True),
        (["--disable-d"], "disable_diagnostics", True),
        (["--name", "--odd"], "name", "--odd"),
    ],
)
def test_every_option_takes_its_value_as_the_next_word_and_may_be_shortened(words, attribute, value):
    assert getattr(cli.parse([*words, "rosmon_core", "pair.launch"]), attribute) == value


@pytest.mark.parametrize("words", [["-h"], ["--help"], ["--he"], ["rosmon_core", "pair.launch", "-h"]])
def test_help(words):
    assert cli.parse(words).help


def test_two_hyphens_end_the_options(tmp_path, monkeypatch):
    (tmp_path / "--odd.launch").write_text("<launch/>")
    monkeypatch.chdir(tmp_path)
    assert cli.parse(["--", "--odd.launch"]).file == str(tmp_path / "--odd.launch")


def test_a_path_alone(tmp_path):
    path = tmp_path / "a.launch"
    path.write_text("<launch/>")
    assert cli.parse([str(path)]).file == str(path)


@pytest.mark.parametrize("text, size", [("15MB", 15_000_000), ("1.5 KiB", 1536), ("1000", 1000), ("2GiB", 2 << 30)])
def test_memory(text, size):
    assert cli.parse_memory(text) == size


@pytest.mark.parametrize(
    "words, remedy",
    [
        ([], "PACKAGE FILE"),
        (["a", "b", "c"], "PACKAGE FILE"),
        (["no_such_package_here", "x.launch"], "sourced"),
        (["rosmon_core", "x.launch"], "it has .*pair.launch"),
        (["nowhere.launch"], "Could not find"),
        (["rosmon_core", "pair.launch", "a:=1", "b"], "'b' stands behind"),
        (["--memory-limit=much", "x"], "15MB"),
        (["--stop-timeout=-1", "x"], "zero or more"),
        (["--stop-timeout", "x"], "zero or more"),
        (["--cpu", "nan", "x"], "zero or more"),
        (["--stop", "-1", "x"], "zero or more"),
        (["--output-attr=perhaps", "x"], "obey or ignore"),
        (["--no-start=1", "x"], "must not have an argument"),
        (["x", "--log"], "requires argument"),
        (["--f", "x"], "not a unique prefix"),
        (["--disable", "x"], "not a unique prefix"),
        (["--wheels", "x"], "--wheels not recognized"),
        (["-x"], "-x not recognized"),
    ],
)
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
