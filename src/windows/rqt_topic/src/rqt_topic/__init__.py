"""Plugin of rqt: shows all topics with type, bandwidth, rate and values."""
