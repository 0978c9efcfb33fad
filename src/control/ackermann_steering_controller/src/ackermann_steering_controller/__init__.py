"""Car-like steering."""
