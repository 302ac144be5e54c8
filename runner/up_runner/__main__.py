"""Makes ``python -m up_runner`` run the program."""

import sys
from functools import partial

from up.cli.entry import start

main = partial(start, "up_runner.main")

if __name__ == "__main__":
    sys.exit(main())
