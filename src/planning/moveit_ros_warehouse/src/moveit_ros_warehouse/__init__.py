"""Robot states by name, in a local file: :mod:`.storage`, and the services that offer it: :mod:`.services`."""
