"""What a submission hands in to end the checker, to keep it busy, or to pass for something else: archives, manifests, texts and names."""

import bz2
import gzip
import html.parser
import io
import lzma
import os
import pathlib
import struct
import tarfile
import time
import urllib.parse
import zipfile

import pytest
from lab_check import explain
from lab_check.checks.base import search
from lab_check.classroom import grade, gradebook, similar, store
from lab_check.cli import shown
from lab_check.isolation import staging, untrusted_files
from lab_check.outcome import Result, TaskResult, name_for
from lab_check.specs import spec

MANIFEST = b"<package format='2'><name>p</name></package>"
LIMIT = 2e8


def stage(submission, tmp_path):
    with staging.within_bounds():
        return staging.stage(submission, tmp_path / "ws" / "src", LIMIT)


# ---------------------------------------------------------------------------------------------- archives


def a_zip(*more, kind=zipfile.ZIP_DEFLATED):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", kind) as file:
        file.writestr("p/package.xml", MANIFEST)
        for name, text in more:
            file.writestr(name, text)
    return bytearray(data.getvalue())


def flipped(data, at, count=6, by=0xFF):
    for place in range(at, at + count):
        data[place] ^= by
    return data


def a_tar(*more):
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w") as file:
        for name, text in (("p/package.xml", MANIFEST), *more):
            entry = tarfile.TarInfo(name)
            entry.size = len(text)
            file.addfile(entry, io.BytesIO(text))
    return data.getvalue()


def header(kind, size, name="x"):
    entry = tarfile.TarInfo(name)
    entry.type, entry.size = kind, size
    return entry.tobuf(tarfile.GNU_FORMAT)


def claims(kind, size):
    """A tar whose first entry says that it has so many bytes."""
    return bz2.compress(header(kind, size) + a_tar())


def central(data, offset, value):
    struct.pack_into("<I", data, data.rfind(b"PK\1\2") + offset, value)
    return data


def encrypted():
    data = a_zip()
    for magic, offset in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
        data[data.find(magic) + offset] |= 1
    return data


