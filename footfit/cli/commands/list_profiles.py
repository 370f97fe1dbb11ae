"""``footfit list-profiles``: the fit profiles that come with footfit."""

from __future__ import annotations

from footfit.cli import options


def list_profiles(*, mode: options.OutputMode) -> object:
    """List the fit profiles: what each kind of shoe asks for.

    Example: footfit list-profiles
    """
    from footfit.pipeline.fit.fit_profile import fit_profile, shipped
    from footfit.results import ProfileList

    return ProfileList(tuple(fit_profile(name) for name in shipped()))
