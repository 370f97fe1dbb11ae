"""How the measures of a last change from size to size and from width to width."""
