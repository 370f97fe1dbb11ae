"""From any pose to the canonical frame: pieces, floor plate, pose search, sole plane, side."""
