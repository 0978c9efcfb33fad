"""Plugin of rqt: loads, starts, stops and unloads controllers."""
