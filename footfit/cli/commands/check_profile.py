"""``footfit check-profile``: is a file a sound fit profile?"""

from __future__ import annotations

from footfit.cli import options


def check_profile(
    file: str = options.argument("FILE.toml", "Give the file of a fit profile."),
    *,
    mode: options.OutputMode,
) -> object:
    """Check a fit profile of your own; what is wrong is said in one line.

    Example: footfit check-profile mine.toml
    """
    from footfit.errors import BadOption
    from footfit.pipeline.fit.fit_profile import NO_SOURCE, fit_profile
    from footfit.results import CheckedProfile

    if not file.endswith(".toml"):
        raise BadOption("is no .toml file; show-profile shows the profiles of footfit", file)
    profile = fit_profile(file)
    return CheckedProfile(
        path=file,
        name=profile.name,
        version=profile.version,
        sha256=profile.sha256,
        zones=tuple(rule.zone for rule in profile.zones),
        without_source=tuple(r.zone for r in profile.zones if r.source == NO_SOURCE),
    )
