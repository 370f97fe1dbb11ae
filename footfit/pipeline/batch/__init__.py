"""Many meshes at a time: which sources there are, worker processes, limits of time and memory."""
