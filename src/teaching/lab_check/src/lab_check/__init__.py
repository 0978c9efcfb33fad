"""Marks for robots: see docs/grading.md. ``cli`` is the command line, ``examiner`` runs one submission, ``spec`` reads what to ask."""
