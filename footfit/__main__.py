"""``python -m footfit``, and the script ``footfit``."""

from __future__ import annotations

import signal


def main() -> None:
    """Load the command line and run it.

    Until it has loaded, Ctrl-C ends the process as SIGTERM does, without a traceback; then
    ``cli.signals`` hears both. What was ignored stays ignored.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    from footfit.cli.app import main as run

    run()


if __name__ == "__main__":
    main()
