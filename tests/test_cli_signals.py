"""Signals: heard when they may be, and not before."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

from footfit.cli.signals import PATIENCE_S, RETRY_S, Listener

PROMISED_S = 2.0
"""How long a process may take to end, by docs/reliability.md."""
WHILE_BLOCKED = """
import os, signal, sys, time
from footfit.cli.signals import LISTENER, Stopped

number, steps = int(sys.argv[1]), []
signal.signal(number, signal.SIG_DFL)  # a job in the background starts with SIGINT ignored
try:
    with LISTENER.listen():
        LISTENER.heed()
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {number})
        try:
            os.kill(os.getpid(), number)
            time.sleep(0.2)
            steps.append("blocked")
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        steps.append("past it")
except Stopped:
    steps.append("stopped")
print(*steps)
"""
"""In a process of its own: in a test runner's, threads of others may take the signal."""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_that_the_main_thread_blocks_is_heard_afterwards(number: signal.Signals) -> None:
    """A worker is begun with them blocked: the listening thread must not take them meanwhile."""
    command = [sys.executable, "-c", WHILE_BLOCKED, str(int(number))]
    found = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (found.stdout.split(), found.returncode) == (["blocked", "stopped"], 0), found.stderr


def test_a_commands_own_words_say_what_is_done() -> None:
    listener = Listener()
    listener.so_far = "3 of 14 lasts are done: run the command again for the others"
    words = listener.words(signal.SIGINT)
    assert words == f"footfit: interrupted; {listener.so_far}"


def test_what_is_waited_for_leaves_time_to_end() -> None:
    assert 0.5 * PROMISED_S < PATIENCE_S + RETRY_S < 0.9 * PROMISED_S
