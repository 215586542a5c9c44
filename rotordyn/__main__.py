"""``python -m rotordyn``."""

import sys

from rotordyn.cli import main

if __name__ == "__main__":
    sys.exit(main())
