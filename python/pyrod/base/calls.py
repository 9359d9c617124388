"""Calls that Python refuses, answered with what to write instead."""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar, cast

import pyrod._core as _core
from pyrod.base.words import listed, meant, shortly

Function = TypeVar("Function", bound=Callable[..., Any])


def spelled(function: Function) -> Function:
    """The function; calls with arguments that it does not have are told what it takes."""

    @wraps(function)
    def called(*values: Any, **options: Any) -> Any:
        try:
            return function(*values, **options)
        except TypeError as error:
            refused = call_in_words(error, function, function.__qualname__)
            if refused is None:
                raise
        raise refused from None

    return cast("Function", called)


class _OfInit:
    """The signature of a class is that of its ``__init__``, not of ``Spelled.__call__``."""

    def __get__(self, cls: type | None, kind: type) -> Any:
        if cls is None:
            return None
        takes = inspect.signature(cls.__init__)  # type: ignore[misc]
        return takes.replace(parameters=list(takes.parameters.values())[1:])


class Spelled(type):
    """Of classes: calls with arguments that a class does not take are told what it takes."""

    __signature__ = _OfInit()

    if not TYPE_CHECKING:  # who would see no arguments at all

        def __call__(cls, *values: Any, **options: Any) -> Any:
            try:
                return super().__call__(*values, **options)
            except TypeError as error:
                refused = call_in_words(error, cls, cls.__name__)
                if refused is None:
                    raise
            raise refused from None


def users_level() -> int:
    """For ``warnings.warn`` in the caller: how far up the stack the user's own code is."""
    frame, level = inspect.currentframe(), 0
    while frame is not None and frame.f_globals.get("__name__", "").startswith("pyrod."):
        frame, level = frame.f_back, level + 1
    return level


def call_in_words(error: TypeError, called: Callable[..., Any], name: str) -> TypeError | None:
    """What is wrong with the call, and what to write; None if it failed inside, not as a call."""
    trace = error.__traceback__
    if trace is None or trace.tb_next is not None:
        return None
    text = str(error)
    takes = _signature(called)
    if takes is None:
        return None
    names = list(takes.parameters)
    if match := re.search(r"unexpected keyword argument '(\w+)'", text):
        wrong = match[1]
        tuned = "options" in names and hasattr(_core.Options, wrong)
        if tuned and not meant(wrong, names):
            return TypeError(f"{name}: {wrong} is one of options=Options({wrong}=...)")
        told = f"{name}: there is no {wrong}{meant(wrong, names) or f'; it takes {listed(names)}'}"
    elif match := re.search(r"missing \d+ required .*?arguments?: (.*)", text):
        missing = match[1].replace("'", "")
        are = "are" if " and " in missing else "is"
        told = f"{name}: {missing} {are} missing; write {_written(name, takes)}"
    elif re.search(r"takes .* positional arguments? but", text):
        told = f"{name}: there are too many arguments; write {_written(name, takes)}"
    elif match := re.search(r"multiple values for argument '(\w+)'", text):
        told = f"{name}: {match[1]} is given twice, by its place and by name; write "
        told += _written(name, takes)
    else:
        return None
    return TypeError(told)


def _signature(called: Callable[..., Any]) -> inspect.Signature | None:
    try:
        whole = inspect.signature(called)
    except ValueError:
        return None
    kept = [p for n, p in whole.parameters.items() if n not in ("self", "cls") and n[0] != "_"]
    return whole.replace(parameters=kept)


def _written(name: str, takes: inspect.Signature) -> str:
    """A call: what must be given by its name, what may be given with its default."""
    words, by_name = [], False
    for one in takes.parameters.values():
        if one.kind is one.KEYWORD_ONLY and not by_name:
            words.append("*")
            by_name = True
        stars = "*" * (one.kind is one.VAR_POSITIONAL) + "**" * (one.kind is one.VAR_KEYWORD)
        default = "" if one.default is one.empty else f"={_default(one.default)}"
        words.append(f"{stars}{one.name}{default}")
    return f"{name}({', '.join(words)})"


def _default(value: Any) -> str:
    text = shortly(value)
    return text if len(text) < 20 and not text.startswith("<") else "..."


def no_attribute(thing: object, name: str) -> AttributeError:
    """What to raise where a thing has nothing of this name, with what may have been meant.

    Without the thing itself, of which Python would make the same guess once more.
    """
    held: Any = getattr(type(thing), name, None)
    if hasattr(held, "__get__"):  # a property that refuses, in words of its own
        try:
            held.__get__(thing, type(thing))
        except AttributeError as error:
            return error
    guess = "" if name[0] == "_" else meant(name, [n for n in dir(thing) if n[0] != "_"])
    words = f"{type(thing).__name__} has no {name!r}{guess}"
    return AttributeError(words, name=name, obj=None)


def _refuse_attribute(thing: object, name: str) -> Any:
    raise no_attribute(thing, name)


class Answering(metaclass=Spelled):
    """Base of what users make: names that it does not have are answered with those it has."""

    if not TYPE_CHECKING:  # who would find every name
        __getattr__ = _refuse_attribute
