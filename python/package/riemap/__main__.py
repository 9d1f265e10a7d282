"""``python -m riemap …``: the command line program, where it is installed."""

import os
import shutil
import subprocess
import sys
import sysconfig


def main() -> int:
    """Runs the program ``riemap`` beside the interpreter or on PATH with the arguments of this one."""
    path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ.get("PATH", "")])
    program = shutil.which("riemap", path=path)
    if program is None:
        print(
            "riemap: the command line program is not installed: this package is the library alone. "
            "Install the program with `cargo install riemap`, or call riemap.map from Python.",
            file=sys.stderr,
        )
        return 1
    if os.name == "posix":
        os.execv(program, [program, *sys.argv[1:]])
    return subprocess.call([program, *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