NOISE = os.urandom(20000)
TARS = a_tar(("p/noise.bin", NOISE))
# file's name -> (its bytes, made when it is needed; what is said of it, or None where the package in it can be taken)
ARCHIVES = {
    "deflate.zip": (lambda: flipped(d := a_zip(("p/x.txt", "project(p)\n" * 400)), d.find(b"p/x.txt") + 8), "cannot be unpacked"),
    "crc.zip": (lambda: flipped(d := a_zip(("p/x.txt", "x")), d.rfind(b"PK\1\2") + 16, 1), "Bad CRC-32"),
    "utf8.zip": (
        lambda: bytes(a_zip(("p/\u00e9\u00e9.txt", "x"))).replace("\u00e9\u00e9".encode(), b"\xff\xfe\xff\xfe"),
        "cannot be unpacked",
    ),
    "lzma.zip": (
        lambda: flipped(d := a_zip(("p/noise.bin", NOISE), kind=zipfile.ZIP_LZMA), d.find(b"p/noise.bin") + 23, 28, 0x5A),
        "cannot be unpacked",
    ),
    "bzip2.zip": (
        lambda: flipped(d := a_zip(("p/noise.bin", NOISE), kind=zipfile.ZIP_BZIP2), d.find(b"p/noise.bin") + 30, 28),
        "cannot be unpacked",
    ),
    "short.zip": (lambda: central(a_zip(("p/noise.bin", NOISE)), 20, 200), "cannot be unpacked"),
    "encrypted.zip": (encrypted, "is encrypted; hand it in without a password"),
    "offset.zip": (lambda: central(a_zip(), 42, 0x7FFFFFFF), "cannot be unpacked"),
    "zip64.zip": (lambda: central(a_zip(("p/x", "x")), 24, 0xFFFFFFFF), "larger than 200 MB"),
    "method.zip": (lambda: flipped(d := a_zip(("p/x", "x")), d.rfind(b"PK\1\2") + 10, 1, 0x55), "cannot be unpacked"),
    "cut.zip": (lambda: a_zip(("p/noise.bin", NOISE))[:15000], "neither a folder nor a zip or tar archive"),
    "file_and_folder.zip": (lambda: a_zip(("p/a", "x"), ("p/a/b", "x")), None),
    "folder_and_file.zip": (lambda: a_zip(("p/a/b", "x"), ("p/a", "x")), None),
    "long_name.zip": (lambda: a_zip(("p/" + "n" * 300, "x")), None),
    "long_path.zip": (lambda: a_zip(("p/" + "n" * 200 + "/" + "m" * 200 + "/x", "x")), None),
    "twice.zip": (lambda: a_zip(("p/package.xml", "<package><name>q</name></package>")), None),
    "upwards.zip": (lambda: a_zip(("../../evil", "x"), ("/tmp/evil", "x"), ("p/..\\..\\evil", "x")), None),
    "corrupt.tar.gz": (lambda: flipped(bytearray(gzip.compress(TARS)), 10000), "cannot be unpacked"),
    "sum.tar.gz": (lambda: flipped(bytearray(gzip.compress(TARS)), len(gzip.compress(TARS)) - 8, 2), "CRC check failed"),
    "cut.tar.gz": (lambda: gzip.compress(TARS)[:10000], "cannot be unpacked"),
    "corrupt.tar.xz": (lambda: flipped(bytearray(lzma.compress(TARS)), 10000), "cannot be unpacked"),
    "corrupt.tar.bz2": (lambda: flipped(bytearray(bz2.compress(TARS)), 10000), "cannot be unpacked"),
    "no_tar.gz": (lambda: gzip.compress(b"an essay"), "cannot be unpacked"),
    "cut.tar": (lambda: TARS[:10000], "cannot be unpacked"),
    "long_name.tar.bz2": (lambda: claims(tarfile.GNUTYPE_LONGNAME, 1 << 30), "a name in the archive claims to be 1074 MB long"),
    "long_link.tar.bz2": (lambda: claims(tarfile.GNUTYPE_LONGLINK, 1 << 30), "claims to be 1074 MB"),
    "pax.tar.bz2": (lambda: claims(tarfile.XHDTYPE, 1 << 30), "claims to be 1074 MB"),
    "far.tar.bz2": (lambda: claims(b"D", 1 << 30), "unpacks to more than"),
    "negative.tar": (lambda: header(b"0", 100, "p/package.xml")[:124] + b"\xff" * 12 + header(b"0", 100)[136:] + bytes(1024), ""),
    "devices.tar": (lambda: header(tarfile.CHRTYPE, 0, "p/null") + header(tarfile.FIFOTYPE, 0, "p/pipe") + a_tar(), None),
    "words.zip": (lambda: b"an essay", "neither a folder nor a zip or tar archive"),
    "empty.tar": (lambda: b"", "neither a folder nor a zip or tar archive"),
}


@pytest.mark.parametrize("name", ARCHIVES)
def test_every_archive_ends_as_a_sentence_or_a_package(tmp_path, name):
    make, said = ARCHIVES[name]
    (tmp_path / name).write_bytes(make())
    if said is None:
        assert list(stage(tmp_path / name, tmp_path).packages) == ["p"]
        assert not (tmp_path / "evil").exists() and not os.path.exists("/tmp/evil")
    else:
        with pytest.raises(staging.StagingError) as caught:
            stage(tmp_path / name, tmp_path)
        assert said in str(caught.value) and "\n" not in str(caught.value)


def test_an_archive_is_counted_while_it_is_unpacked(tmp_path):
    """A thousandth of the room that it unpacks to: it is given up when the room is full, not when it is unpacked."""
    bomb = tmp_path / "bomb.tar.gz"
    with gzip.open(bomb, "wb", 1) as file:
        file.write(header(b"0", 0o77777777777, "p/zeros"))
        file.write(header(b"D", 100 << 20, "p/skipped"))
        for _ in range(100):
            file.write(bytes(1 << 20))
    with pytest.raises(staging.StagingError, match="larger than 5 MB"):
        staging.stage(bomb, tmp_path / "a", 5e6)
    bomb.write_bytes(gzip.compress(header(b"D", 100 << 20, "p/skipped") + bytes(100 << 20) + a_tar(), 1))
    with pytest.raises(staging.StagingError, match="unpacks to more than 11 MB"):
        staging.stage(bomb, tmp_path / "b", 5e6)
    assert not [file for file in tmp_path.glob("[ab]/**/*") if file.is_file()]


