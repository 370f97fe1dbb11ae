"""Lasts made from lasts: custom lasts, graded runs, how two lasts differ; lasts on paper."""
