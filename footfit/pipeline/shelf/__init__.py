"""The shelf: the lasts that a match is asked of, by column, after filters and stock."""
