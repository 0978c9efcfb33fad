"""How scripts/package makes Debian packages: the installed tree, upstream's names, the packages and their repository."""
