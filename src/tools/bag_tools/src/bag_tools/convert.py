"""One kind of bag into another."""

from __future__ import annotations

import contextlib
import os
import shutil
import sys
import tempfile
from pathlib import Path

from node_signals.progress import progress

from bag_tools.files import BAG_COMPRESSIONS, MCAP_COMPRESSIONS, BagError, BagSink, BagSource, McapSink, McapSource

KINDS = {".bag": "a bag of ROS 1", ".mcap": "an MCAP file of ROS 1 messages"}  # by ending; without one: the folder of a bag of ROS 2
USUAL = {".bag": "none", ".mcap": "zstd"}  # compression
ROS2_VERSION = 9  # of metadata.yaml, as in ROS 2 Jazzy


def convert(source: Path, target: Path, compression: str | None = None, storage: str = "mcap", quiet: bool = True) -> int:
    """Every message of ``source`` in ``target``, which appears when it is whole. :returns: how many, of ROS 1; else 0

    :param compression: of the target; None: zstd in MCAP, none else
    :param storage: of a bag of ROS 2, mcap or sqlite3
    :param quiet: no progress bar
    :raises BagError: in one line
    """
    _check(source, target, compression)
    folder = Path(tempfile.mkdtemp(prefix=f".{target.name}.", dir=target.parent))  # beside it: renaming costs nothing
    made = folder / target.name
    try:
        if source.is_dir() or not target.suffix:
            count = _with_ros2(source, made, folder, compression, storage, quiet)
        else:
            count = _copy(source, made, compression, quiet)
        os.replace(made, target)
        return count
    except OSError as error:
        raise BagError(f"{error.filename or target}: {error.strerror or error}") from None
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _check(source: Path, target: Path, compression: str | None) -> None:
    if not source.exists():
        raise BagError(f"there is no {source}")
    if source.is_dir() and not (source / "metadata.yaml").exists():
        raise BagError(f"{source} is a folder without metadata.yaml, so no bag of ROS 2")
    if not source.is_dir() and source.suffix not in KINDS:
        raise BagError(f"{source}: it should end in {' or '.join(KINDS)}, or be the folder of a bag of ROS 2")
    if target.suffix and target.suffix not in KINDS:
        raise BagError(f"{target}: it should end in {' or '.join(KINDS)}, or have no ending, for the folder of a bag of ROS 2")
    if target.exists():
        raise BagError(f"{target} is there already; move it away or give another name")
    if not target.parent.is_dir():
        raise BagError(f"there is no folder {target.parent}")
    if source.is_dir() and not target.suffix:
        raise BagError("a bag of ROS 2 becomes a .bag or .mcap of ROS 1")
    known = {".bag": set(BAG_COMPRESSIONS), ".mcap": set(MCAP_COMPRESSIONS)}.get(target.suffix, {"none", "zstd"})
    if compression is not None and compression not in known:
        raise BagError(f"{target.suffix or 'a bag of ROS 2'} cannot be compressed by {compression}, but by {', '.join(sorted(known))}")


def _open(path: Path) -> BagSource | McapSource:
    return BagSource(path) if path.suffix == ".bag" else McapSource(path)


def _copy(source: Path, target: Path, compression: str | None, quiet: bool) -> int:
    count = 0
    chosen = compression or USUAL[target.suffix]
    with (
        _open(source) as messages,
        BagSink(target, chosen) if target.suffix == ".bag" else McapSink(target, chosen) as sink,
        progress(messages.count, source.name, "messages", quiet, even=True) as bar,
    ):
        for channel, stamp, data in messages:
            sink.write(channel, stamp, data)
            count += 1
            bar.update()
    return count


def _with_ros2(source: Path, target: Path, folder: Path, compression: str | None, storage: str, quiet: bool) -> int:
    """From or to a bag of ROS 2, by way of a bag of ROS 1 where the other is MCAP."""
    between = folder / "between.bag"
    if source.is_dir():
        direct = target.suffix == ".bag"
        _by_rosbags(source, target if direct else between, compression if direct else None, storage)
        return 0 if direct else _copy(between, target, compression, quiet)
    count = 0
    if source.suffix == ".mcap":
        count = _copy(source, between, None, quiet)
    else:
        with BagSource(source) as bag:  # for its own line where it cannot be read
            count = bag.count
    _by_rosbags(between if source.suffix == ".mcap" else source, target, compression, storage)
    return count


def _by_rosbags(source: Path, target: Path, compression: str | None, storage: str) -> None:
    from rosbags.convert import ConverterError
    from rosbags.convert import convert as rosbags_convert
    from rosbags.typesys import Stores, get_typestore

    try:
        with contextlib.redirect_stdout(sys.stderr):
            rosbags_convert(
                [source],
                target,
                storage,
                ROS2_VERSION,
                None if compression in (None, "none") else compression,
                "file",
                get_typestore(Stores.ROS2_HUMBLE) if source.is_dir() else None,
                None,
                (),
                (),
                (),
                (),
            )
    except (ConverterError, AssertionError) as error:
        raise BagError(f"{source.name} cannot be converted: {' '.join(str(error).split())[:300]}") from None
    if not target.exists():
        raise BagError(f"{source.name} holds no messages; nothing was written")
