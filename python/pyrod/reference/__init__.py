"""Exact solutions from JSON files, as scenes.

A folder of such files comes with pyrod (`folder`; in its source ``tests/reference``, where a README
explains the format); other solvers can be tested against it, and pyrod against other files of the
same form.
"""

from pyrod.reference._cases import Case, NotPossible, folder, load

__all__ = ["Case", "NotPossible", "folder", "load"]
