"""Outlines in true size: the shadow of a shape, its bottom laid flat, its sections."""
