"""The compact copy of a mesh, and how far it lies from the original."""
