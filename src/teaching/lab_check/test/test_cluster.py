"""Grading on a cluster: what travels, which nodes are fit, and the same marks and retries as the pool gives on Ray's own local one."""

import os
import pathlib
import signal
import time

import pytest
from lab_check.classroom import cluster, cluster_node, engines, grade, packed_files, store
from lab_check.isolation import sandbox
from lab_check.specs import spec

SPEC = """\
title: T
tasks:
  - {name: A, points: 4, launch: '', expect: [{file: {path: '*/readme.txt', contains: hello}}, {file: {path: '*/x'}}]}
"""
MANIFEST = """\
<package format='2'>
  <name>p</name><version>1.0.0</version><description>d</description><maintainer email='a@b.de'>m</maintainer><license>BSD</license>
</package>
"""


@pytest.fixture
def course(tmp_path):
    (tmp_path / "spec.yaml").write_text(SPEC)
    for name, text in (("good", "hello"), ("bad", "bye")):
        place = tmp_path / "submissions" / name / "p"
        place.mkdir(parents=True)
        (place / "package.xml").write_text(MANIFEST)
        (place / "readme.txt").write_text(text)
        (place / "root").symlink_to("/")
    return tmp_path


def test_a_parcel_holds_links_as_links_and_has_a_bound(course):
    path = course / "submissions" / "good"
    os.mkfifo(path / "pipe")
    packed_files.unpack(packed_files.pack(path), course / "there")
    assert os.readlink(course / "there" / "good" / "p" / "root") == "/"
    assert (course / "there" / "good" / "p" / "readme.txt").read_text() == "hello" and not (course / "there" / "good" / "pipe").exists()
    with open(path / "big", "wb") as file:
        file.truncate(2_000_000_000)
    with pytest.raises(packed_files.TooLarge):
        packed_files.pack(path, 2e8)
    (course / "slash").symlink_to("/")
    packed_files.unpack(packed_files.pack(course / "slash"), course / "there")
    assert os.readlink(course / "there" / "slash") == "/"


def test_a_spec_travels_with_what_it_names(course):
    (course / "more" / "q").mkdir(parents=True)
    (course / "course").mkdir()
    (course / "own.py").write_text("def f(context): return True\n")
    text = SPEC.replace("title: T", "title: T\nalso: [../more]").replace("launch: ''", "launch: p a.launch")
    (course / "course" / "spec.yaml").write_text(text.replace("{file: {path: '*/x'}}", "{python: {file: ../own.py, function: f}}"))
    packed, path = packed_files.pack_spec(spec.load(course / "course" / "spec.yaml"))
    packed_files.unpack(packed, course / "there")
    assert path == "course/spec.yaml" and spec.load(course / "there" / path).points == 4


def test_an_unfit_node_says_why(monkeypatch):
    monkeypatch.setattr(sandbox, "check", lambda: (_ for _ in ()).throw(sandbox.SandboxError("bwrap is not installed")))
    monkeypatch.setenv("CMAKE_PREFIX_PATH", "")
    _, said, sent = cluster_node.faults("of yesterday", False, b"parcel")
    assert sent == b"parcel"
    assert any("not of yesterday" in line and "same version" in line for line in said)
    assert any("no workspace is sourced" in line for line in said)
    monkeypatch.undo()
    assert not [line for line in cluster_node.faults(cluster_node.platform_version(), True)[1] if "version" in line]


def test_without_ray_the_remedy_is_named(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "ray", None)
    with pytest.raises(cluster.ClusterError, match="scripts/setup --teaching"):
        cluster.connect("auto")


@pytest.mark.parametrize("address", ["127.0.0.1:1", "no.such.host.invalid", "127.0.0.1:port"])
def test_nobody_at_an_address_is_one_line_at_once(address):
    pytest.importorskip("ray", reason="ray is not installed: scripts/setup --teaching")
    with pytest.raises(cluster.ClusterError, match="no Ray cluster answers at .*ray start --head") as caught:
        cluster.connect(address)
    assert "\n" not in str(caught.value)


def test_a_cluster_that_does_not_start_is_one_line(monkeypatch):
    """Ray says so by a bare Exception."""
    ray = pytest.importorskip("ray", reason="ray is not installed: scripts/setup --teaching")

    def init(**_):
        raise Exception("The current node timed out during startup.\nIts raylet ...")

    monkeypatch.setattr(ray, "init", init)
    with pytest.raises(cluster.ClusterError, match="timed out during startup") as caught:
        cluster.connect("local")
    assert "\n" not in str(caught.value)


@pytest.fixture
def engine(course, monkeypatch):
    pytest.importorskip("ray", reason="ray is not installed: scripts/setup --teaching")
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))
    lines = []
    made = cluster.Cluster(spec.load(course / "spec.yaml"), course / "out", engines.How(films=False), 1, "local", lines.append)
    yield made
    made.end()
    assert not lines


def examiner_of(name):
    """Process ids of Ray's worker that examines this submission."""
    for place in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (place / "cmdline").read_bytes().decode(errors="replace").split("\0")
            if "import check" in " ".join(words) and any("lab_check_node." in word and word.endswith(f"/{name}") for word in words):
                return int((place / "stat").read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue
    return None


@pytest.mark.slow
def test_rays_local_cluster_gives_the_pools_marks_and_tries_a_killed_worker_again(course, engine):
    book = store.Store(course / "class.sqlite")
    (course / "submissions" / "slash").symlink_to("/")
    names = sorted(path.name for path in (course / "submissions").iterdir())
    for name in names:
        book.enlist(name, course / "submissions" / name, "1")
    killed, lines, ended = [], [], engine.ended

    def kill_once():
        worker = None if killed else examiner_of("good")
        if worker:
            killed.append(worker)
            os.kill(worker, signal.SIGKILL)
            while pathlib.Path(f"/proc/{worker}").exists() and "Z" not in pathlib.Path(f"/proc/{worker}/stat").read_text():
                time.sleep(0.01)
        return ended()

    engine.ended = kill_once
    grade.run(book, engine, lines.append)
    assert killed and any(line.startswith("good: its worker on") and "tried again" in line for line in lines), lines
    marks = {row["name"]: (row["state"], row["points"], row["of"]) for row in book.rows()}
    assert marks == {"bad": ("done", 0.0, 4.0), "good": ("done", 2.0, 4.0), "slash": ("done", 0.0, 4.0)}, lines
    assert "link to /" in (course / "out" / "slash" / "report.html").read_text()
    pool = engines.Pool(lambda name: course / "spec.yaml", course / "pool", engines.How(films=False), 1)
    again = store.Store(course / "pool.sqlite")
    for name in names:
        again.enlist(name, course / "submissions" / name, "1")
    grade.run(again, pool, lines.append)
    assert {row["name"]: (row["state"], row["points"], row["of"]) for row in again.rows()} == marks
