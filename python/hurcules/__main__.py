"""`python -m hurcules`: the command `hurcules`."""

import sys

from hurcules_command import main

sys.exit(main())
