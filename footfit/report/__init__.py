"""Takes results, gives text or bytes: tables, JSON, CSV, HTML, pictures. Opens no file."""
