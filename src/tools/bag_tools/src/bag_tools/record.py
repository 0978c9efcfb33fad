"""``rosbag record --mcap``: rosbag's own recorder with all its options, whose bags become MCAP files when it ends."""

from __future__ import annotations

import argparse
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

from node_signals.children import adopt_orphans, wait_for_all

from bag_tools.convert import convert
from bag_tools.files import BagError


def named(arguments: list[str], now: float) -> tuple[list[str], Path]:
    """The recorder's ``arguments`` with a name for its bag, as it would choose it ``now`` (s since the epoch), and that name without
    ending.
    """
    parser = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    parser.add_argument("-O", "--output-name")
    parser.add_argument("-o", "--output-prefix")
    options, rest = parser.parse_known_args(arguments)
    name = options.output_name
    if name is None:
        stamp = time.strftime("%Y-%m-%d-%H-%M-%S", time.localtime(now))
        name = f"{options.output_prefix}_{stamp}" if options.output_prefix else stamp
    stem = name[:-4] if name.endswith(".bag") else name[:-5] if name.endswith(".mcap") else name
    return [*rest, "-O", f"{stem}.bag"], Path(stem)


def bags(stem: Path) -> list[Path]:
    """Of that name, with --split numbered."""
    name = re.compile(re.escape(stem.name) + r"(_\d+)?\.bag")
    return sorted(path for path in stem.parent.glob("*.bag") if name.fullmatch(path.name))


def main(arguments: list[str]) -> int:
    """:returns: exit code of the recorder, or 1 if a bag could not be converted"""
    words, stem = named([word for word in arguments if word != "--mcap"], time.time())
    if any(word in ("-h", "--help") for word in words):
        print("  --mcap                the bags become MCAP files (one for each bag, zstd) when recording ends", flush=True)
        return subprocess.call(["/usr/bin/rosbag", "record", "--help"])
    before = {bag: bag.stat().st_mtime_ns for bag in bags(stem)}
    signal.signal(signal.SIGINT, lambda *_: None)  # the recorder has it as well, and ends; what follows is not interrupted
    adopt_orphans()  # on Ctrl-C rosbag ends at once, while what it has started to record still closes the bag
    recorder = subprocess.Popen(["/usr/bin/rosbag", "record", *words])
    signal.signal(signal.SIGTERM, lambda *_: recorder.send_signal(signal.SIGINT))
    code = recorder.wait()
    wait_for_all()
    for bag in bags(stem):
        if bag.stat().st_mtime_ns == before.get(bag):
            continue
        try:
            count = convert(bag, bag.with_suffix(".mcap"))
        except BagError as error:
            print(f"record: {error}; {bag} is kept", file=sys.stderr)
            code = code or 1
        else:
            bag.unlink()
            print(f"{bag.with_suffix('.mcap')}: {count} messages")
    return code
