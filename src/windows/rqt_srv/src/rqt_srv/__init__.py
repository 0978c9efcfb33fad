"""Plugin of rqt: shows the definitions of all service types."""
