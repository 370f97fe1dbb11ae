"""``footfit grade-last``: a last in other sizes and widths."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options

GRADING = "How it is graded"


def grade_last(
    last: str = options.argument("LAST", "Give the base: its name in the catalogue, or its file."),
    sizes: str = options.option(
        "--sizes", "Make these sizes: 38:46, 38:42:0.5, 42:43:1/3 or 39,40.5.", "SIZES", default=...
    ),
    widths: str | None = options.option(
        "--widths", "Make each size in these widths. Else in the base's width.", "E,F,G"
    ),
    size_system: str | None = options.option(
        "--size-system", "Count sizes in this system. Else in that of the base's label.", "eu"
    ),
    base_size: str | None = options.option(
        "--base-size", "Set the base's size. Without it, its label says the size.", "42"
    ),
    base_width: str | None = options.option(
        "--base-width", "Set the base's width. Without it, its label says the width.", "F"
    ),
    hold: str | None = options.option(
        "--hold",
        "Hold some of heel, spring, bottom, toe and top, or none. Else heel, spring and toe.",
        "PART,...",
        panel=GRADING,
    ),
    rule: str | None = options.option(
        "--rule",
        "Grade by this rule: its name, or a .toml file. Else by that of the size system.",
        "NAME|FILE",
        panel=GRADING,
    ),
    family: str | None = options.option(
        "--family", "Name the run. Else it has the base's family, or its name.", "F"
    ),
    output: Path = options.output_file(
        "--output",
        "Write each last to this folder (.stl, mm), with a manifest.",
        "-o",
        metavar="RUN/",
        default=...,
    ),
    csv: Path | None = options.CSV,
    store: bool = options.switch("--store", "Also store the lasts in the catalogue."),
    *,
    lasts: options.Lasts,
    standing: options.Standing,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """Grade a last: make it in other sizes and widths, and measure each from its file.

    Each measure has its own increment. What is held stays. With --hold bottom the seat and the
    tread keep their curves, and the shank takes up the length.

    Example: footfit grade-last derby-42 --sizes 38:46 --widths F,G -o run/
    """
    from dataclasses import replace

    from footfit.api.last_making import grader_of
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import (
        Outputs,
        folder_made,
        refuse_existing,
        refuse_twice,
        say_written,
        write_outputs,
    )
    from footfit.cli.progress import progress
    from footfit.errors import BadOption
    from footfit.pipeline.batch.sources import MESH_SUFFIXES, RUN_MANIFEST
    from footfit.pipeline.graded_runs.grade_store import (
        RunManifest,
        require_storable_run,
        storable_lasts,
        store_run,
    )
    from footfit.report.csv import csv_text
    from footfit.results import GradedRun
    from footfit.whole_files import require_folder, safe_file_name

    outputs = Outputs(table=GradedRun, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    require_folder(output)
    is_file = output.suffix.lower() in MESH_SUFFIXES or output.exists()
    if is_file and not output.is_dir():
        raise BadOption(
            "is the name of a file: name a folder for the lasts of the run", str(output)
        )
    with progress(mode) as bar:
        bar.show()
        grading = grader_of(
            last,
            sizes,
            catalogue=lasts.path(),
            store=store,
            widths=widths,
            size_system=size_system,
            base_size=base_size,
            base_width=base_width,
            hold=hold,
            rule=rule,
            family=family,
            **standing.keywords(),
        )
        files = {name: output / safe_file_name(name, ".stl") for name in grading.names()}
        for path in (*files.values(), output / RUN_MANIFEST) if output.is_dir() else ():
            refuse_existing(path, force=force)
            if path.exists() and Path(last).exists() and path.samefile(last):
                raise BadOption("is the base itself: name another folder", str(path))
        refuse_twice([*files.values(), output / RUN_MANIFEST, *outputs.paths])
        graded = grading.lasts()
        if store:
            require_storable_run(lasts.path(), grading, replace_stored=force)
            graded = storable_lasts(lasts.path(), graded)
        made = [replace(each, output=str(files[each.last])) for each in graded]
    run = replace(grading.run(made), folder=str(output))
    contents: dict[Path, bytes | str] = {files[each.last]: each.data for each in run.lasts}
    contents[output / RUN_MANIFEST] = csv_text(RunManifest, [RunManifest(run.lasts, run.side)])
    contents |= {path: outputs.csv_text([run]) for path in outputs.paths}

    def keep() -> None:
        nonlocal run
        if store:
            run = store_run(lasts.path(), grading, run, replace_stored=force)

    with folder_made(output):
        write_outputs(contents, force=force, then=keep)
    say_written(contents, quiet=mode.quiet)
    answer_result(run, mode, replace(outputs, csv=csv if csv == options.STDOUT else None))
