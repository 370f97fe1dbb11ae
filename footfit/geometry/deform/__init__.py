"""Smooth changes of a last: lengths, widths, heights and flare along its bottom's own arc."""
