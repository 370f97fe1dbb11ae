"""The only owner of mesh files: read, units, clean, decimate, write."""
