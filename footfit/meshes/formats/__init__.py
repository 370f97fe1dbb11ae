"""One file a mesh format: bytes in, raw vertices and faces out."""
