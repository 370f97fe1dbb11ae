"""``python -m footfit`` is ``footfit``."""

from footfit.cli.app import main

if __name__ == "__main__":
    main()
