"""Lasts against lasts: twins, labels that the shapes contradict, runs that break."""
