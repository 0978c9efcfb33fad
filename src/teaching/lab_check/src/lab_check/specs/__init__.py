"""The files that a teacher writes, what to ask of a submission, what to vary in a sweep."""
