"""How far long work is, in one line that is written over: ``name:  40%|####      | 2/5 tasks [00:12]``.

On a terminal alone: a log, a pipe and a machine without python3-tqdm get nothing of it.
"""

from __future__ import annotations

import contextlib
import sys
import threading
from collections.abc import Iterator
from typing import Any

_EVERY = 1.0  # s after which the time is written anew, also where nothing has been done meanwhile


class Progress:
    """What :func:`progress` gives."""

    def __init__(self, bar: Any) -> None:
        self._bar = bar  # of tqdm; None shows nothing

    @property
    def shown(self) -> bool:
        """Whether anybody sees it."""
        return self._bar is not None

    def update(self, number: int = 1) -> None:
        """So many more, ``number``, are done."""
        if self._bar is not None:
            self._bar.update(number)

    def at(self, number: int, now: str = "") -> None:
        """So many, ``number``, are done in all, and this is done ``now``."""
        if self._bar is not None:
            self._bar.set_postfix_str(now, refresh=False)
            self._bar.update(number - self._bar.n)
            self._bar.refresh()

    def line(self, text: str) -> None:
        """``text``, a line of the command's output, which the bar makes room for."""
        if self._bar is None:
            print(text, flush=True)
        else:
            self._bar.write(text)


@contextlib.contextmanager
def progress(count: int | None, name: str, unit: str = "", quiet: bool = False, even: bool = False) -> Iterator[Progress]:
    """
    :param count: how many there are to be done; None: not known
    :param name: of the work. :param unit: what is counted, a plural. :param quiet: show nothing
    :param even: one takes about as long as another, so that the time that is left can be told
    """
    bar = None if quiet or not sys.stderr.isatty() else _bar(count, name, unit, even)
    if bar is None:
        yield Progress(None)
        return
    over = threading.Event()

    def tick() -> None:
        while not over.wait(_EVERY):
            bar.refresh()

    thread = threading.Thread(target=tick, daemon=True)
    thread.start()
    try:
        yield Progress(bar)
    finally:
        over.set()
        thread.join()
        bar.close()


def _bar(count: int | None, name: str, unit: str, even: bool) -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    tqdm.monitor_interval = 0  # its own thread for what is updated too seldom; ours does that
    time = "{elapsed}<{remaining}" if even else "{elapsed}"
    known = "{desc}: {percentage:3.0f}%|{bar:20}| {n_fmt}/{total_fmt}{unit} [" + time + "]{postfix}"
    form = known if count else "{desc}: {n_fmt}{unit} [{elapsed}]{postfix}" if unit else "{desc} [{elapsed}]{postfix}"
    return tqdm(total=count, desc=name, unit=f" {unit}" if unit else "", bar_format=form, leave=False, dynamic_ncols=True, file=sys.stderr)