def test_memory_and_time_that_a_submission_takes_are_its_fault():
    with pytest.raises(staging.StagingError, match="more than 0.5 GB of memory"), staging.within_bounds(memory=5e8):
        bytearray(10**9)
    with pytest.raises(staging.StagingError, match="takes more than 1 s"), staging.within_bounds(seconds=1):
        while True:
            pass


# ---------------------------------------------------------------------------------------------- manifests

LAUGHS = "<!DOCTYPE p [<!ENTITY a0 'aaaaaaaaaa'>" + "".join(f"<!ENTITY a{i} '{f'&a{i - 1};' * 10}'>" for i in range(1, 12)) + "]>"
MANIFESTS = {
    "laughs": (LAUGHS + "<package><name>&a9;</name></package>", "amplification"),
    "deep": ("<a>" * 400000, "larger than 1 MB"),
    "deep and small": ("<a>" * 100000 + "</a>" * 100000, "no <name>"),
    "open": ("<package><name>p</name>", "no XML"),
    "upwards": ("<package><name>../../../x</name></package>", "has the name"),
    "a line": ("<package><name>a\nb</name></package>", "has the name"),
    "unknown encoding": ('<?xml version="1.0" encoding="no-such"?><package><name>p</name></package>', "no XML"),
    "rot13": ('<?xml version="1.0" encoding="rot13"?><package><name>p</name></package>', "no XML"),
    "zlib": ('<?xml version="1.0" encoding="zlib"?><package><name>p</name></package>', "no XML"),
    "external": ('<!DOCTYPE p [<!ENTITY x SYSTEM "/etc/passwd">]><package><name>&x;</name></package>', "no XML"),
}


@pytest.mark.parametrize("name", MANIFESTS)
def test_every_manifest_ends_as_a_sentence(tmp_path, name):
    text, said = MANIFESTS[name]
    folder = tmp_path / "sub" / "p"
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(text)
    with pytest.raises(staging.StagingError) as caught:
        stage(tmp_path / "sub", tmp_path)
    assert said in str(caught.value) and "\n" not in str(caught.value) and len(str(caught.value)) < 800


def test_a_file_of_two_names_is_both_and_links_are_told(tmp_path):
    """As GNU tar packs a folder with hard links; what a link would bring from elsewhere stays out."""
    folder = tmp_path / "p"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_bytes(MANIFEST)
    (folder / "scripts" / "talk.py").write_text("text")
    (folder / "scripts" / "talk.py").chmod(0o755)
    os.link(folder / "scripts" / "talk.py", folder / "scripts" / "talk2.py")
    os.symlink("talk.py", folder / "scripts" / "talk3.py")
    packed = tmp_path / "sub.tar"
    with tarfile.open(packed, "w") as file:
        file.add(folder, "p")
        for name, to in (("p/passwd", "../../../../etc/passwd"), ("p/absolute", "/etc/passwd"), ("p/early", "p/never")):
            entry = tarfile.TarInfo(name)
            entry.type, entry.linkname = tarfile.LNKTYPE, to
            file.addfile(entry)
    found = stage(packed, tmp_path)
    place = found.packages["p"]
    assert [(place / "scripts" / name).read_text() for name in ("talk.py", "talk2.py")] == ["text", "text"]
    assert os.access(place / "scripts" / "talk2.py", os.X_OK)
    assert sorted(path.name for path in place.rglob("*") if path.is_file()) == ["package.xml", "talk.py", "talk2.py"]
    for name in ("talk3.py: a link to talk.py", "passwd: a link to ../", "absolute: a link to /etc/passwd", "early: a link to p/never"):
        assert any(name in note for note in found.notes), (name, found.notes)


