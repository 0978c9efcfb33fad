"""Choice among several sources of velocity commands, by priority, timeout and locks."""
