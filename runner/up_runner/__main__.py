"""Makes `python -m up_runner` run the program."""

import sys

from up_runner.main import main

if __name__ == "__main__":
    sys.exit(main())
