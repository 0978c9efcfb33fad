"""Pictures of what launch files bring up: :mod:`.cli` launches one after the other, :mod:`.visit` takes the pictures."""
