"""One foot in one last: placement, clearance between the surfaces, paired sections, sizes."""
