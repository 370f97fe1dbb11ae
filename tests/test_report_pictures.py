"""Pictures: exact outlines, true shading, the same bytes each time, nothing from outside."""

from __future__ import annotations

import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

from footfit.errors import BadOption
from footfit.report.pictures import curvature_figure as curvature_module
from footfit.report.pictures import frames_figure as frames_module
from footfit.report.pictures.curvature_figure import UNDEFINED, colour_reach, curvature_figure
from footfit.report.pictures.drawn_outlines import SHADOW, on_side, side_outline, sole_outline
from footfit.report.pictures.figures import VERDICT_COLOURS, picture_bytes, svg_text
from footfit.report.pictures.flare_figure import centre_line_mm, flare_figure, mean_heading_deg
from footfit.report.pictures.frames_figure import frames_figure
from footfit.report.pictures.judged_figure import WIDTHS, judged_figure, zone_style
from footfit.report.pictures.overlay_figure import drawn_lasts, overlay_figure
from footfit.report.pictures.shading import VIEWS, Frame, axonometric_view, fragments, shaded_image
from footfit.report.wording.zone_words import MARKS, zone_text
from footfit.results import FootFit, Measured, SideVerdict, ToeBox, ToeFit, ZoneFit
from tests import answers
from tests.bounds import ROUNDING
from tests.shapes import sphere
from tests.solids import signed_volume

GREY = np.array([0.8, 0.8, 0.8])


@pytest.fixture(autouse=True)
def small(monkeypatch) -> None:
    """Shaded pictures of few pixels, so that the suite stays quick."""
    monkeypatch.setattr(frames_module, "COLUMNS", 120)
    monkeypatch.setattr(curvature_module, "COLUMNS", 120)


def overlay(match, shapes=None):
    """The first foot of a match with its best lasts drawn over it."""
    lasts = drawn_lasts(match, match.feet[0], shapes)
    return overlay_figure(match.feet[0], lasts, "the best lasts")


def all_figures():
    lasts = {"derby-42": answers.tube(271.5)}
    foot = answers.foot()
    return {
        "frames": lambda: frames_figure(foot.aligned),
        "flare": lambda: flare_figure(foot),
        "curvature": lambda: curvature_figure(answers.curvature()),
        "match": lambda: overlay(answers.match(), lasts),
    }


@pytest.mark.parametrize("name", ["frames", "flare", "curvature", "match"])
def test_a_picture_is_the_same_twice_and_names_no_address(name: str) -> None:
    draw = all_figures()[name]
    data = picture_bytes(draw(), "svg")
    assert data == picture_bytes(draw(), "svg")
    text = data.decode("utf-8")
    ElementTree.fromstring(text)
    addresses = set(re.findall(r"https?://[^\"' ]+", text))
    assert addresses <= {
        "http://www.w3.org/2000/svg",
        "http://www.w3.org/1999/xlink",
        "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd",
    }
    assert "<script" not in text
    png = picture_bytes(draw(), "png")
    assert png == picture_bytes(draw(), "png")
    assert png.startswith(b"\x89PNG")


def test_another_format_is_refused() -> None:
    with pytest.raises(BadOption, match=r"\.svg or \.png"):
        picture_bytes(flare_figure(answers.foot()), "jpg")


def test_a_users_own_settings_do_not_change_a_picture() -> None:
    import matplotlib

    usual = svg_text(flare_figure(answers.foot()))
    with matplotlib.rc_context({"font.size": 30, "svg.fonttype": "none", "axes.grid": True}):
        assert svg_text(flare_figure(answers.foot())) == usual


# ---------------------------------------------------------------- outlines


def test_the_shadow_of_a_sphere_is_its_great_circle() -> None:
    vertices, faces = sphere(100.0, 5)
    for outline in (sole_outline(vertices, faces, SHADOW), side_outline(vertices, faces)):
        radius = np.sqrt(np.maximum(100.0**2 - outline.x_mm**2, 0.0))
        assert np.allclose(outline.second_mm, radius, atol=0.5)
        assert np.allclose(outline.first_mm, -radius, atol=0.5)


def test_the_soles_band_is_measured_from_each_sections_own_lowest_point() -> None:
    """Of a sphere of radius r, a band of height h over the lowest point is 2 sqrt(h (2r - h))."""
    vertices, faces = sphere(100.0, 6)
    outline = sole_outline(vertices, faces, band=0.1)
    middle = int(np.argmin(np.abs(outline.x_mm)))
    length = float(np.ptp(vertices[:, 0]))
    height = 0.1 * length
    half = np.sqrt(height * (200.0 - height))
    assert outline.second_mm[middle] == pytest.approx(half, abs=0.003)  # measured 0.0019


