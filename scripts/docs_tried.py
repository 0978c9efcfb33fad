"""The page of the site that shows docs/tried.yaml: its tables, with a filter over all of them."""

from pathlib import Path

import yaml

DATA = Path("docs/tried.yaml")
PAGE = Path("tried.md")  # on the site
_HEAD = """# Robots and packages, tried

[What the robots' motion shows](robots.md). Words that a row has to have, in any order:

<input id="filter" type="search" placeholder="ur5 gripper" aria-label="Filter"
  style="font-size: 1rem; padding: .3rem; width: 100%; border: 1px solid">
<p id="found" role="status"></p>
"""
_SCRIPT = """
<script>
(() => {
  const field = document.getElementById("filter"), said = document.getElementById("found");
  const rows = [...document.querySelectorAll("article table tbody tr")].map(row => [row, row.textContent.toLowerCase()]);
  const show = () => {
    const words = field.value.toLowerCase().split(/\\s+/).filter(Boolean);
    let count = 0;
    for (const [row, text] of rows) {
      row.hidden = !words.every(word => text.includes(word));
      count += !row.hidden;
    }
    for (const table of document.querySelectorAll("article table")) {  // what has no row left goes with its heading
      const empty = ![...table.querySelectorAll("tbody tr")].some(row => !row.hidden);
      let part = table.closest(".md-typeset__scrollwrap") ?? table;
      for (; part && part.tagName !== "H1" && part.id !== "found"; part = part.previousElementSibling) {
        part.style.display = empty ? "none" : "";
        if (part.tagName === "H2") break;
      }
    }
    said.textContent = `${count} of ${rows.length}`;
  };
  field.addEventListener("input", show);
  show();
})();
</script>
"""


def _cell(value) -> str:
    text = "<br>".join(map(str, value)) if isinstance(value, list) else str(value)
    return text.replace("|", "&#124;").replace("\n", " ")


def _first(row: dict, column: str) -> str:
    """A robot's cell has its source and its picture, too."""
    parts = [f"**{_cell(row[column])}**" if "source" in row else _cell(row[column])]
    if "source" in row:
        parts.append(_cell(row["source"]))
    if "picture" in row:
        parts.append(f"![{row[column]}](pictures/robots/{row['picture']})")
    return "<br>".join(parts)


def read(root: Path) -> list[dict]:
    """The groups of the data below ``root``: each with its ``group`` (a title), ``about``, ``columns`` and ``rows``."""
    return yaml.safe_load((root / DATA).read_text(encoding="utf-8"))


def page(root: Path) -> str:
    """The page as Markdown."""
    parts = [_HEAD]
    for group in read(root):
        columns = group["columns"]
        lines = [f"| {' | '.join(columns)} |", f"|{'---|' * len(columns)}"]
        for row in group["rows"]:
            lines.append(f"| {' | '.join([_first(row, columns[0]), *(_cell(row.get(column, '-')) for column in columns[1:])])} |")
        parts.append(f"## {group['group']}\n\n{group['about']}\n\n" + "\n".join(lines) + "\n")
    return "\n".join(parts) + _SCRIPT