def test_folders_that_are_no_plain_ones(tmp_path):
    folder = tmp_path / "sub" / "p"
    (folder / "closed").mkdir(parents=True)
    (folder / "package.xml").write_bytes(MANIFEST)
    os.mkfifo(folder / "pipe")
    (folder / "package.xml2").mkdir()
    pathlib.Path(os.fsdecode(os.fsencode(folder) + b"/\xff\xfe")).write_text("x")
    deep = folder
    for _ in range(45):
        deep = deep / "d"
        deep.mkdir()
    (folder / "closed").chmod(0)
    found = stage(tmp_path / "sub", tmp_path)
    assert list(found.packages) == ["p"]
    assert any("pipe is no regular file" in note for note in found.notes) and any("30 deep" in note for note in found.notes)
    if os.getuid():
        assert any("closed cannot be read" in note for note in found.notes)
    os.rename(folder / "package.xml", folder / "file")
    (folder / "package.xml").mkdir()
    with pytest.raises(staging.StagingError, match="no package"):
        staging.stage(tmp_path / "sub", tmp_path / "other", LIMIT)
    with pytest.raises(staging.StagingError, match="no regular file"):
        staging.stage(folder / "pipe", tmp_path / "third", LIMIT)


# ---------------------------------------------------------------------------------------------- texts

HARD = {
    "escape sequences": (explain.lines_of, "\x1b]"),
    "escape sequences that end": (explain.lines_of, "\x1b]0;x\x07"),
    "colours": (explain.lines_of, "\x1b[0;"),
    "make": (explain.error_lines, "error: make*** [make*** ["),
    "fatal error": (lambda text: explain.meaning(text[:2000]), "fatal error: a.h"),
    "xacro": (explain.first_cause, "error: xacro: error "),
    "blanks": (explain.refusal, ":        "),
    "brackets": (explain.excerpt, "[ERROR] [["),
    "digits": (explain.excerpt, "error: 1.1.1.1"),
    "comments of C": (similar.of_text, "/*"),
    "comments of XML": (similar.of_text, "<!--"),
    "comments of Python": (similar.of_text, "\n \t #"),
    "tokens": (similar.of_text, "a1.1_"),
}


