"""Planners compared on stored queries: what to run (:mod:`.options`), running it (:mod:`.executor`), the logs (:mod:`.log`)."""
