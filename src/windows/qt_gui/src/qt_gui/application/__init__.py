"""What upstream's modules do not have (the command line, dialogs, what goes wrong, the way in from other programs)."""
