"""Triangle surfaces: areas, topology, sections, outlines, samples, moments, holes, caps."""
