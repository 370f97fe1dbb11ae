"""Scripts that make what the project ships: reference shapes and sample data. Not in the wheel."""
