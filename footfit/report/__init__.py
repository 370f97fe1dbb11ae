"""Results in, text or bytes out: tables, JSON, CSV, HTML, pictures. Opens no file.

| module | what it returns |
|---|---|
| `documents`, `last_documents` | one JSON document (a dict) per command; `json_line` writes it |
| `csv` | CSV text of matches, profiles and lasts |
| `tables`, `last_tables` | rich renderables for the terminal; `terminal_text` writes them |
| `flare_plot`, `align_plot`, `curvature_plot`, `match_plot` | figures; `figures` writes SVG, PNG |
| `html` | the page of one match |
"""
