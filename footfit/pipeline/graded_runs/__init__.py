"""Graded runs: rules, sizes, the lasts of a run, and whether somebody's run is even."""
