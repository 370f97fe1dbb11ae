"""What wearers say of their shoes: how ratings are read, and what a profile learns from them."""