def test_an_outline_is_a_closed_polygon_without_gaps() -> None:
    outline = sole_outline(*answers.tube())
    polygon = outline.closed()
    assert np.isfinite(polygon).all()
    part = outline.between(50.0, 100.0)
    assert part.x_mm.min() >= 50.0
    assert part.x_mm.max() <= 100.0


def test_a_left_foots_centre_line_lies_in_its_own_outline() -> None:
    for left in (False, True):
        foot = answers.foot(left=left)
        line = centre_line_mm(foot.flare, foot.aligned.alignment.extent_mm, left=left)
        outline = sole_outline(foot.aligned.vertices_mm, foot.aligned.faces)
        low = np.interp(line[:, 0], outline.x_mm, outline.first_mm)
        high = np.interp(line[:, 0], outline.x_mm, outline.second_mm)
        assert np.all((line[:, 1] > low) & (line[:, 1] < high))


def test_a_last_is_mirrored_to_the_foots_side_and_stays_wound_outward() -> None:

    shape = answers.tube()
    vertices, faces = on_side(shape, "right", "left")
    assert np.allclose(vertices[:, 1], -shape[0][:, 1])
    assert signed_volume(vertices, faces) == pytest.approx(signed_volume(*shape))
    assert on_side(shape, "left", "left") is shape


# ---------------------------------------------------------------- shading


def test_a_spheres_picture_has_the_area_of_its_disc() -> None:
    vertices, faces = sphere(10.0, 5)
    frame = Frame(-12.0, 12.0, -12.0, 12.0)
    image = shaded_image(vertices, faces, frame, 240, GREY)
    assert image.shape == (240, 240, 4)
    area = image[..., 3].sum() * (24.0 / 240) ** 2
    assert area == pytest.approx(np.pi * 100.0, rel=3.4e-4)  # measured 0.00022


def test_the_nearer_of_two_planes_is_seen() -> None:
    corners = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], dtype=float)
    far = np.column_stack([corners, np.zeros(4)])
    near = np.column_stack([corners[:, :1] / 2, corners[:, 1:], np.ones(4)])
    faces = np.array([[0, 1, 2], [0, 2, 3]])
    for first, second in ((far, near), (near, far)):
        points, all_faces = np.concatenate([first, second]), np.concatenate([faces, faces + 4])
        seen = fragments(points, all_faces, Frame(0, 10, 0, 10), (20, 20))
        owner = np.where(seen.face >= 2, 1, 0)
        assert (seen.face >= 0).all()
        nearer = 1 if second is near else 0
        assert (owner[:, :10] == nearer).all()
        assert (owner[:, 10:] == 1 - nearer).all()


def test_no_pixel_between_neighbouring_triangles_is_missed() -> None:
    generator = np.random.default_rng(3)
    grid = np.stack(np.meshgrid(np.arange(12.0), np.arange(12.0)), axis=-1).reshape(-1, 2)
    inner = (grid > 0).all(axis=1) & (grid < 11).all(axis=1)
    grid[inner] += generator.uniform(-0.3, 0.3, size=(inner.sum(), 2))
    points = np.column_stack([grid, np.zeros(len(grid))])
    corner = (np.arange(11)[:, None] * 12 + np.arange(11)).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + 13], axis=1),
            np.stack([corner, corner + 13, corner + 12], axis=1),
        ]
    )
    for pixels in (7, 50, 333):
        seen = fragments(points, faces, Frame(0.01, 10.99, 0.01, 10.99), (pixels, pixels))
        assert (seen.face >= 0).all()
        assert np.allclose(seen.weights.sum(axis=-1), 1.0)


def test_triangles_outside_the_frame_or_seen_edge_on_draw_nothing() -> None:
    points = np.array([[20.0, 20, 0], [30, 20, 0], [20, 30, 0], [0, 0, 0], [5, 5, 0], [9, 9, 3]])
    seen = fragments(points, np.array([[0, 1, 2], [3, 4, 5]]), Frame(0, 10, 0, 10), (30, 30))
    assert (seen.face == -1).all()


def test_vertex_colours_are_blended() -> None:
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 10, 0]])
    seen = fragments(points, np.array([[0, 1, 2]]), Frame(0, 10, 0, 10), (100, 100))
    covered = seen.face >= 0
    x = np.broadcast_to((np.arange(100) + 0.5) / 10.0, (100, 100))
    assert np.allclose(seen.weights[covered] @ points[:, 0], x[covered])


