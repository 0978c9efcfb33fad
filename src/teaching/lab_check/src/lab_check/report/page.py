"""The report that a student reads."""

from __future__ import annotations

import base64
import html
import io
import os
import pathlib

from ..outcome import Result, TaskResult, readable
from ..specs.spec import Spec

STYLE = """body {font: 16px/1.45 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222}
h1 {margin-bottom: 0} h2 {margin: 1.6em 0 .3em; border-top: 1px solid #ccc; padding-top: .8em}
.marks {font-size: 140%} .points {float: right; color: #555} ul {padding-left: 1.2em; list-style: none}
.yes::before {content: "\\2713\\00a0"; color: #18794e; font-weight: bold}
.no::before {content: "\\2717\\00a0"; color: #c0282d; font-weight: bold}
pre {background: #f4f4f2; padding: .6em; overflow-x: auto; font-size: 82%} img, video {max-width: 100%; border: 1px solid #ddd}
.hint {background: #fff7da; padding: .5em .8em} .fault {background: #fde3e3; padding: .6em} .note {color: #555; font-size: 90%}
table {border-collapse: collapse} td, th {padding: .2em .7em; border-bottom: 1px solid #ddd; text-align: left} td.n {text-align: right}
figure {margin: .6em 0; display: inline-block; vertical-align: top; width: 49%}"""


def page(result: Result, spec: Spec, out: pathlib.Path) -> str:
    """HTML of ``result``, of an examination by ``spec``, that stands beside its pictures and films in ``out``."""
    title = f"{result.title}: {os.path.basename(result.submission)}"
    parts = [
        f"<h1>{_e(result.title)}</h1><p class=note>{_e(os.path.basename(result.submission))}</p>",
        f"<p class=marks>{'<b>not examined</b>' if result.fault else f'<b>{result.points:g}</b> of {result.of:g} points'}</p>",
    ]
    if result.fault:
        parts.append(
            f"<p class=fault>The checker itself failed; this says nothing about your work. Tell your teacher: {_e(result.fault)}</p>"
        )
    rows = "".join(
        f"<tr><td><a href='#t{n}'>{_e(t.name)}</a><td class=n>{t.points:g}<td class=n>of {t.of:g}" for n, t in enumerate(result.tasks)
    )
    parts.append(f"<table>{rows}</table>")
    parts += [f"<p class=note>{_e(note)}</p>" for note in result.notes]
    parts += [_task(number, task, result, out) for number, task in enumerate(result.tasks)]
    parts.append(
        f"<p class=note>Sandbox: {_e(result.sandbox)}. The same submission gets the same marks in every run: simulated time passes in "
        f"steps of {spec.data['quantum']:g} s and seed {spec.data['seed']}, however fast the machine is.</p>"
    )
    return (
        f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">'
        f"<title>{_e(title)}</title>"
        f"<style>{STYLE}</style>\n" + "\n".join(parts) + "\n</html>\n"
    )


def _e(text: str) -> str:
    return html.escape(readable(str(text)))


def _task(number: int, task: TaskResult, result: Result, out: pathlib.Path) -> str:
    good = all(v.passed for v in task.verdicts)
    parts = [f"<h2 id=t{number}>{_e(task.name)} <span class=points>{task.points:g} of {task.of:g}</span></h2>"]
    items = "".join(
        f"<li class={'yes' if v.passed else 'no'}>{_e(v.reason)}" + (f" <span class=note>({v.points:g} of {v.of:g})</span>" if v.of else "")
        for v in task.verdicts
    )
    parts.append(f"<ul>{items}</ul>")
    if task.hint and not good:
        parts.append(f"<p class=hint>{_e(task.hint)}</p>")
    if not good and task.log:
        parts.append(f"<details open><summary>From the log, first cause first</summary><pre>{_e(chr(10).join(task.log))}</pre></details>")
    if not good and task.commands:
        parts.append(
            "<details open><summary>To see it yourself, each line in a terminal where devel/setup.bash is sourced</summary>"
            f"<pre>{_e(chr(10).join(task.commands))}</pre></details>"
        )
    figures = [
        f'<figure><img src="{_e(os.path.relpath(p, out))}" alt="The end of this task"></figure>' for p in task.pictures if os.path.exists(p)
    ]
    if task.film and os.path.exists(task.film):
        figures.append(f'<figure><video controls loop muted src="{_e(os.path.relpath(task.film, out))}"></video></figure>')
    plot = drawn(task.series)
    if plot:
        figures.append(f'<figure><img src="data:image/svg+xml;base64,{plot}" alt="{_e(", ".join(task.series))} over time"></figure>')
    return "\n".join(parts + figures)


def drawn(series: dict[str, list[list[float]]]) -> str:
    """The curves of ``series``, points (s, value) by name, as an SVG in base64; '' when there is nothing to draw."""
    series = {name: points for name, points in series.items() if len(points) > 1}
    if not series:
        return ""
    import matplotlib

    matplotlib.use("svg")
    matplotlib.rcParams["svg.hashsalt"] = "lab_check"
    from matplotlib.figure import Figure

    figure = Figure(figsize=(5.6, 3.4), layout="constrained")
    axes = figure.add_subplot()
    for name, points in series.items():
        axes.plot([p[0] for p in points], [p[1] for p in points], label=name, linewidth=1.2)
    axes.set_xlabel("simulated time, s")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    out = io.BytesIO()
    figure.savefig(out, format="svg", metadata={"Date": None})
    return base64.b64encode(out.getvalue()).decode()
