"""Lighter copies of a mesh, and how far they lie from the original."""
