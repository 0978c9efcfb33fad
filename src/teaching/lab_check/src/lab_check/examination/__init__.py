"""One submission, launched and looked at, by processes and what they tell each other."""
