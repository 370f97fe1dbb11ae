"""Is everything as it was stored: damage, plausible values, the schema compared."""
