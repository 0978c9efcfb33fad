"""Plugin of rqt: shows /diagnostics, errors first."""
