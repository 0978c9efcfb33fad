"""What holds for all tests: how long Hypothesis takes for one example depends on what else the machine does, and fails none."""

try:
    from hypothesis import settings
except ImportError:  # a machine without the packages for tests
    pass
else:
    settings.register_profile("workspace", deadline=None)
    settings.load_profile("workspace")
