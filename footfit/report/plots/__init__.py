"""Plots of many feet and many lasts: scatters, curves and histograms."""
