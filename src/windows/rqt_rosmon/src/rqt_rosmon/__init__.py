"""Plugin of rqt: shows what rosmon launched; starts, stops and restarts it."""
