"""``python -m pyrod --cmakedir`` and ``--version``."""

import argparse
from pathlib import Path

import pyrod


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m pyrod", description=pyrod.__doc__)
    parser.add_argument("--version", action="version", version=pyrod.__version__)
    parser.add_argument(
        "--cmakedir",
        action="store_true",
        help="print the folder for CMake's pyrod_DIR, so that C++ programs find this pyrod",
    )
    if parser.parse_args().cmakedir:
        print(Path(pyrod.__path__[0]) / "lib" / "cmake" / "pyrod")
    else:
        parser.print_help()


if __name__ == "__main__":
    main()
