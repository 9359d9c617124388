"""The command ``pyrod``.

Exit codes: 0 done; 1 no equilibrium, or a check that failed; 2 a wrong command line, scene or file;
130 stopped by Ctrl-C.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from typing import NoReturn

import pyrod
from pyrod.cli import check, demo, follow, info, solve, sweep
from pyrod.cli.output import Output

COMMANDS = (solve, sweep, follow, check, info, demo)
FAILED, WRONG, STOPPED = 1, 2, 130


class _Parser(argparse.ArgumentParser):
    """Says what is wrong as all other errors are said."""

    def error(self, message: str) -> NoReturn:
        self.exit(WRONG, f"pyrod: error: {message}\nTry '{self.prog} --help'.\n")


def parser() -> argparse.ArgumentParser:
    """The command line."""
    top = _Parser(
        prog="pyrod",
        description="Equilibria of elastic rods.",
        epilog="Exit codes: 0 done, 1 no equilibrium or a failed check, 2 wrong input, 130 Ctrl-C.",
    )
    top.add_argument("--version", action="version", version=pyrod.__version__)
    top.add_argument(
        "--cmakedir",
        action="store_true",
        help="print the folder for CMake's pyrod_DIR, so that C++ programs find this pyrod",
    )
    top.add_argument("--include", action="store_true", help="print the folder of the C++ headers")
    commands = top.add_subparsers(title="commands", metavar="COMMAND", parser_class=_Parser)
    for command in COMMANDS:
        sub = commands.add_parser(command.NAME, help=command.HELP, description=command.__doc__)
        sub.add_argument("--json", action="store_true", help="print one JSON object, for programs")
        command.add_arguments(sub)
        sub.set_defaults(run=command.run)
    return top


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command line; returns the exit code."""
    top = parser()
    args = top.parse_args(arguments)
    if args.cmakedir or args.include:
        print(pyrod.get_cmake_dir() if args.cmakedir else pyrod.get_include())
        return 0
    if "run" not in args:
        top.print_help()
        return 0
    output = Output(args.json)
    try:
        return args.run(args, output)
    except KeyboardInterrupt:
        output.error("stopped", "stopped by Ctrl-C")
        return STOPPED
    except BrokenPipeError:  # whoever read the output has seen enough
        sys.stderr.close()
        return 0
    except pyrod.NotConverged as error:
        output.error("not_converged", str(error))
        return FAILED
    except (ValueError, TypeError, OSError, ImportError) as error:
        output.error("wrong_input", str(error))
        return WRONG
