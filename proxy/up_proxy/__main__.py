"""`python -m up_proxy` is the program itself."""

import sys

from up_proxy.main import main

if __name__ == "__main__":
    sys.exit(main())
