"""Poses of lasts and feet of every kind: which are accepted, which are wrong, which side."""