@pytest.mark.parametrize("name", HARD)
def test_text_is_read_in_proportion_to_its_length(name):
    """300 kB of what patterns stumble over in a second; sixteen times less would take as good as nothing."""
    read, part = HARD[name]
    for joined in (part * (300_000 // len(part)), (part * 400 + "\n") * (300_000 // (400 * len(part)) + 1)):
        begin = time.process_time()
        read(joined)
        assert time.process_time() - begin < 3


def test_what_the_patterns_find_is_the_same():
    assert explain.lines_of("\x1b[31mred\x1b[0m\n\x1b]0;title\x07words\n\n") == ["red", "words"]
    assert explain.error_lines("make[1]: *** [CMakeFiles/Makefile2:99: all] Error 2\nx.cpp:3: error: no") == ["x.cpp:3: error: no"]
    assert explain.error_lines("make: *** [x.o] Error 1") == ["make: *** [x.o] Error 1"]
    assert similar.of_text("a(b); /* x */ " * 30) == similar.of_text("a(b); " * 30)


def test_the_teachers_pattern_on_a_submissions_text_ends():
    begin = time.monotonic()
    assert search("(a+)+$", "a" * 5000 + "b") is None and time.monotonic() - begin < 20
    assert search("b", "abc")


# ---------------------------------------------------------------------------------------------- files


def test_files_are_opened_as_what_they_are(tmp_path):
    (tmp_path / "p" / "launch").mkdir(parents=True)
    (tmp_path / "p" / "launch" / "a.launch").write_text("yes")
    (tmp_path / "secret").write_text("no")
    (tmp_path / "p" / "link").symlink_to(tmp_path / "secret")
    (tmp_path / "p" / "folder").symlink_to(tmp_path)
    os.mkfifo(tmp_path / "p" / "pipe")
    assert untrusted_files.read_regular(tmp_path / "p", "launch/a.launch", 100) == b"yes"
    assert untrusted_files.read_regular(tmp_path / "p", "launch/a.launch", 2) == b"ye"
    for name in ("link", "folder/secret", "pipe", "../secret", str(tmp_path / "secret"), "launch", "absent"):
        with pytest.raises(OSError):
            untrusted_files.read_regular(tmp_path / "p", name, 100)
    assert untrusted_files.matching(tmp_path / "p", "**/*") == ["launch/a.launch"]
    assert untrusted_files.matching(tmp_path / "p", "launch/*.launch") == ["launch/a.launch"]
    assert untrusted_files.matching(tmp_path, "launch/*.launch", anywhere=True) == ["p/launch/a.launch"]
    assert untrusted_files.matching(tmp_path / "p", "*.launch") == [] and untrusted_files.matching(tmp_path / "p", "folder/*") == []


def test_copies_in_archives_are_found_like_those_in_folders(tmp_path):
    code = "\n".join(f"int f{i}(int a) {{ return a * {i} + g{i}(a, {i * 3}); }}" for i in range(60))
    for name in ("carol", "dave"):
        (tmp_path / name / "p").mkdir(parents=True)
        (tmp_path / name / "p" / "x.cpp").write_text(code)
    with zipfile.ZipFile(tmp_path / "alice.zip", "w") as file:
        file.writestr("p/x.cpp", code)
    (tmp_path / "bob.tar.gz").write_bytes(gzip.compress(a_tar(("p/x.cpp", code.encode()))))
    (tmp_path / "eve.zip").write_bytes(b"PK\3\4 no zip")
    names = ("alice.zip", "bob.tar.gz", "carol", "dave", "eve.zip")
    found = {(pair.first, pair.second) for pair in similar.pairs({name: tmp_path / name for name in names})}
    assert found == {(a, b) for a in names[:4] for b in names[:4] if a < b}


# ---------------------------------------------------------------------------------------------- names

NAMES = [
    "class.sqlite",
    "class.sqlite-wal",
    "gradebook.html",
    "gradebook.csv",
    "comparison.html",
    "submissions",
    "javascript:alert(1)",
    "a#b",
    "50%",
    "a?b=c",
    "data:text,x",
    "<img src=x onerror=alert(1)>",
    "a'b\"c",
    "line\nbreak",
    "\x1b]0;title\x07",
    "\u202etxt",
    "n" * 255,
    "\u00e9" * 127,
    "=cmd()",
    " ",
    "&amp;",
    os.fsdecode(b"\xff" * 255),
    "...",
]


class Links(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.found, self.tags = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.found += [value for name, value in attributes if name in ("href", "src")]
        assert not [name for name, _ in attributes if name.startswith("on")]


def test_names_of_submissions_are_names_only(tmp_path):
    """Each is a folder of its own beside the class's files, and a link that leads to its report and nowhere else."""
    class_of = tmp_path / "class"
    class_of.mkdir()
    for name in NAMES:
        (class_of / name).mkdir()
    found = grade.named(sorted(class_of.iterdir()))
    assert len(found) == len(NAMES) and all(name.isprintable() and len(name.encode()) <= 210 for name in found)
    out = tmp_path / "out"
    out.mkdir()
    book = store.Store(out / "class.sqlite")
    for name, path in found.items():
        book.enlist(name, path, "1")
        result = Result("t", str(path))
        result.add(TaskResult("a", 0.0, 0.0))
        book.done(name, result)
        report = grade.results(out) / name / "report.html"
        report.parent.mkdir(parents=True)
        report.write_text(name)
    (tmp_path / "spec.yaml").write_text("title: t\ntasks: [{name: a, launch: '', expect: [{file: {path: x}}]}]\n")
    gradebook.write(spec.load(tmp_path / "spec.yaml"), book, out)
    links = Links((out / "gradebook.html").read_text())
    assert "script" not in links.tags
    read = [(out / urllib.parse.unquote(link)).read_text() for link in links.found if link.endswith("/report.html")]
    assert sorted(read) == sorted(found)
    assert all(not urllib.parse.urlsplit(link).scheme and not urllib.parse.urlsplit(link).netloc for link in links.found)
    assert (out / "class.sqlite").is_file() and (out / "gradebook.csv").is_file()


def test_what_is_shown_on_a_terminal_moves_no_cursor():
    for text in NAMES + ["\x9b31m", "a\rb", "\u2028", "\udcff"]:
        assert shown(text).isprintable() and name_for(text).isprintable()
