"""A last for one foot: which base, what it should measure, and how it is made and read again."""
