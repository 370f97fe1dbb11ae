"""What ``import footfit`` gives: scans and catalogues from Python, without a terminal.

A mesh is a path, the bytes of a file, arrays ``(vertices, faces)`` or the result of `read`; where
a foot or a last is asked for, the result of `align` or `flare` saves work. Results are frozen:
``to_dict()`` is the document that ``--json`` prints, ``rows()`` a table that pandas takes.
What cannot be done raises one of `footfit.errors`; docs/library.md has examples.
"""
