#!/usr/bin/env python3
"""Takes one number that is not negative, and prints its root."""
import sys

if sys.argv[1:] == ["crash"]:
    raise RuntimeError("as it was told")
try:
    number = float(sys.argv[1])
except (IndexError, ValueError):
    number = -1.0
if number < 0:
    print("usage: picky.py NUMBER, not negative")
    sys.exit(2)
print(f"root {number ** 0.5:.3f}")
