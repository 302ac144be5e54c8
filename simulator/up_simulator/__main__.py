"""Makes ``python -m up_simulator`` run ``up-sim``."""

import sys
from functools import partial

from up.cli.entry import start

main = partial(start, "up_simulator.cli")

if __name__ == "__main__":
    sys.exit(main())
