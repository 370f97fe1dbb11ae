"""How wide a foot is: the width fitting of its size, and its place among a survey's people."""
