"""Results as rich renderables for a terminal."""
