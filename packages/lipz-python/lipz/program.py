"""The installed program."""

from __future__ import annotations

import os
import sys
import sysconfig


def path() -> str:
    """Returns the path of the installed program.

    Raises FileNotFoundError if it is not in a folder for scripts.
    """
    name = "lipz" + (sysconfig.get_config_var("EXE") or "")
    folders = [
        sysconfig.get_path("scripts"),
        # `pip install --user`.
        sysconfig.get_path("scripts", scheme=_user_scheme()),
        # `pip install --target` and `--prefix`: the module is in FOLDER or FOLDER/lib/pythonX/site-packages.
        os.path.join(os.path.dirname(os.path.dirname(__file__)), "bin"),
        os.path.join(os.path.dirname(__file__), *[".."] * 4, "bin"),
        os.path.dirname(sys.executable),
    ]
    for folder in folders:
        program = os.path.normpath(os.path.join(folder, name))
        if os.path.isfile(program):
            return program
    raise FileNotFoundError(name)


def _user_scheme() -> str:
    if sys.version_info >= (3, 10):
        return sysconfig.get_preferred_scheme("user")
    return "nt_user" if os.name == "nt" else "posix_user"
