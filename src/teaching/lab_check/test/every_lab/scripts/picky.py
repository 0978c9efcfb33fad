#!/usr/bin/env python3
"""Takes one number that is not negative, and prints its root; some words in its place end it in other ways."""

import os
import sys

if sys.argv[1:] == ["crash"]:
    raise RuntimeError("as it was told")
if sys.argv[1:] == ["abort"]:
    os.abort()
if sys.argv[1:] == ["told"]:
    print("Usage: picky.py NUMBER")
    sys.exit(0)
if sys.argv[1:] == ["mute"]:
    print("root 0.000")
    sys.exit(0)
try:
    number = float(sys.argv[1])
except (IndexError, ValueError):
    number = -1.0
if number < 0:
    print("usage: picky.py NUMBER, not negative")
    sys.exit(2)
print(f"root {number**0.5:.3f}")
