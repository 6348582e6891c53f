"""Writes inputs for libFuzzer to begin with, seeded; one byte alone reaches none of the solver.

python tests/fuzz/seeds.py FOLDER
"""

import random
import sys
from pathlib import Path

folder = Path(sys.argv[1])
source = random.Random(0)
for i in range(64):
    (folder / f"seed_{i}").write_bytes(source.randbytes(20 + 6 * i))
