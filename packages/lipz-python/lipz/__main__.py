"""`python -m lipz`: runs the program with the same arguments."""

import os
import sys

from .program import path

arguments = [path(), *sys.argv[1:]]
if os.name == "nt":
    # `execv` of Windows returns to the shell before the program ends.
    import subprocess

    sys.exit(subprocess.call(arguments))
os.execv(arguments[0], arguments)
