"""Rangers on analogue pins of an ArbotiX board."""
