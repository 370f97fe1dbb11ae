"""``footfit record-fit``: what a wearer said of a shoe, with the clearances that the match had."""

from __future__ import annotations

from footfit.cli import options


def record_fit(
    last: str = options.LAST,
    foot: str = options.argument("FOOT", "Give the scan of the foot that wore the shoe."),
    zone: list[str] = options.option(
        "--zone",
        "Rate a place from -2 (much too tight) to +2 (much too loose), such as ball=+1. The places "
        "are toe, ball, waist, instep, heel and opening. Give it once for each place.",
        "PLACE=N",
        default=[],
    ),
    comfort: float | None = options.option(
        "--comfort", "Rate the comfort from 0 (worst) to 100 (best).", "N"
    ),
    kept: bool = options.switch("--kept", "The customer kept the shoes."),
    returned: bool = options.switch("--returned", "The customer brought the shoes back."),
    altered: str | None = options.option(
        "--altered", "The shoes were altered; say what, without a name.", "TEXT"
    ),
    hours: float | None = options.option("--hours", "Say for how many hours they were worn.", "N"),
    days: float | None = options.option("--days", "Say on how many days they were worn.", "N"),
    wearer: str | None = options.option(
        "--wearer", "Give a code for the wearer, never a name; forget-fits removes by it.", "CODE"
    ),
    consent: bool = options.switch(
        "--consent", "The wearer agrees that ratings and clearances are kept."
    ),
    profile: str = options.option(
        "--profile", "Choose the fit profile of the match.", "NAME|FILE.toml", default="walking"
    ),
    *,
    lasts: options.Lasts,
    reading: options.FootReading,
    worn: options.WornWith,
    mode: options.OutputMode,
) -> object:
    """Record how a shoe fitted: the ratings and the clearances, no scan and no name.

    Example: footfit record-fit derby-42 foot.stl --zone ball=+1 --kept --consent
    """
    from footfit.cli.answers import sources_of
    from footfit.errors import BadOption
    from footfit.pipeline.evidence.recording import Said

    outcomes = {"kept": kept, "returned": returned, "altered": altered is not None}
    chosen = [name for name, given in outcomes.items() if given]
    if len(chosen) > 1:
        raise BadOption("a shoe was kept, returned or altered: give one of them")
    said = Said(
        zones=tuple(zone),
        comfort=comfort,
        outcome=chosen[0] if chosen else None,  # type: ignore[arg-type]
        alteration=altered,
        hours=hours,
        days=days,
        wearer=wearer,
    )
    sources = sources_of([foot], reading, quiet=mode.quiet)
    if len(sources) != 1:
        raise BadOption(f"holds {len(sources)} meshes; name one foot", foot)
    return lasts.open().fit_log.record(
        last,
        sources[0],
        said,
        consent=consent,
        profile=profile,
        **reading.keywords(),
        **worn.keywords(),
    )
