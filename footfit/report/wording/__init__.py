"""Numbers and names in the words that people read."""
