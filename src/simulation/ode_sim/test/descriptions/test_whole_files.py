"""A reader sees a whole file, and a file that cannot be replaced stays."""

import os
import threading

import pytest
from ode_sim.whole_files import write_whole


def test_readers_never_see_half_of_it(tmp_path):
    path, texts, seen, done = tmp_path / "model.sdf", ["a" * 200_000, "b" * 300_000], set(), threading.Event()
    path.write_text(texts[0])

    def read():
        while not done.is_set():
            seen.add(path.read_text())

    reader = threading.Thread(target=read)
    reader.start()
    try:
        for number in range(200):
            write_whole(str(path), texts[number % 2])
    finally:
        done.set()
        reader.join()
    assert seen <= set(texts) and os.listdir(tmp_path) == ["model.sdf"]


def test_a_link_goes_on_to_lead_to_the_file(tmp_path):
    (tmp_path / "there").mkdir()
    (tmp_path / "there" / "a").write_text("old")
    (tmp_path / "link").symlink_to(tmp_path / "there" / "a")
    write_whole(str(tmp_path / "link"), "n\u00e9w")
    assert (tmp_path / "link").is_symlink() and (tmp_path / "there" / "a").read_text(encoding="utf-8") == "n\u00e9w"


@pytest.mark.parametrize("name", ["none/a.world", "folder"])
def test_what_cannot_be_written_is_named_and_nothing_is_left(tmp_path, name):
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError) as told:
        write_whole(str(tmp_path / name), "text")
    assert told.value.filename == str(tmp_path / name) and told.value.strerror
    assert os.listdir(tmp_path) == ["folder"] and not os.listdir(tmp_path / "folder")


def test_a_disk_that_is_full_costs_nothing_that_was_there(tmp_path):
    path = tmp_path / "a"
    path.write_text("old")
    with pytest.raises(UnicodeEncodeError):  # anything that ends the writing half-way
        write_whole(str(path), "x" * 100_000 + "\ud800")
    assert path.read_text() == "old" and os.listdir(tmp_path) == ["a"]
