"""Check: is everything in a catalogue as it was stored, and can it be used?"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from footfit.catalogue.store import Catalogue, open_catalogue
from footfit.errors import CheckFailed, FootfitError
from footfit.results import CheckOutcome, Finding


def checked(path: Path) -> CheckOutcome:
    """Everything that is not as it must be; no finding in a sound catalogue. Changes nothing.

    Raises
    ------
    NoCatalogue, CatalogueUnusable
        There is none, or it is too damaged to be opened.
    """
    with open_catalogue(path, older=True) as catalogue:
        found = catalogue.findings()
        named = {finding.last for finding in found if finding.code == "mesh_copy"}
        copies = catalogue.mesh_copy_names()
        found.extend(_meshes(catalogue, [name for name in copies if name not in named]))
        return CheckOutcome(str(path), len(catalogue.names()), len(copies), tuple(found))


def _meshes(catalogue: Catalogue, names: list[str]) -> Iterator[Finding]:
    """Copies whose bytes are what was stored and that make no mesh all the same."""
    from footfit.meshes.copies.compact_copy import expanded

    for name in names:
        try:
            copy = catalogue.mesh_copy(name)
            _, faces = expanded(copy.data)
        except FootfitError as error:
            yield Finding("mesh_copy", f"its mesh copy makes no mesh: {error.message}", name)
            continue
        if len(faces) != copy.faces:
            words = f"its mesh copy has {len(faces)} faces and says {copy.faces}"
            yield Finding("mesh_copy", words, name)


def require_sound(outcome: CheckOutcome, otherwise: str) -> None:
    """Refuse a catalogue that lost something; what ``upgrade-catalogue`` mends is no loss.

    Raises
    ------
    CheckFailed
        It has damage; ``otherwise`` says what was not done.
    """
    damage = [finding for finding in outcome.findings if finding.damage]
    if damage:
        raise CheckFailed(f"{failure_words(damage)}; {otherwise}", outcome.path)


def failure_words(found: list[Finding] | tuple[Finding, ...]) -> str:
    """How many findings, and the first of them."""
    first = found[0]
    where = f"{first.last}: " if first.last else ""
    things = "thing is" if len(found) == 1 else "things are"
    return f"{len(found)} {things} not as it must be, first {where}{first.message}"
