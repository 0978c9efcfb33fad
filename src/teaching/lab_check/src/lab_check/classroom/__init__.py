"""Many submissions, who examines them and where, what is known of the class, who copied."""
