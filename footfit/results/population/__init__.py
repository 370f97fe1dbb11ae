"""Answers about many feet and about all lasts of a catalogue."""
