"""The page that shows the pictures."""

from __future__ import annotations

import html
from dataclasses import dataclass, field

_STYLE = """body {font: 15px sans-serif; max-width: 1200px; margin: 2em auto; padding: 0 1em}
img {max-width: 100%; border: 1px solid #ccc}
figure {display: inline-block; width: 48%; margin: 0.5%; vertical-align: top}
figcaption, .note {color: #555; font-size: 90%}"""


@dataclass
class Entry:
    """What came of one launch file: ``pictures`` are (file name, caption), ``notes`` say what is missing."""

    name: str
    command: str
    pictures: list[tuple[str, str]] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


def render(title: str, entries: list[Entry]) -> str:
    """HTML of ``entries`` under ``title`` that stands beside the pictures."""
    sections = []
    for entry in entries:
        figures = "\n".join(
            f'<figure><a href="{name}"><img src="{name}" alt="{caption}"></a><figcaption>{caption}</figcaption></figure>'
            for name, caption in (map(html.escape, picture) for picture in entry.pictures)
        )
        notes = "\n".join(f'<p class="note">{html.escape(note)}</p>' for note in entry.notes)
        sections.append(f"<h2>{html.escape(entry.name)}</h2>\n<pre>{html.escape(entry.command)}</pre>\n{notes}\n{figures}")
    title = html.escape(title)
    return (
        f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>{title}</title>\n<style>{_STYLE}</style>\n'
        f"<h1>{title}</h1>\n" + "\n".join(sections) + "\n</html>\n"
    )
