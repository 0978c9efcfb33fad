"""Valenti's complementary filter (R. Valenti, I. Dryanovski, J. Xiao, 2015), from C++."""

from ._filter import Complementary

__all__ = ["Complementary"]
