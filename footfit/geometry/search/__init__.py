"""The pose of a shape among all poses: rotations tried, fitted to templates, and compared."""
