"""Search blocks: what ranking reads of many lasts, packed, with one hash for each part."""
