"""Signals: heard when they may be, and not before."""

from __future__ import annotations

import os
import signal
import time

import pytest

from footfit.cli.signals import LISTENER, Stopped


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_that_the_main_thread_blocks_is_heard_afterwards(number: signal.Signals) -> None:
    """A worker is begun with them blocked: the listening thread must not take them meanwhile."""
    steps: list[str] = []
    with pytest.raises(Stopped):
        _signalled_while_blocked(number, steps)
    assert steps == ["blocked"]


def _signalled_while_blocked(number: signal.Signals, steps: list[str]) -> None:
    with LISTENER.listening():
        LISTENER.heed()
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {number})
        try:
            os.kill(os.getpid(), number)
            time.sleep(0.2)
            steps.append("blocked")
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        steps.append("past it")
