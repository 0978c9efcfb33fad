"""Semantic robot descriptions: :mod:`srdfdom.srdf`."""
