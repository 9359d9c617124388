"""Methods that are functions of modules above: named where they are declared, found when used."""

from __future__ import annotations

from collections.abc import Callable
from functools import update_wrapper
from importlib import import_module
from types import MethodType
from typing import Any, TypeVar, cast

Method = TypeVar("Method", bound=Callable[..., Any])


class Borrowed:
    """A function elsewhere as a method: the object is its first argument."""

    def __init__(self, place: str, declared: Callable[..., Any]) -> None:
        self.place = place
        update_wrapper(self, declared)

    @property
    def function(self) -> Callable[..., Any]:
        """The function itself; its module is imported now."""
        module, _, name = self.place.partition(":")
        return cast("Callable[..., Any]", getattr(import_module(module), name))

    def __get__(self, thing: object, kind: type | None = None) -> Any:
        return self.function if thing is None else MethodType(self.function, thing)

    def __call__(self, *values: Any, **options: Any) -> Any:
        return self.function(*values, **options)


def borrowed(place: str) -> Callable[[Method], Method]:
    """Makes a method out of a declaration: what it does is done by ``"module:function"``.

    Signature and docstring are those of the function for all who ask at run time. The declaration
    tells them to editors and type checkers, which do not run it; a test compares the two.
    """

    def method(declared: Method) -> Method:
        return cast("Method", Borrowed(place, declared))

    return method
