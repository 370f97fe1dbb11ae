"""Results as HTML pages, each in one file."""
