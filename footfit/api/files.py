"""Results as files, and as meshes for other tools; the caller writes them."""

from __future__ import annotations

from datetime import date
from typing import TYPE_CHECKING, Any

from footfit import results
from footfit.errors import BadOption
from footfit.locations import LocationName, location_of

if TYPE_CHECKING:
    from footfit.meshes.exchange import Trimesh
    from footfit.results.population.coverage_answer import Coverage

MOST_LETTERS = 80
"""Of a title or a customer: what two lines of the head of a page can show."""


def picture(result: Any, kind: str = "svg") -> bytes:
    """A result as "svg" or "png": of `align`, `flare`, `curvature`, `compare`, `compare_lasts`,
    `customise` or a calibration.


    Raises
    ------
    BadOption
        There is no picture of such a result.
    """
    from footfit.pipeline import export
    from footfit.pipeline.drawables import canonical_view
    from footfit.report.page.custom_figure import custom_figure
    from footfit.report.pictures.curvature_figure import curvature_figure
    from footfit.report.pictures.figures import picture_bytes
    from footfit.report.pictures.flare_figure import flare_figure
    from footfit.report.pictures.frames_figure import frames_figure
    from footfit.report.pictures.ratings_figure import ratings_figure
    from footfit.report.pictures.section_figure import section_figure

    export.require_kind(kind, export.PICTURE_KINDS)
    match result:
        case results.AlignedScan():
            figure = frames_figure(result)
        case results.Profiled():
            figure = flare_figure(result)
        case results.SurfaceCurvature():
            figure = curvature_figure(result, canonical_view(result))
        case results.Comparison():
            figure = section_figure(result)
        case results.LastDifference():
            figure = section_figure(result.drawn)
        case results.CustomLast():
            figure = custom_figure(result)
        case results.Calibration():
            figure = ratings_figure(result)
        case _:
            raise BadOption(f"there is no picture of a {type(result).__name__}")
    return picture_bytes(figure, kind)


def mesh_file(result: Any, kind: str) -> bytes:
    """The mesh of a result as a file in mm: "stl", "ply", "obj", "off", "3mf" or "3dm".

    The result of `curvature` becomes a coloured "ply", or an "npz" with the values of every vertex.
    The result of `compare` becomes a "ply" coloured by the clearance, or a picture of it; that of
    `compare_lasts` is coloured by the difference.

    Raises
    ------
    BadOption
        There is no mesh in such a result.
    CatalogueDamaged
        The mesh copy cannot be expanded.
    """
    from footfit.meshes.copies.compact_copy import expanded_mesh
    from footfit.meshes.write import encoded_mesh
    from footfit.pipeline import export
    from footfit.report.pictures.curvature_figure import curvature_colours
    from footfit.report.pictures.heat_figure import HEAT_KINDS, heat_bytes

    kinds = {
        results.SurfaceCurvature: export.CURVATURE_KINDS,
        results.Comparison: HEAT_KINDS,
        results.LastDifference: HEAT_KINDS,
    }
    export.require_kind(kind, kinds.get(type(result), export.MESH_KINDS))
    match result:
        case results.AlignedScan():
            return encoded_mesh(export.method_vertices(result), result.faces, kind)
        case results.CustomLast():
            return encoded_mesh(result.vertices_mm, result.faces, kind)
        case results.MeshCopy():
            return encoded_mesh(*expanded_mesh(result.data), kind)
        case results.SurfaceCurvature():
            colours = curvature_colours(result) if kind == "ply" else None
            return export.curvature_bytes(result, kind, colours)
        case results.Comparison():
            return heat_bytes(result, kind)
        case results.LastDifference():
            return heat_bytes(result.drawn, kind)
    raise BadOption(f"there is no mesh in a {type(result).__name__}")


def to_trimesh(result: results.Scan | results.AlignedScan | results.Profiled) -> Trimesh:
    """The mesh of a scan in mm for trimesh: of `read` as in its file, else in the canonical frame.

    `read`, `align` and the others take a trimesh mesh as well.
    """
    from footfit.meshes.exchange import as_trimesh

    mesh = result.aligned if isinstance(result, results.Profiled) else result
    info = mesh.info if isinstance(mesh, results.Scan) else mesh.alignment.info
    return as_trimesh(mesh.vertices_mm, mesh.faces, path=info.path)


def page(
    result: results.Match
    | results.Comparison
    | results.LastDifference
    | results.CustomLast
    | Coverage,
    catalogue: LocationName | None = None,
    *,
    title: str = "",
    customer: str = "",
) -> str:
    """A match, a comparison, a custom last or a coverage as one HTML page.

    A match with its ``catalogue`` draws the lasts.

    The page of a match shows ``title`` and ``customer``, which are kept nowhere.

    Raises
    ------
    NotInCatalogue, CatalogueUnusable
        The catalogue is not there, or cannot be read.
    BadOption
        A text is too long.
    """
    require_short(title=title, customer=customer)
    from footfit.pipeline import drawables
    from footfit.report.page.compare_page import compare_page
    from footfit.report.page.custom_page import custom_page
    from footfit.report.page.difference_page import difference_page
    from footfit.report.page.match_page import match_page
    from footfit.results.population.coverage_answer import Coverage

    if isinstance(result, Coverage):
        from footfit.report.page.coverage_page import coverage_page

        return coverage_page(result)
    if isinstance(result, results.LastDifference):
        return difference_page(result, drawables.drawable(result.drawn))
    if isinstance(result, results.CustomLast):
        return custom_page(result)
    if isinstance(result, results.Comparison):
        return compare_page(drawables.drawable(result))
    if catalogue is None:
        return match_page(result, title=title, customer=customer)
    path = location_of(catalogue)
    shapes = drawables.candidate_shapes(path, result)
    comparisons = drawables.best_comparisons(path, result)
    return match_page(result, shapes, comparisons, title=title, customer=customer)


def sheet(
    match: results.Match, *, title: str = "", customer: str = "", day: date | None = None
) -> str:
    """A match by fit as the customer's sheet: one HTML page that prints on one A4.

    Parameters
    ----------
    match : Match
    title, customer : str
        Shown above the sheet, and kept nowhere.
    day : date, optional
        The day that the sheet shows; without it today.

    Raises
    ------
    BadOption
        The match is not by fit, or a text is too long.
    """
    from footfit.pipeline import drawables
    from footfit.pipeline.width.foot_width import survey_words
    from footfit.report.page.sheet_page import sheet_page

    if match.by != "fit":
        raise BadOption(f"the customer's sheet goes with --by fit, not {match.by}: it judges a fit")
    require_short(title=title, customer=customer)
    meshes = drawables.foot_meshes(match)
    known = {"title": title, "customer": customer, "survey": survey_words()}
    return sheet_page(match, meshes, day=day or date.today(), **known)


def require_short(**texts: str) -> None:
    """Refuse a text that is too long for the head of a page; raises BadOption with its name."""
    for name, text in texts.items():
        if len(text) > MOST_LETTERS:
            words = f"--{name} takes at most {MOST_LETTERS} letters, not {len(text)}; shorten it"
            raise BadOption(words)
