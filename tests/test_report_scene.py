"""The 3D view: its data are the meshes, it draws with and without WebGL, and obeys its switches."""

from __future__ import annotations

import base64
import json
import re
from dataclasses import replace
from html import unescape

import numpy as np
import pytest

from footfit.pipeline.drawables import drawable
from footfit.report.page.rendering import content_hash, html_page, page_file, templates
from footfit.report.page.scene import (
    MOST_VERTICES,
    STEPS,
    UNKNOWN,
    packed_clearance,
    packed_mesh,
    scene_of,
)
from footfit.report.pictures.heat import (
    COLOURS,
    NEUTRAL,
    NOT_COMPARED,
    breaks_mm,
    heat_colours,
    rgb,
    scale_colours,
    step_words,
)
from tests import browsing, shapes
from tests.bounds import printed
from tests.comparisons import comparison

needs_browser = pytest.mark.skipif(browsing.BROWSER is None, reason=browsing.MISSING)


def page_of(comparison) -> str:
    """A page with nothing but the view."""
    source = (
        "{% extends 'page.html.jinja' %}{% block title %}x{% endblock %}"
        "{% block content %}{% include 'parts/scene.html.jinja' %}{% endblock %}"
    )
    return html_page(templates().from_string(source), scene=scene_of(comparison))


def data_of(page: str) -> dict:
    return json.loads(unescape(re.search('data-scene="([^"]*)"', page)[1]))


def array(text: str, kind: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype=kind)


def test_no_difference_of_two_lasts_has_a_colour_of_its_own():
    """Kept parts of a custom last do not look moved: 0.00 mm was pale blue or pink."""
    still = heat_colours(np.array([-0.1, 0.0, 0.1]), 0.25, neutral=True)
    assert np.array_equal(still, [rgb(NEUTRAL)] * 3)
    moved = heat_colours(np.array([-0.2, 0.2]), 0.25, neutral=True)
    assert np.array_equal(moved, [rgb(COLOURS[4]), rgb(COLOURS[5])])
    assert step_words(5, 0.25, neutral=True) == "-.125 to +.125"
    assert len(scale_colours(neutral=True)) == len(breaks_mm(0.25, neutral=True)) + 1


def test_a_packed_mesh_reads_back_within_its_step():
    vertices, faces = shapes.ellipsoid(subdivisions=3)
    mesh = packed_mesh(vertices, faces)
    back = array(mesh["vertices"], "<u2").reshape(-1, 3) * mesh["step"] + mesh["origin"]
    step_mm = np.ptp(vertices, axis=0).max() / STEPS
    assert np.abs(back - vertices).max() <= step_mm / 2 + printed(4)  # of the origin
    assert np.array_equal(array(mesh["faces"], "<u2").reshape(-1, 3), faces)


def test_the_clearance_reads_back_and_what_is_not_compared_stays_so():
    clearance = np.array([-3.21, 0.0, np.nan, 12.345, 900.0])
    back = array(packed_clearance(clearance), "<i2")
    assert back.tolist() == [-321, 0, UNKNOWN, 1234, 30000]


def test_left_feet_are_shown_as_left_feet():
    right, left = (data_of(page_of(comparison(side, side))) for side in (False, True))
    assert right["foot"]["vertices"] != left["foot"]["vertices"]
    assert right["view"][0] == -left["view"][0]
    low = right["foot"]["origin"][1]
    span = right["foot"]["step"] * array(right["foot"]["vertices"], "<u2")[1::3].max()
    within = 0.5 * right["foot"]["step"] + 3 * printed(4)
    assert left["foot"]["origin"][1] == pytest.approx(-(low + span), abs=within)


def test_a_left_foot_is_seen_from_where_a_right_one_is_mirrored():
    """From above and from below both are seen with the heel at the same end."""
    right, left = (scene_of(comparison(side, side)).views for side in (False, True))
    for (name, seen), (other, mirrored) in zip(right, left, strict=True):
        (turn, up), (back, same) = (map(float, angles.split(",")) for angles in (seen, mirrored))
        assert (other, same) == (name, up)
        assert (turn - back if name in ("top", "sole") else turn + back) % 360.0 == 0.0, name
        assert abs(up) == 90.0 if name in ("top", "sole") else 0.0 <= up <= 10.0


def test_the_data_of_the_view_are_in_the_order_of_their_names():
    """So that the pages of two versions can be compared."""
    data = data_of(page_of(comparison()))
    assert [*data] == sorted(data)


def test_the_colours_of_the_view_are_the_legends():
    page = page_of(comparison())
    data = data_of(page)
    assert tuple(data["breaks"]) == breaks_mm()
    assert tuple(data["colours"]) == COLOURS
    for step, colour in enumerate(COLOURS):
        assert f'fill="{colour}"' in page
        assert f">{step_words(step)}<" in page
    assert len(set(COLOURS)) == len(breaks_mm()) + 1
    middles = np.array([-9.0, -7, -5, -3, -1, 1, 3, 5, 7, 9])
    assert np.array_equal(heat_colours(middles), np.array([rgb(one) for one in COLOURS]))
    assert np.array_equal(heat_colours(np.array([np.nan])), [rgb(NOT_COMPARED)])


