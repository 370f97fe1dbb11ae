"""The only owner of mesh files: read, weld, units, decimate, write."""
