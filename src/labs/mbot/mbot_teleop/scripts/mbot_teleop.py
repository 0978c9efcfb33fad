#!/usr/bin/env python3
from keyboard_teleop.node import main

if __name__ == "__main__":
    main()
