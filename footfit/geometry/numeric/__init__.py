"""Arrays, angles, rotations, planes, smoothing, polylines and quantiles; nothing about meshes."""
