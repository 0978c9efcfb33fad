"""Planning in RViz without a panel of its own: markers that RViz's stock displays show. See :mod:`.node`."""
