"""``footfit show-profile``: what a fit profile asks of each zone, and by which source."""

from __future__ import annotations

from footfit.cli import options


def show_profile(
    profile: str = options.argument(
        "NAME|FILE.toml", "Give the name of a profile, or a file; list-profiles shows the names."
    ),
    *,
    mode: options.OutputMode,
) -> object:
    """Show what a fit profile asks of each zone, how well that is founded, and by which source.

    Example: footfit show-profile walking
    """
    from footfit.pipeline.fit.fit_profile import fit_profile
    from footfit.pipeline.fit.zones import ZONES
    from footfit.results import ShownProfile

    asked = fit_profile(profile)
    units = {rule.zone: ZONES[rule.zone].unit for rule in asked.zones}
    return ShownProfile(asked, units, profile if profile.endswith(".toml") else None)
