"""`python -m up_ground` is the program itself."""

import sys

from up_ground.main import main

if __name__ == "__main__":
    sys.exit(main())
