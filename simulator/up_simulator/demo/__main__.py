"""Makes ``python -m up_simulator.demo`` run ``make run``."""

import sys
from functools import partial

from up.cli.entry import start

main = partial(start, "up_simulator.demo.main")

if __name__ == "__main__":
    sys.exit(main())
