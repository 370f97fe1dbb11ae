"""What ``import footfit`` gives: scans and catalogues from Python, without a terminal.

A mesh is a path, the bytes of a file, arrays ``(vertices, faces)`` or the result of `read`. If a
function takes a foot or a last, the result of `align` or `flare` saves work. Results are frozen:
``to_dict()`` gives the document that ``--json`` prints, ``rows()`` a table that pandas takes.
Errors are those of `footfit.errors`. docs/library.md has examples.
"""
