"""What keeps a submission in its place (namespaces, control groups, system calls, files that are looked at)."""
