"""JSON read strictly: every value has the type and the range it must have, or a sentence names its place.

A reader is a function of the value and its place, such as `document.panels[2].maximum`.
"""

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import cache, reduce
from operator import or_
from types import NoneType, UnionType
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

from bihdist_core.errors import ParameterError
from bihdist_core.sentences import shortened

Reader = Callable[[Any, str], Any]
Made = TypeVar("Made")

NONE: Mapping[Any, Reader] = {}


def record(data: Any, where: str, readers: Mapping[str, Reader], needed: set[str] | None = None) -> dict[str, Any]:
    """Return the values of a record by name; those needed must be there (all, if not given), others must not."""
    if not isinstance(data, dict):
        raise ParameterError(f"{where} must be an object in braces, not {shown(data)}.")
    unknown = sorted(set(data) - set(readers))
    if unknown:
        raise ParameterError(f"{where} has the unknown key {shortened(repr(unknown[0]), 60)}.")
    missing = sorted((set(readers) if needed is None else needed) - set(data))
    if missing:
        raise ParameterError(f"{where} has no {missing[0]!r}.")
    return {name: readers[name](value, f"{where}.{name}") for name, value in data.items()}


def listed(read: Reader) -> Reader:
    """Return a reader of lists, whose entries `read` reads."""

    def reader(data: Any, where: str) -> tuple[Any, ...]:
        if not isinstance(data, list):
            raise ParameterError(f"{where} must be a list, not {shown(data)}.")
        return tuple(read(value, f"{where}[{k}]") for k, value in enumerate(data))

    return reader


def numbers(count: int) -> Reader:
    """Return a reader of lists of so many finite numbers."""

    def reader(data: Any, where: str) -> tuple[Any, ...]:
        values: tuple[float, ...] = listed(number)(data, where)
        if len(values) != count:
            raise ParameterError(f"{where} must be {count} numbers, not {len(values)}.")
        return values

    return reader


def or_none(read: Reader) -> Reader:
    """Return a reader of null, and of what `read` reads."""
    return lambda data, where: None if data is None else read(data, where)


def placed(make: Callable[..., Made], where: str, **values: Any) -> Made:
    """Make an object of values; errors in them name their place."""
    try:
        return make(**values)
    except ParameterError as error:
        raise ParameterError(f"{where}: {error}") from None


def text(data: Any, where: str) -> str:
    """Return a text; ParameterError, with the place, for anything else."""
    if not isinstance(data, str):
        raise ParameterError(f"{where} must be a text, not {shown(data)}.")
    return data


def flag(data: Any, where: str) -> bool:
    """True or false; ParameterError, with the place, for anything else."""
    if not isinstance(data, bool):
        raise ParameterError(f"{where} must be true or false, not {shown(data)}.")
    return data


def whole(data: Any, where: str) -> int:
    """Return a whole number from 0 to 2**63 - 1; ParameterError, with the place, for anything else."""
    if not isinstance(data, int) or isinstance(data, bool) or not 0 <= data < 2**63:
        raise ParameterError(f"{where} must be a whole number of at least 0, not {shown(data)}.")
    return data


def number(data: Any, where: str) -> float:
    """Return a finite number; ParameterError, with the place, for anything else."""
    # A whole number of many digits is no float.
    fits = isinstance(data, float) or (isinstance(data, int) and abs(data) < 10**300)
    if isinstance(data, bool) or not fits or not math.isfinite(data):
        raise ParameterError(f"{where} must be a number, not {shown(data)}.")
    return float(data)


def reader_of(kind: Any, special: Mapping[Any, Reader] = NONE) -> Reader:
    """Return the reader of values of a type: of records for dataclasses, of lists for tuples.

    `special` has the readers of types that are written in another way. TypeError for a type that JSON cannot hold.
    """
    readers = {str: text, bool: flag, int: whole, float: number, **special}
    if kind in readers:
        return readers[kind]
    origin, arguments = get_origin(kind), get_args(kind)
    if origin in (Union, UnionType) and NoneType in arguments:
        return or_none(reader_of(reduce(or_, (each for each in arguments if each is not NoneType)), special))
    if origin is tuple and arguments[-1] is Ellipsis:
        return listed(reader_of(arguments[0], special))
    if origin is tuple and set(arguments) == {float}:
        return numbers(len(arguments))
    if origin is tuple:
        return _row([reader_of(each, special) for each in arguments])
    if not (is_dataclass(kind) and isinstance(kind, type)):
        raise TypeError(f"Nothing in JSON is a {kind}.")
    needed = {each.name for each in fields(kind) if each.default is MISSING}
    named = field_readers(kind, special)
    return lambda data, where: placed(kind, where, **record(data, where, named, needed))


def field_readers(kind: Any, special: Mapping[Any, Reader] = NONE) -> dict[str, Reader]:
    """Return the readers of a dataclass' fields."""
    types = _types_of_fields(kind)
    return {each.name: reader_of(types[each.name], special) for each in fields(kind)}


_types_of_fields = cache(get_type_hints)
"""Dataclasses do not change, and their annotations take long to read."""


def _row(readers: list[Reader]) -> Reader:
    def reader(data: Any, where: str) -> tuple[Any, ...]:
        if not isinstance(data, list) or len(data) != len(readers):
            raise ParameterError(f"{where} must be a list of {len(readers)}, not {shown(data)}.")
        return tuple(read(value, f"{where}[{k}]") for k, (read, value) in enumerate(zip(readers, data, strict=True)))

    return reader


def shown(data: Any) -> str:
    """Return a value as it stands in a sentence."""
    if isinstance(data, int) and abs(data) >= 10**30:
        return "a number of many digits"
    return shortened(json.dumps(data, ensure_ascii=False), 40)
