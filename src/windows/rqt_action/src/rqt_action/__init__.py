"""Plugin of rqt: shows the definitions of all action types."""