@pytest.mark.parametrize("view", [*VIEWS.values(), axonometric_view(-52.0, 24.0)])
def test_a_view_is_a_rotation(view: np.ndarray) -> None:
    assert np.allclose(view @ view.T, np.eye(3))
    assert np.linalg.det(view) == pytest.approx(1.0)


# ---------------------------------------------------------------- what the figures say


def texts(figure):
    from matplotlib.text import Text

    return " | ".join(text.get_text() for text in figure.findobj(Text))


def test_the_flare_picture_says_the_angle_with_its_uncertainty() -> None:
    foot = answers.foot()
    said = texts(flare_figure(foot))
    assert "+10.0° ± 0.2°" in said
    rear, fore = foot.flare.definition.rearfoot, foot.flare.definition.forefoot
    assert f"rear {mean_heading_deg(foot.flare, rear):+.1f}°" in said
    assert f"fore {mean_heading_deg(foot.flare, fore):+.1f}°" in said
    assert "50 mm" in said


def test_channels_without_a_sole_are_said_to_be_missing() -> None:
    bottoms = ("bottom_20", "bottom_50", "bottom_80", "bottom_surface")
    foot = replace(answers.foot(), flare=answers.profile(spoilt=("plan", *bottoms)))
    said = texts(flare_figure(foot))
    assert "the plan curvature is not measurable" in said
    assert "no sole: the bottom is not measurable" in said
    svg_text(flare_figure(foot))


def test_the_frames_picture_draws_before_and_after_in_mm() -> None:
    """The eigenvectors' ends, taken with the mesh, lie where the alignment takes them."""
    foot = answers.foot()
    figure = frames_figure(foot.aligned)
    said = texts(figure)
    assert "Before: the file's axes" in said
    assert "After: aligned (footfit)" in said
    above = figure.axes[2]
    image = above.get_images()[0].get_extent()
    points = foot.aligned.vertices_mm
    assert image[0] < points[:, 0].min() < points[:, 0].max() < image[1]
    assert image[2] < points[:, 1].min() < points[:, 1].max() < image[3]
    tips = [text.xy for text in above.texts if text.get_text() == "e1"]
    frame, transform = foot.aligned.alignment.eigenframe, foot.aligned.alignment.transform
    end = frame.centroid_mm + 2.0 * np.sqrt(frame.eigenvalues_mm2[0]) * frame.eigenvectors[0]
    assert np.allclose(tips[0], (transform[:3, :3] @ end + transform[:3, 3])[:2])


def test_a_scan_in_metres_is_drawn_in_mm() -> None:
    foot = answers.foot()
    known = foot.aligned.alignment
    scaled = replace(
        known,
        info=replace(known.info, unit_scale=1000.0),
        transform=answers.placed(known.transform[:3, :3], known.transform[:3, 3], 1000.0),
        canonical_transform=answers.placed(known.transform[:3, :3], known.transform[:3, 3], 1000.0),
    )
    figures = [frames_figure(replace(foot.aligned, alignment=one)) for one in (known, scaled)]
    extents = [[axes.get_images()[0].get_extent() for axes in figure.axes] for figure in figures]
    assert np.allclose(*extents)


def test_the_scale_of_colours_is_even_around_zero_and_survives_no_values() -> None:
    assert colour_reach(np.array([-2.0, 0.0, 1.0, np.nan])) == pytest.approx(1.9)
    assert colour_reach(np.array([np.nan])) == 1.0
    assert colour_reach(np.zeros(3)) == 1.0
    curvature = answers.curvature()
    nothing = replace(curvature, mean=np.full_like(curvature.mean, np.nan))
    image = curvature_figure(nothing).axes[0].get_images()[0].get_array()
    seen = image[image[..., 3] == 1.0][:, :3]
    assert np.allclose(seen.max(axis=1), seen.min(axis=1), atol=ROUNDING, rtol=0)
    assert UNDEFINED[0] == UNDEFINED[1] == UNDEFINED[2]


def test_the_match_picture_names_the_lasts_and_shortens_long_names() -> None:
    long = "x" * 60
    said = texts(overlay(answers.match(names=("derby-42", long))))
    assert "1  derby-42, flare -2.0°" in said
    assert "…" in said
    assert long not in said


def test_a_match_without_lasts_still_draws_the_foot() -> None:
    said = texts(overlay(answers.match(candidates=())))
    assert "foot, flare +10.0° ± 0.2°" in said


def test_where_no_last_fits_the_nearest_are_drawn() -> None:
    near = answers.match().candidates[:2]
    figure = overlay(answers.match(candidates=(), nearest=near))
    assert "1  derby-42, flare -2.0°" in texts(figure)
    assert "2  oxford-42" in texts(figure)


