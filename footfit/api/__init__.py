"""What ``import footfit`` gives: scans and catalogues from Python, without a terminal.

A mesh is a path, the bytes of a file, arrays ``(vertices, faces)`` or the result of `read`; where
a foot or a last is asked for, the result of `align` or `flare` saves work. Results are frozen:
``to_dict()`` is the document that ``--json`` prints, ``rows()`` a table that pandas takes.
What cannot be done raises one of `footfit.errors`; docs/library.md has examples.
"""

from footfit.api.catalogues import Catalogue, match, open_catalogue
from footfit.api.files import mesh_file, page, picture, to_trimesh
from footfit.api.inputs import sources
from footfit.api.scans import align, compare, curvature, flare, measure, outcomes, read
from footfit.errors import FootfitError
from footfit.results import LastLabels

__all__ = [
    "Catalogue",
    "FootfitError",
    "LastLabels",
    "align",
    "compare",
    "curvature",
    "flare",
    "match",
    "measure",
    "mesh_file",
    "open_catalogue",
    "outcomes",
    "page",
    "picture",
    "read",
    "sources",
    "to_trimesh",
]
