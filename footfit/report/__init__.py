"""Results in, text or bytes out: tables, JSON, CSV, HTML, pictures. Opens no file."""
