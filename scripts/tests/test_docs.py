"""The documentation: links lead somewhere, every page has its place on the site, what a student looks for is found by its words."""

import re
import shutil
import subprocess
from pathlib import Path

import docs_pages
import docs_tried
import pytest

ROOT = docs_pages.ROOT
READ_ON_GITHUB = [
    Path(name)
    for name in subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.md"],
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    ).stdout.split("\0")
    if name and (ROOT / name).is_file()
]


def anchors(text):
    """As GitHub makes them of headings: small letters, no punctuation, blanks as hyphens."""
    bare = re.sub(r"```.*?```", "", text, flags=re.S)
    headings = [re.sub(r"`|\[([^\]]*)\]\([^)]*\)", r"\1", line) for line in re.findall(r"^#+ +(.*)$", bare, re.M)]
    return {re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", READ_ON_GITHUB, ids=str)
def test_links_lead_somewhere(page):
    for title, target in docs_pages.links((ROOT / page).read_text()):
        if re.match(r"[a-z]+:", target):
            continue
        file, _, anchor = target.partition("#")
        path = (ROOT / page).parent / file if file else ROOT / page
        assert path.exists(), f"[{title}]({target})"
        if anchor and path.suffix == ".md":
            assert anchor in anchors(path.read_text()), f"[{title}]({target})"


def test_every_picture_is_shown():
    shown = set()
    for page in READ_ON_GITHUB:
        shown |= {((ROOT / page).parent / target).resolve() for _, target in docs_pages.links((ROOT / page).read_text())}
    shown |= {ROOT / "docs/pictures/robots" / row["picture"] for row in tried() if "picture" in row}
    pictures = {path for path in (ROOT / "docs" / "pictures").rglob("*") if path.is_file()}
    assert {str(path.relative_to(ROOT)) for path in pictures - shown} == set()


def tried():
    """Every row of docs/tried.yaml."""
    return [row for group in docs_tried.read(ROOT) for row in group["rows"]]


def test_what_was_tried_has_its_columns_and_pictures():
    for group in docs_tried.read(ROOT):
        for row in group["rows"]:
            assert set(row) <= {*group["columns"], "source", "picture"}, row
            assert row.get(group["columns"][0]), row
            assert (ROOT / "docs/pictures/robots" / row.get("picture", "")).exists(), row


def test_the_page_of_what_was_tried_has_each_row():
    page = docs_tried.page(ROOT)
    tables = [line for line in page.splitlines() if line.startswith("| ")]
    assert len(tables) == len(tried()) + len(docs_tried.read(ROOT))
    for group in docs_tried.read(ROOT):
        assert f"| {' | '.join(group['columns'])} |" in page
    cells = {line.count("|") for line in tables}
    assert cells == {len(group["columns"]) + 1 for group in docs_tried.read(ROOT)}, "a cell with a bar in it"


def test_every_page_of_docs_is_on_the_site():
    assert set(docs_pages.pages()) >= {path for path in READ_ON_GITHUB if path.parts[0] == "docs" and "examples" not in path.parts}


def test_a_page_keeps_its_links_on_the_site():
    known = {Path("README.md"), Path("docs/start.md"), Path("docs/pictures/arm.png")}
    text = (
        "[start](docs/start.md#the-labs) ![arm](docs/pictures/arm.png) [code](src/a.py) [out](https://ros.org) [up](#top) "
        "`[a](docs/start.md)`"
    )
    assert docs_pages.on_the_site(Path("README.md"), text, known, None) == (
        "[start](start.md#the-labs) ![arm](pictures/arm.png) code [out](https://ros.org) [up](#top) `[a](docs/start.md)`"
    )
    assert docs_pages.on_the_site(Path("docs/start.md"), "[top](../README.md) [code](../src/a.py)", known, "https://host/us/labs") == (
        "[top](index.md) [code](https://host/us/labs/blob/main/src/a.py)"
    )


@pytest.mark.parametrize(
    "words",
    [
        "my joint does not move",
        "RViz crashes",
        "TF_REPEATED_DATA",
        "roscore is not running",
        "No p gain specified for pid",
        "Could not load controller",
        "unable to contact my own server",
        "No module named",
    ],
)
def test_what_a_student_looks_for_stands_in_the_guide(words):
    assert words in (ROOT / "docs/guide.md").read_text()


@pytest.mark.slow
@pytest.mark.skipif(not shutil.which("mkdocs"), reason="mkdocs is not installed (apt install mkdocs mkdocs-material)")
def test_the_site_is_built_without_a_warning_and_asks_nobody_for_anything(tmp_path):
    docs_pages.write(tmp_path / "pages")
    built = subprocess.run(
        ["mkdocs", "build", "--strict", "--config-file", tmp_path / "pages/mkdocs.yml", "--site-dir", tmp_path / "site"],
        capture_output=True,
        text=True,
    )
    assert built.returncode == 0, built.stderr
    index = (tmp_path / "site/index.html").read_text()
    assert re.findall(r'(?:src|href)="(?:https?:)?//(?!squidfunk)[^"]*\.(?:js|css|woff2?)', index) == []
    assert 'data-md-component="search-query"' in index
    pages = (tmp_path / "site/search/search_index.json").read_text()
    assert "No p gain specified" in pages
