"""The library of lasts: manifest, ingest, list and edit, check, back up, upgrade."""
