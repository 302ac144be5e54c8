"""Makes ``python -m up_cluster.fleet`` run the program."""

import sys
from functools import partial

from up.cli.entry import start

main = partial(start, "up_cluster.fleet.main")

if __name__ == "__main__":
    sys.exit(main())
