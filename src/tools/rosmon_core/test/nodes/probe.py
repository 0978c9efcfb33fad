#!/usr/bin/env python3
"""A process for the tests of rosmon: says things, then ends, waits or misbehaves as its arguments ask."""

import argparse
import os
import signal
import subprocess
import sys
import time

parser = argparse.ArgumentParser()
parser.add_argument("--say", default="hello")
parser.add_argument("--every", type=float, default=0.05)
parser.add_argument("--count", type=int, default=-1)
parser.add_argument("--exit", type=int, default=0)
parser.add_argument("--warn", action="store_true")
parser.add_argument("--die", type=int)
parser.add_argument("--stubborn", action="store_true")
parser.add_argument("--child", action="store_true")
options, _ = parser.parse_known_args()
if options.stubborn:
    signal.signal(signal.SIGINT, signal.SIG_IGN)
if options.child:
    child = subprocess.Popen(["sleep", "1000"])
    print(f"child {child.pid}", flush=True)
said = 0
try:
    while said != options.count:
        said += 1
        print(f"{options.say} {said} tty={os.isatty(1)}", flush=True)
        if options.warn:
            print(f"\x1b[33mwatch out {said}\x1b[0m", file=sys.stderr, flush=True)
        time.sleep(options.every)
    if options.die:
        os.kill(os.getpid(), options.die)
except KeyboardInterrupt:
    print("goodbye", flush=True)
sys.exit(options.exit)
