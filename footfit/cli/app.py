"""The application: every command, and the one boundary where an error becomes a line."""

from __future__ import annotations


def main() -> None:
    """Run the command line."""
