"""Lets `python -m mpmgeo` do what the command `mpmgeo` does."""

import sys

from mpmgeo.cli import main

sys.exit(main())
