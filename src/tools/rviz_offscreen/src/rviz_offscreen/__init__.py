"""Pictures from RViz without a display: :mod:`.cli` is the command, :mod:`.grab` runs inside RViz's process."""
