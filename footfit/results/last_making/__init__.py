"""Lasts made from lasts: custom lasts, graded runs, and how two lasts differ."""
