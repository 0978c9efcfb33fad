"""Help for tests of windows.

:mod:`rqt_testing.in_process`: a plugin in the container, in the test's own process, on Qt's offscreen platform: milliseconds.
:mod:`rqt_testing.desktop`: a private X server with a window manager, real commands, clicks and keys: seconds.
"""
