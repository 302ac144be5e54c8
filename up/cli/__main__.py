"""Makes ``python -m up.cli`` run the command ``up``."""

import sys

from up.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
