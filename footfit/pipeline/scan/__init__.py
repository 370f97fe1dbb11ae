"""From one source to its results: read, prepare, align, measure, profile."""