@pytest.mark.parametrize("name", ["$x^$", "a\\b$", "<svg onload=alert(1)>", "x\x1b]\n"])
def test_names_are_drawn_and_not_read_as_formulas(name: str) -> None:
    foot = answers.foot(name.replace("\\", "_"))
    svg_text(flare_figure(foot))
    text = svg_text(overlay(answers.match((foot,), names=(name,))))
    assert "onload" not in re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL)


def test_an_undecided_side_is_drawn_as_it_is() -> None:
    foot = answers.foot()
    verdict = SideVerdict(None, "undecided", 0.1, "detected")
    known = replace(foot.aligned.alignment, side=verdict)
    said = texts(frames_figure(replace(foot.aligned, alignment=known)))
    assert "side undecided" in said


# ---------------------------------------------------------------- what was judged


def judged_zone(name: str, verdict: str | None, *, counts: bool = True) -> ZoneFit:
    known = Measured(-3.3, 0.5) if verdict else Measured(None, None, "not scanned")
    return ZoneFit(name, "mm", known, 0.0, -1.2, verdict, counts, label=name.replace("_", " "))


def judged_fit(*zones: ZoneFit, toes: bool = True) -> FootFit:
    values = (-3.3, 4.0, 6.0, 5.0, 1.5)
    names = ("big toe", "second toe", "third toe", "fourth toe", "little toe")
    each = tuple(
        ToeFit(name, "inner", Measured(value, 0.6))
        for name, value in zip(names, values, strict=True)
    )
    y = np.linspace(35.0, -40.0, 20)
    outline = np.column_stack([240.0 - 0.01 * (y - 10.0) ** 2, y])
    x = np.linspace(165.0, 265.0, 30)
    wall = np.column_stack([x, -45.0 + 0.0035 * (x - 165.0) ** 2, 40.0 - 0.003 * (x - 165.0) ** 2])
    box = ToeBox(each, outline, np.repeat(np.arange(5), 4), wall)
    return FootFit("right", "poor", zones, None, box if toes else None)


def drawn_words(figure) -> list[str]:
    return [text.get_text() for axes in figure.axes for text in axes.texts]


def test_a_verdict_is_told_apart_without_its_colour():
    assert len(set(MARKS.values())) == len(set(WIDTHS.values())) == len(VERDICT_COLOURS) == 4
    order = [WIDTHS[verdict] for verdict in ("good", "acceptable", "poor", "reject")]
    assert order == sorted(order)
    assert min(np.diff(order)) >= 1.0  # points: seen on paper


@pytest.mark.parametrize("name", ["ball_girth", "short_heel_girth", "heel_width", "toe_height"])
def test_each_zone_stands_at_its_place_with_its_verdict(name):
    for verdict in MARKS:
        zone = judged_zone(name, verdict)
        figure = judged_figure(answers.foot(), judged_fit(zone, toes=False))
        assert drawn_words(figure) == [f"{MARKS[verdict]} {zone.label} -3.3 mm"]
        (line,) = (line for line in figure.axes[0].lines if line.get_linewidth() == WIDTHS[verdict])
        assert line.get_color() == VERDICT_COLOURS[verdict]


def test_what_does_not_count_is_grey_and_in_brackets():
    zone = judged_zone("ball_girth", "poor", counts=False)
    assert zone_text(zone) == "(ball girth -3.3 mm)"
    assert zone_style(zone)["color"] not in VERDICT_COLOURS.values()
    assert zone_style(zone)["linewidth"] < min(WIDTHS.values())
    assert zone_text(judged_zone("ball_girth", None)) == "– ball girth not judged"


@pytest.mark.parametrize("left", [False, True])
def test_the_tightest_toe_has_the_verdict_and_each_toe_its_number(left):
    figure = judged_figure(answers.foot(left=left), judged_fit(judged_zone("toes", "acceptable")))
    words = drawn_words(figure)
    assert f"{MARKS['acceptable']} big toe -3.3" in words
    assert {"second toe +4.0", "third toe +6.0", "fourth toe +5.0", "little toe +1.5"} < set(words)
    place = next(t for t in figure.axes[1].texts if "big toe" in t.get_text()).get_position()
    assert (place[1] > 0.0) is not left  # a right foot's big toe is on its left


def test_toes_that_were_not_judged_are_not_drawn():
    figure = judged_figure(answers.foot(), judged_fit(judged_zone("toes", None), toes=False))
    assert len(figure.axes) == 1
    assert figure.get_supxlabel() == "– toes not judged"
