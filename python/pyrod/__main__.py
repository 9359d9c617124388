"""``python -m pyrod`` is the command ``pyrod``."""

import sys

from pyrod.cli import main

if __name__ == "__main__":
    sys.exit(main())
