"""``python -m footfit``, and the script ``footfit``."""

from __future__ import annotations

import gc
import signal

GARBAGE_AFTER = 100_000
"""So many new containers until Python looks for unused cycles. A match makes fewer, and nearly all
are modules and answers that stay: with Python's own 700 a tenth of its time went into looking.
"""


def main() -> None:
    """Load the command line and run it.

    Until it has loaded, Ctrl-C ends the process as SIGTERM does, without a traceback; then
    ``cli.signals`` hears both. What was ignored stays ignored.

    At the end nothing is looked through for unused cycles: the process ends, and all its memory
    goes. That took a sixth of the time of a match.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    gc.set_threshold(GARBAGE_AFTER)
    from footfit.cli.app import main as run

    try:
        run()
    finally:
        gc.freeze()


if __name__ == "__main__":
    main()
