"""From raw triangles to a mesh: equal corners welded, each triangle once, spikes pressed back."""
