"""Pictures of the documentation, made anew from this tree: see scripts/pictures --help."""
