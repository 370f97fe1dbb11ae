"""Two thousand of the twenty thousand mutated files that ``make torture`` reads."""

from __future__ import annotations

import pytest

from tools import fuzz


def test_mutated_files_give_a_mesh_or_footfits_own_refusal():
    found = fuzz.tallies(2_000, seed=5)
    assert [line for tally in found.values() for line in tally.failures] == []
    for name, tally in found.items():
        assert tally.read > 0, f"no mutated {name} was read: the mutations are too rough"
        assert sum(tally.refused.values()) > 0, name


@pytest.mark.parametrize("fault", [ValueError("x"), MemoryError(), RuntimeWarning("x")])
def test_the_trial_sees_what_it_looks_for(monkeypatch, fault):
    def broken(*_arguments, **_options):
        raise fault

    monkeypatch.setattr(fuzz, "scan_from_bytes", broken)
    tally = fuzz.Tally()
    fuzz.trial(b"", None, tally, "planted")
    assert len(tally.failures) == 1


def test_the_same_seed_gives_the_same_mutations():
    one, other = (fuzz.tallies(120, seed=3) for _ in range(2))
    assert [(t.read, t.refused) for t in one.values()] == [
        (t.read, t.refused) for t in other.values()
    ]
