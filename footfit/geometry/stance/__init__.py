"""How a shape stands: the ground under it, and the middle line of its bottom over that ground."""
