"""Many lasts by column: what ranking reads of them, without an object for each last."""
