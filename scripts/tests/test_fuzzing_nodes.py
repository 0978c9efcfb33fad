"""A short run of the kinds of scripts/fuzz that start nodes finds nothing."""

import pytest
from test_fuzzing import CORPUS, fuzz

SHORT = {"yaml": 30, "launch": 8, "messages": 8, "planning": 6}


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(SHORT))
def test_a_short_run_finds_nothing_in_nodes(kind, tmp_path):
    code, output = fuzz("--kind", kind, "--cases", SHORT[kind], "--seed", 1, "--output", tmp_path, "--patience", 5)
    assert code == 0, output
    assert f"{kind}: {SHORT[kind]} cases in" in output


@pytest.mark.slow
def test_messages_and_parameters_that_once_broke_something_break_nothing():
    files = sorted(CORPUS.glob("nodes_*"))
    code, output = fuzz(*files)
    assert code == 0, output
    assert output.count("nothing found") == len(files)
