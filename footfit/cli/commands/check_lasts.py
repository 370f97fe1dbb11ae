"""``footfit check-lasts``: do the lasts of a catalogue agree with each other and their labels?"""

from __future__ import annotations

from pathlib import Path

from footfit.cli import options


def check_lasts(
    tolerance: str | None = options.option(
        "--tolerance",
        "Allow so many mm by kind of measure. Else girth=2,length=1.5,width=1,height=1.5.",
        "KIND=MM,...",
    ),
    csv: Path | None = options.CSV,
    *,
    lasts: options.Lasts,
    force: bool = options.FORCE,
    mode: options.OutputMode,
) -> None:
    """Check all lasts: twins, labels that the shape contradicts, and families whose runs jump.

    It lists each finding with its reason. If one is a fault it exits with 7. Near twins and
    doubtful sides are worth a look, and no fault.

    It reads no meshes, so a label of the heel height hides a wrong heel. check-run FAMILY reads how
    each shape of a run stands.

    Example: footfit check-lasts --csv findings.csv
    """
    from footfit.cli.answers import answer_result
    from footfit.cli.outputs import Outputs
    from footfit.errors import CheckFailed
    from footfit.results.population.checked_lasts import LastsCheck

    outputs = Outputs(table=LastsCheck, csv=csv, force=force)
    outputs.refuse(as_json=mode.json)
    check = lasts.open().check_lasts(tolerance)
    answer_result(check, mode, outputs)
    if check.faults:
        first, count = check.faults[0], len(check.faults)
        faults = "1 fault" if count == 1 else f"{count} faults, the first"
        raise CheckFailed(f"{faults}: {first.last}: {first.message}", check.path)
