"""Faults on purpose: kills, power cuts, failing system calls, full disks, damage, signals.

Each module has one function ``*_trials(folder, count, seed) -> Tally``. The tests run a tenth of
each; ``python -m tests.torture`` runs them all and prints a table.
"""
