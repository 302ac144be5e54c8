"""Makes `python -m up_proxy` run the program."""

import sys

from up_proxy.main import main

if __name__ == "__main__":
    sys.exit(main())
