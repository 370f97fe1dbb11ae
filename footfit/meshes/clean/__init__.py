"""From raw triangles to a surface: welded, without debris, wound outward."""
