"""What the lists of rules are made of: conditions on a message."""
