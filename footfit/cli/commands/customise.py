"""``footfit customise``: a last for one customer, made from the best last or a named one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from footfit.cli import options

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from footfit.results import CustomLast

Kept = Literal["bottom"]
"""What keeps its outline."""


def customise(
    feet: list[str] = options.argument(
        "FOOT", "Give the mesh file of a foot, or of the left and the right foot of one customer."
    ),
    base: str = options.option(
        "--base",
        "Make it from this last of the catalogue, or from this mesh file; auto takes the best.",
        "LAST|auto",
        default="auto",
    ),
    profile: str = options.option(
        "--profile",
        "Choose the fit profile, whose allowances the last gets. Or give your own file.",
        "NAME|FILE.toml",
        default="walking",
    ),
    output: Path = options.output_file(
        "--output",
        "Write the last in mm (.stl, .ply, .obj, .off, .3mf, .3dm). Two lasts get -left and "
        "-right in their names.",
        "-o",
        default=...,
    ),
    flare_follow: float = options.option(
        "--flare-follow",
        "Turn the flare so far towards the foot's: 0 not at all, 1 in full, at most 6 degrees.",
        "0..1",
        default=0.0,
        min=0.0,
        max=1.0,
    ),
    keep: Kept | None = options.option(
        "--keep",
        "Keep the outline of the bottom too: then only the upper part changes. --flare-follow "
        "still turns it.",
        "bottom",
    ),
    room: list[str] | None = options.option(
        "--room",
        "Give one place more room, such as ball-medial=4. Repeat it for more places; a wrong "
        "name lists them.",
        "PLACE=MM",
    ),
    both: bool = options.switch(
        "--both", "Make the last of the other side too, as the mirror image of the foot's."
    ),
    store: str | None = options.option(
        "--store", "Store the last in the catalogue by this name, with how it was made.", "NAME"
    ),
    plot: Path | None = options.output_file(
        "--plot", "Draw how far the surface moved, from four sides (.svg, .png)."
    ),
    html: Path | None = options.output_file(
        "--html", "Write a page with the measures and the moved surface."
    ),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    reading: options.FootReading,
    worn: options.WornWith,
    standing: options.Standing,
    mode: options.OutputMode,
) -> None:
    """Make a last that has a fit profile's allowances for a foot, from a last that fits nearly.

    The bottom's heights, the heel height, the toe spring, the toe, the back and the top stay.
    Widths and girths change. It exits with 5, and writes nothing, if the base cannot give them.
    --heel-height, --toe-spring and --platform are for a base that is a file.

    Example: footfit customise foot.stl --base derby-42 -o custom.stl
    """
    from dataclasses import replace

    from footfit.api import custom_lasts, files
    from footfit.cli.answers import sources_of, tell
    from footfit.cli.outputs import say_written, write_outputs
    from footfit.cli.progress import progress
    from footfit.errors import BadOption
    from footfit.pipeline.last_making.custom.base_choice import require_free_names

    sources = sources_of(feet, reading, quiet=mode.quiet)
    if len(sources) > 2 or (both and len(sources) == 2):
        raise BadOption("give one foot, with --both or without, or the two feet of one customer")
    if len(sources) == 2 and reading.side != "auto":
        raise BadOption("--side goes with one foot: of two feet the shapes show the sides")
    if len(sources) < len(feet):
        raise BadOption("is given twice: name the left and the right foot", feet[0])
    pair = len(sources) == 2 or both
    written = [
        *placed(output, files.mesh_file, pair=pair),
        *placed(plot, files.picture, pair=pair),
        *placed(html, lambda custom, _: files.page(custom), pair=pair),
    ]
    read = [source.path or "-" for source in sources]
    refuse(written, (*read, base), force=force)
    location = lasts.path()
    if store is not None:
        names = [f"{store}-{side}" for side in ("left", "right")] if pair else [store]
        require_free_names(location, names, replaces=force)
    with progress(mode) as bar:
        bar.show()
        there = not isinstance(location, Path) or location.exists()
        made = custom_lasts.customise(
            list(sources),
            base,
            catalogue=location if base == "auto" or there else None,
            both=both,
            store=store is not None,
            profile=profile,
            flare_follow=flare_follow,
            keep_bottom=keep == "bottom",
            room_mm=rooms(room or ()),
            name=store or output.stem,
            **reading.keywords(),
            **worn.keywords(),
            **standing.keywords(),
        )
    files_of = {side: str(path) for side, path, _ in placed(output, files.mesh_file, pair=pair)}
    made = tuple(replace(c, output=files_of.get(c.side, files_of.get(None))) for c in made)
    contents = [
        (path, content(custom, path.suffix.lower().removeprefix(".")))
        for custom in made
        for side, path, content in written
        if side in (None, custom.side)
    ]
    made = made if store is None else named(made, store)

    def store_made() -> None:
        if store is not None:
            custom_lasts.store_custom(made, lasts.open_to_make().path, replace=force)

    # Before the answer, whose reader may be gone. What cannot be written is not stored.
    write_outputs(dict(contents), force=force, then=store_made)
    say_written([path for path, _ in contents], quiet=mode.quiet)
    for custom in made:
        tell(custom, mode)


def placed(
    path: Path | None, content: Callable[[Any, str], bytes | str], *, pair: bool
) -> list[tuple[str | None, Path, Callable[[Any, str], bytes | str]]]:
    """A file of each last: its side if there are two, its path, and what makes its content."""
    if path is None:
        return []
    if not pair:
        return [(None, path, content)]
    sides = ("left", "right")
    return [(side, path.with_stem(f"{path.stem}-{side}"), content) for side in sides]


def refuse(
    written: Sequence[tuple[str | None, Path, Any]], read: Sequence[str], *, force: bool
) -> None:
    """Stop before any work if a file could not be written at the end; ``read`` are the inputs.

    Raises
    ------
    OutputExists, BadOption
        A file exists, its suffix is wrong, or it is an input.
    """
    from footfit.api import files
    from footfit.cli.outputs import refuse_existing, refuse_inputs
    from footfit.pipeline.export import MESH_KINDS, PICTURE_KINDS

    for _, path, content in written:
        kinds: tuple[str, ...] = ()
        if content is files.mesh_file:
            kinds = MESH_KINDS
        elif content is files.picture:
            kinds = PICTURE_KINDS
        refuse_existing(path, force=force, kinds=kinds)
    refuse_inputs([str(path) for _, path, _ in written], read)


def rooms(given: Sequence[str]) -> dict[str, float]:
    """The room of each place that was given.

    Raises
    ------
    BadOption
        It is not written as PLACE=MM, or a place is named twice.
    """
    from footfit.errors import BadOption

    result = {}
    for each in given:
        place, _, size = each.partition("=")
        if place.strip() in result:
            raise BadOption(f"--room names {place.strip()} twice: give it one size")
        try:
            result[place.strip()] = float(size)
        except ValueError as error:
            raise BadOption(f"--room takes PLACE=MM such as ball-medial=4, not {each!r}") from error
    return result


def named(made: Sequence[CustomLast], name: str) -> tuple[CustomLast, ...]:
    """The lasts by the name that the catalogue has them under; two lasts get their side in it."""
    from dataclasses import replace

    result = []
    for custom in made:
        own = f"{name}-{custom.side}" if len(made) > 1 else name
        labels = replace(custom.record.labels, name=own)
        record = replace(custom.record, labels=labels)
        result.append(replace(custom, record=record, stored_as=own))
    return tuple(result)
