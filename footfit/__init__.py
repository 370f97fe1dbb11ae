"""footfit: which shoe last fits this foot, and why?"""

from importlib import import_module
from typing import TYPE_CHECKING

from footfit.version import __version__

if TYPE_CHECKING:
    from footfit import errors, results
    from footfit.api import (
        Catalogue,
        FootfitError,
        LastLabels,
        align,
        compare,
        curvature,
        flare,
        match,
        measure,
        mesh_file,
        open_catalogue,
        outcomes,
        page,
        picture,
        read,
        sources,
        to_trimesh,
    )

__all__ = [
    "Catalogue",
    "FootfitError",
    "LastLabels",
    "__version__",
    "align",
    "compare",
    "curvature",
    "errors",
    "flare",
    "match",
    "measure",
    "mesh_file",
    "open_catalogue",
    "outcomes",
    "page",
    "picture",
    "read",
    "results",
    "sources",
    "to_trimesh",
]


def __getattr__(name: str) -> object:
    """Import what is asked for when it is asked for: ``import footfit`` alone is quick."""
    if name not in __all__:
        raise AttributeError(f"module 'footfit' has no attribute {name!r}")
    if name in ("errors", "results"):
        return import_module(f"footfit.{name}")
    return getattr(import_module("footfit.api"), name)
