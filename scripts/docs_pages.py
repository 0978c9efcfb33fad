"""scripts/docs_pages.py FOLDER: what mkdocs makes the site of: docs/ and the pages of the top folder, in an order, links mended.

On GitHub the pages are read as they stand. On the site README is the first page, and links to files that are no pages lead to the
repository's own address, or are words where it has none.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import docs_tried
import yaml

ROOT = Path(__file__).resolve().parent.parent
#: (title, pages) in the order in which they are read
ORDER = [
    ("Start", ["README.md", "docs/start.md"]),
    ("Courses", ["docs/robots.md", "docs/moveit_tutorial.md"]),
    ("Bring your package", ["docs/guide.md"]),
    ("Windows", ["docs/windows.md", "docs/other_tools.md"]),
    ("Teaching", ["docs/grading.md"]),
    ("Hardware", ["docs/hardware.md"]),
    (
        "Differences",
        [
            "docs/differences.md",
            "docs/differences/simulation.md",
            "docs/differences/control.md",
            "docs/differences/planning.md",
            "docs/differences/windows.md",
            "docs/differences/hardware.md",
            "docs/differences/tools.md",
        ],
    ),
    ("Measured", ["docs/performance.md", "docs/parity.md"]),
    ("For developers", ["CONTRIBUTING.md", "docs/architecture.md", "docs/fuzzing.md", "CHANGELOG.md"]),
]
#: code, in which nothing is a link, or a picture's mark, title and target
_LINK = re.compile(r"```.*?```|`[^`\n]*`|(!?)\[([^\]]*)\]\(([^()\s]+(?:\([^()]*\))?)\)", re.S)


def pages(root=ROOT):
    """Every page of the site, as its path below ``root``: those of the order, and the decisions."""
    listed = [Path(page) for _, chapter in ORDER for page in chapter]
    return listed + sorted(path.relative_to(root) for path in (root / "docs/decisions").glob("*.md"))


def place(page):
    """Where a page stands on the site."""
    if page == Path("README.md"):
        return Path("index.md")
    if page == docs_tried.DATA:
        return docs_tried.PAGE
    return page.relative_to("docs") if page.parts[0] == "docs" else page


def links(text):
    """(title, target) of each link and picture outside of code."""
    return [(title, target) for _, title, target in _LINK.findall(text) if target]


def repository():
    """The address under which files are read, or None: that of the remote, where it is a public host's."""
    remote = subprocess.run(["git", "remote", "get-url", "origin"], cwd=ROOT, capture_output=True, text=True).stdout.strip()
    found = re.fullmatch(r"(?:https://|git@)([\w.-]+)[:/]([\w.-]+/[\w.-]+?)(?:\.git)?", remote)
    return f"https://{found[1]}/{found[2]}" if found else None


def on_the_site(page, text, known, address):
    """The page's text with links as the site needs them; ``known``: pages and the files that go with them."""

    def mended(match):
        picture, title, target = match.groups()
        if target is None or re.match(r"[a-z]+:|#", target):
            return match[0]
        file, _, anchor = target.partition("#")
        path = Path(os.path.normpath(page.parent / file))
        if path in known:
            there = os.path.relpath(place(path), place(page).parent)
            return f"{picture}[{title}]({there}{'#' + anchor if anchor else ''})"
        return f"[{title}]({address}/blob/main/{path})" if address else title

    return _LINK.sub(mended, text)


def _entry(page):
    """In the navigation: pages of differences have long titles that begin alike."""
    return {page.stem.capitalize(): str(place(page))} if page.parent.name == "differences" else str(place(page))


def write(folder):
    """Lays the pages, pictures and mkdocs.yml out in ``folder``, which is made anew."""
    shutil.rmtree(folder, ignore_errors=True)
    content = folder / "pages"
    tracked = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "docs"],
        cwd=ROOT,
        check=True,
        capture_output=True,
        text=True,
    )
    beside = {Path(name) for name in tracked.stdout.split("\0") if name.endswith((".png", ".jpg", ".svg", ".gif", ".webp", ".html"))}
    known, address = {*pages(), *beside, docs_tried.DATA}, repository()
    for path in sorted(known):
        target = content / place(path)
        target.parent.mkdir(parents=True, exist_ok=True)
        if path == docs_tried.DATA:
            target.write_text(docs_tried.page(ROOT))
        elif path.suffix == ".md":
            target.write_text(on_the_site(path, (ROOT / path).read_text(), known, address))
        else:
            shutil.copy(ROOT / path, target)
    nav = [{title: [_entry(Path(page)) for page in chapter]} for title, chapter in ORDER]
    nav[1]["Courses"].insert(1, str(docs_tried.PAGE))
    nav[-1]["For developers"] += [str(place(page)) for page in pages() if page.parent.name == "decisions"]
    if (ROOT / "out/reference").is_dir():
        shutil.copytree(ROOT / "out/reference", content / "reference")
        nav.insert(-1, {"Reference": "reference/index.html"})
    site = {
        "site_name": "noetic_labs",
        "docs_dir": "pages",
        "use_directory_urls": False,
        "nav": nav,
        "plugins": ["search"],
        "theme": {
            "name": "material",
            "font": False,
            "features": ["navigation.sections", "navigation.top", "toc.follow", "search.highlight", "search.suggest"],
        },
        "markdown_extensions": ["tables", "attr_list", "sane_lists", {"toc": {"permalink": True}}, "fenced_code"],
    }
    (folder / "mkdocs.yml").write_text(yaml.safe_dump(site, sort_keys=False))


if __name__ == "__main__":
    write(Path(sys.argv[1]).resolve())
