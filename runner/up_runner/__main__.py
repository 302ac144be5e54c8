"""`python -m up_runner` is the program itself."""

import sys

from up_runner.main import main

if __name__ == "__main__":
    sys.exit(main())
