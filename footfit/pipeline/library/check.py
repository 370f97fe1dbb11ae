"""Check: is everything in a catalogue as it was stored, and can it be used?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import CheckFailed, FootfitError
from footfit.locations import Location
from footfit.results import CheckOutcome, Finding


def check(path: Location) -> CheckOutcome:
    """Compare a catalogue with what was stored, and change nothing; a sound one has no findings.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is no catalogue, or it is too damaged to be opened.
    """
    with open_catalogue(path, older=True) as catalogue:
        findings = catalogue.findings()
        named = {finding.last for finding in findings if finding.code == "mesh_copy"}
        copies = catalogue.mesh_copy_names()
        findings.extend(_mesh_findings(catalogue, [name for name in copies if name not in named]))
        return CheckOutcome(str(path), len(catalogue.names()), len(copies), tuple(findings))


def _mesh_findings(catalogue: Catalogue, names: list[str]) -> Iterator[Finding]:
    """Mesh copies that are as they were stored, and still do not give a mesh."""
    from footfit.meshes.copies.compact_copy import expanded_mesh

    for name in names:
        try:
            copy = catalogue.mesh_copy(name)
            _, faces = expanded_mesh(copy.data)
        except FootfitError as error:
            words = f"its mesh copy does not give a mesh: {error.message}"
            yield Finding("mesh_copy", words, name)
            continue
        if len(faces) != copy.faces:
            words = f"its mesh copy has {len(faces)} faces instead of {copy.faces}"
            yield Finding("mesh_copy", words, name)


def require_sound(outcome: CheckOutcome, otherwise: str) -> None:
    """Refuse a damaged catalogue; what ``upgrade-catalogue`` can repair is not damage.

    Raises
    ------
    CheckFailed
        The catalogue is damaged; ``otherwise`` says what was therefore not done.
    """
    damage = [finding for finding in outcome.findings if finding.damage]
    if damage:
        raise CheckFailed(f"{failure_words(damage)}; {otherwise}", outcome.path)


def failure_words(findings: Sequence[Finding]) -> str:
    """The number of findings, and the first of them."""
    first = findings[0]
    where = f"{first.last}: " if first.last else ""
    count = "1 finding" if len(findings) == 1 else f"{len(findings)} findings, the first"
    return f"{count}: {where}{first.message}"
