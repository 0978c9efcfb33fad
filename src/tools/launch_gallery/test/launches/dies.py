#!/usr/bin/env python3
raise SystemExit("the board is not plugged in")
