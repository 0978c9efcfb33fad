"""Plugin of rqt: shows /diagnostics_agg as a tree, with the last half minute to look back on."""
