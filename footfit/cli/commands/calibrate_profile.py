"""``footfit calibrate-profile``: a fit profile that learns from ratings of worn shoes."""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def calibrate_profile(
    profile: str = options.argument(
        "NAME|FILE.toml", "Give the fit profile that learns; entries of its name count."
    ),
    fits: Path | None = options.option(
        "--fits", "Take the entries of this CSV, as list-fits writes it.", "FILE.csv"
    ),
    output: Path | None = options.output_file(
        "--output", "Write the profile that was learned (.toml).", "-o"
    ),
    plot: Path | None = options.output_file(
        "--plot", "Draw ratings over clearance, with curve and bands before and after (.svg, .png)."
    ),
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """Learn the targets of a fit profile from the fit log, and say how sure they are.

    A zone changes from 20 wearers on, if some found it tight and some loose.

    Example: footfit calibrate-profile walking -o mine.toml
    """
    from footfit.api import files
    from footfit.cli.answers import answer_result, tell
    from footfit.cli.outputs import OutputFile, Outputs
    from footfit.errors import CheckFailed
    from footfit.pipeline.evidence.learned_profile import profile_text
    from footfit.pipeline.export import PICTURE_KINDS
    from footfit.results import Calibration

    file = OutputFile(output, ("toml",), lambda learned, _: profile_text(learned.after))
    drawn = OutputFile(plot, PICTURE_KINDS, files.picture)
    outputs = Outputs((file, drawn), force=force)
    outputs.refuse(as_json=mode.json)
    learned: Calibration = lasts.open().fit_log.calibrate_profile(profile, fits)
    if learned.applied:
        answer_result(learned, mode, outputs)
        return
    tell(learned, mode)
    words = "no zone may change yet, so the profile stays as it is"
    read = "1 entry was" if learned.entries == 1 else f"{learned.entries} entries were"
    raise CheckFailed(f"{words}; {read} read", profile)
