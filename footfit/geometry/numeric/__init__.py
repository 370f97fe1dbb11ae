"""Arrays, angles, rotations, smoothing, polylines and quantiles: no mesh is known here."""
