"""The flare of a bottom: its outline, its centre line, and the curvature along them."""
