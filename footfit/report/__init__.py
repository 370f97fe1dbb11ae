"""Results in, text or bytes out: tables, JSON, CSV, HTML, pictures. Opens no file.

| module | what it returns |
|---|---|
| `documents`, `last_documents` | one JSON document (a dict) per command; `lines` writes it |
| `csv` | CSV text of matches, profiles and lasts |
| `tables`, `last_tables` | rich renderables for the terminal; `terminal_text` writes them |
| `plots` | every picture as SVG or PNG, from the `*_figure` modules |
| `html` | the page of one match |
"""
