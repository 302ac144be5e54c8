"""The program: ``python -m up_simulator VERB``, which is ``up-sim``."""

import sys

from up_simulator.cli import main

sys.exit(main())
