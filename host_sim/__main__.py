"""`python -m host_sim`: the same as `tools/octet`."""

import sys

from host_sim.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
