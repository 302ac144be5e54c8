"""Makes ``python -m up.cli`` run the command ``up``."""

import sys
from functools import partial

from up.cli.entry import start

main = partial(start, "up.cli.main")

if __name__ == "__main__":
    sys.exit(main())
