"""Curvature of a surface at each vertex (the paper's III.C), and pooling over the surface."""