def test_the_scale_is_told_apart_without_red_and_green():
    """Seen by a deuteranope, tight and loose still differ, and darker is always farther from 0.

    Viénot, Brettel and Mollon's projection, on linear light.
    """
    c = np.array([rgb(colour) for colour in COLOURS])
    linear = np.where(c > 0.04045, ((c + 0.055) / 1.055) ** 2.4, c / 12.92)
    seen = linear @ np.array([[0.2928, 0.2928, -0.0223], [0.7072, 0.7072, 0.0223], [0, 0, 1]])
    luminance = linear @ [0.2126, 0.7152, 0.0722]
    assert np.all(np.diff(luminance[:5]) > 0)
    assert np.all(np.diff(luminance[5:]) < 0)
    blueness = seen[:, 2] - seen[:, 0]
    assert blueness[:4].max() < 0.0 < blueness[6:].min()


def test_a_mesh_too_heavy_for_16_bits_has_no_view():
    heavy = np.zeros((MOST_VERTICES + 1, 3))
    heavy = replace(comparison(), last_vertices_mm=heavy)
    assert scene_of(heavy) is None
    assert "<canvas" not in page_of(heavy)
    assert "<script" not in page_of(heavy)


def test_lighter_meshes_keep_the_figures_and_carry_the_colours_over():
    whole = comparison()
    light = drawable(whole, faces=3000)
    assert len(light.faces) <= 3100
    assert light.zones == whole.zones
    assert light.sections == whole.sections
    known = np.isfinite(light.clearance_mm)
    assert known.mean() > 0.5
    assert np.nanmin(whole.clearance_mm) <= light.clearance_mm[known].min()
    assert light.clearance_mm[known].max() <= np.nanmax(whole.clearance_mm)
    assert light.clearance_mm[known].mean() == pytest.approx(
        np.nanmean(whole.clearance_mm), abs=0.63
    )  # of fewer vertices, which lie elsewhere; measured: 0.32 mm


# ---------------------------------------------------------------- in a browser


def shown(more_script: str = "") -> str:
    """The view's page with a script that uses its switches."""
    whole, script = page_of(comparison()), page_file("scene.js")
    used = script + more_script
    return whole.replace(script, used).replace(content_hash(script), content_hash(used))


def coloured(picture: np.ndarray) -> float:
    """The share of blue and red in the view's own part of the picture."""
    view = picture[60:480]
    return float((np.abs(view[..., 0] - view[..., 2]) > 0.15).mean())


@needs_browser
@pytest.mark.parametrize("way", [browsing.WEBGL, browsing.NO_WEBGL])
def test_the_view_is_drawn_with_and_without_webgl(tmp_path, way):
    seen = browsing.browse(shown(), tmp_path / "on", way, size=(1100, 700))
    assert seen.console == ""
    assert seen.requests == []
    assert coloured(seen.picture) > 0.073, "the canvas is blank"  # measured: 0.145
    off = "document.querySelector('[data-show=foot]').click();"
    without = browsing.browse(shown(off), tmp_path / "off", way, size=(1100, 700))
    assert coloured(without.picture) == 0.0
    glass = np.ptp(without.picture[60:480], axis=(0, 1)).max()  # measured: 0.41 and 0.54
    assert glass > 0.21, "the last is gone too"
    off += "document.querySelector('[data-show=last]').click();"
    nothing = browsing.browse(shown(off), tmp_path / "none", way, size=(1100, 700))
    assert coloured(nothing.picture) == 0.0


@needs_browser
def test_buttons_and_keys_turn_the_view(tmp_path):
    acts = (
        "document.querySelectorAll('[data-view]')[3].click();",
        "document.getElementById('scene-view').dispatchEvent("
        "new KeyboardEvent('keydown', {key: 'ArrowLeft'}));"
        "const c = document.getElementById('scene-view');"
        "c.setPointerCapture = () => 0;"
        "c.dispatchEvent(new PointerEvent('pointerdown', {clientX: 300, clientY: 300}));"
        "c.dispatchEvent(new PointerEvent('pointermove', {clientX: 360, clientY: 310}));",
    )
    still = browsing.browse(shown(), tmp_path / "still", size=(1100, 700)).picture
    for index, act in enumerate(acts):
        moved = browsing.browse(shown(act), tmp_path / f"moved{index}", size=(1100, 700))
        assert moved.console == ""
        assert np.abs(moved.picture - still)[60:480].max() > 0.49, act  # measured: 0.96


@needs_browser
def test_a_request_of_the_page_would_be_seen(tmp_path):
    """The check that nothing is asked for can fail: a page with an outside picture."""
    outside = "<html><body><img src='http://127.0.0.1:9/x.png'></body></html>"
    assert browsing.browse(outside, tmp_path / "page").requests == ["http://127.0.0.1:9/x.png"]
