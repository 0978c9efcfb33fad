"""Files that somebody reads while they are saved again: a world that loads a model which an editor has open."""

from __future__ import annotations

import contextlib
import os


def write_whole(path: str, text: str) -> None:
    """Write a file so that whoever reads it sees the old text or the new one, nothing in between.

    :raises OSError: it cannot be written; ``filename`` is ``path``, and what was there is still there
    """
    target = os.path.realpath(path)
    temporary = os.path.join(os.path.dirname(target), f".{os.path.basename(target)}.{os.getpid()}")
    try:
        try:
            with open(temporary, "w", encoding="utf-8") as stream:
                stream.write(text)
            os.replace(temporary, target)
        except BaseException:
            with contextlib.suppress(OSError):
                os.unlink(temporary)
            raise
    except OSError as error:
        raise OSError(error.errno, error.strerror, path) from None
