"""Plugin of rqt: shows the definitions of all message types."""
