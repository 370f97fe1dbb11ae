"""footfit: which shoe last fits this foot, and why?"""

from importlib import import_module
from typing import TYPE_CHECKING

from footfit.version import __version__

if TYPE_CHECKING:
    from footfit import errors, results
    from footfit.api.catalogues import Catalogue, match, open_catalogue
    from footfit.api.custom_lasts import customise, store_custom
    from footfit.api.drawings import draw_last, drawing, drawing_file
    from footfit.api.files import mesh_file, page, picture, sheet, to_trimesh
    from footfit.api.last_making import check_run, compare_lasts, grade
    from footfit.api.populations import coverage
    from footfit.api.scans import (
        align,
        cluster,
        compare,
        curvature,
        customers,
        flare,
        measure,
        outcomes,
        read,
        sources,
    )
    from footfit.errors import FootfitError
    from footfit.results import LastLabels

_HOMES = (
    *("api.scans", "api.files", "api.drawings", "api.custom_lasts", "api.last_making"),
    *("api.populations", "api.catalogues", "errors", "results"),
)
"""Where the names are, the lightest first."""

__all__ = [
    "Catalogue",
    "FootfitError",
    "LastLabels",
    "__version__",
    "align",
    "check_run",
    "cluster",
    "compare",
    "compare_lasts",
    "coverage",
    "curvature",
    "customers",
    "customise",
    "draw_last",
    "drawing",
    "drawing_file",
    "errors",
    "flare",
    "grade",
    "match",
    "measure",
    "mesh_file",
    "open_catalogue",
    "outcomes",
    "page",
    "picture",
    "read",
    "results",
    "sheet",
    "sources",
    "store_custom",
    "to_trimesh",
]


def __getattr__(name: str) -> object:
    """Import what is asked for when it is asked for: ``import footfit`` alone is quick."""
    if name in ("errors", "results"):
        return import_module(f"footfit.{name}")
    for home in _HOMES if name in __all__ else ():
        module = import_module(f"footfit.{home}")
        if hasattr(module, name):
            return getattr(module, name)
    raise AttributeError(f"module 'footfit' has no attribute {name!r}")
