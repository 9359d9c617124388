"""The gate for the numbers of users: arrays of doubles, or a refusal that says what to give.

Every public argument that is a number or an array goes through here, so that nothing is stripped
in silence (units, masks, imaginary parts) and nobody has to read NumPy's or pybind11's messages.
"""

from __future__ import annotations

from decimal import Decimal
from math import isfinite
from numbers import Real
from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pyrod.base.words import shortly

Array = NDArray[np.float64]

_REAL = "biuf"
"""Kinds of NumPy's numbers that are real."""
_DOUBLE = np.dtype(np.float64)
_PLAIN = frozenset((float, int))


def array(values: ArrayLike, name: str) -> Array:
    """The values as doubles; shares memory with an array that has them already."""
    if type(values) is np.ndarray and values.dtype.kind in _REAL:
        return values if values.dtype is _DOUBLE else values.astype(np.float64)
    if not (isinstance(values, tuple) and _PLAIN.issuperset(map(type, values))):
        _refuse_strangers(values, name)
    try:
        made = np.asarray(values)
    except (ValueError, TypeError, RuntimeError):
        raise ValueError(
            f"{name}: expected numbers, in rows of one length, got {_told(values)} of other things "
            "or with rows of several lengths"
        ) from None
    if made.dtype is _DOUBLE:
        return made
    if made.dtype.kind == "O" and (made.ndim or isinstance(values, (Real, Decimal))):
        made = _from_objects(made, name)
    if made.dtype.kind not in _REAL:
        _refuse_kind(values, made.dtype, name)
    return made.astype(np.float64, copy=False)


def finite(values: ArrayLike, name: str) -> Array:
    """The same, and none of them is NaN or infinite."""
    made = array(values, name)
    good = np.isfinite(made)
    if not good.all():
        place = np.argwhere(~good)[0].tolist()
        at = f"[{', '.join(map(str, place))}]" if place else ""
        raise ValueError(f"{name}{at}: expected finite numbers, got {made[tuple(place)]}")
    return made


def number(value: Any, name: str) -> float:
    """One number; an array of one is one."""
    if type(value) is float or (type(value) is int and abs(value) < 2**53):
        return float(value)
    made = array(value, name)
    if made.size != 1 or isinstance(value, (list, tuple)):
        what = "a list" if isinstance(value, (list, tuple)) else f"an array of shape {made.shape}"
        raise ValueError(f"{name}: expected a number, got {what}")
    return float(made.item())


def not_negative(value: Any, name: str) -> float:
    """One finite number, zero or larger."""
    made = number(value, name)
    if not (isfinite(made) and made >= 0):
        raise ValueError(f"{name}: must be finite and not negative, got {made}")
    return made


def number_as(value: Any, name: str, wanted: str) -> float:
    """The same; what is no number is refused with the words of what is wanted."""
    try:
        return number(value, name)
    except (TypeError, ValueError) as error:
        raise ValueError(
            f"{name}: {wanted}, got {shortly(value)}; {str(error).removeprefix(f'{name}: ')}"
        ) from None


def whole(value: Any, name: str) -> int:
    """One whole number."""
    if type(value) is int:
        return value
    made = number(value, name)
    if not (isfinite(made) and made == int(made)):
        raise ValueError(f"{name}: must be a whole number, got {made:g}")
    return int(made)


def yes_or_no(value: Any, name: str) -> bool:
    """A truth; 0 and 1 are some."""
    if not isinstance(value, (bool, np.bool_)) and not (type(value) is int and value in (0, 1)):
        raise TypeError(f"{name}: expected True or False, got {shortly(value)}")
    return bool(value)


def rows(values: ArrayLike, name: str, width: int) -> Array:
    """A table with so many columns."""
    made = array(values, name)
    if made.ndim != 2 or made.shape[1] != width:
        raise ValueError(
            f"{name}: expected an array of shape (n, {width}), got {made.shape}"
            f"{transposed(made, width)}"
        )
    return made


def transposed(made: Array, *widths: int) -> str:
    """What to do about a table that lies on its side; nothing if it does not."""
    lies = made.ndim == 2 and made.shape[0] in widths and made.shape[1] not in widths
    return "; transpose it (.T), a row is a point" if lies else ""


def precision_of(values: Any) -> float:
    """Relative rounding of the numbers as they came: of doubles unless an array has fewer bits."""
    while isinstance(values, (list, tuple)) and values:
        values = values[0]
    dtype = getattr(values, "dtype", None)
    if dtype is None and hasattr(values, "__array__"):
        dtype = np.asarray(values).dtype
    eps = np.finfo(np.float64).eps
    is_float = isinstance(dtype, np.dtype) and dtype.kind == "f"
    return float(max(eps, np.finfo(dtype).eps) if is_float else eps)


def is_rotation(value: Any) -> bool:
    """Whether it is a ``scipy.spatial.transform.Rotation``, or works like one."""
    return hasattr(value, "as_quat") and hasattr(value, "as_matrix")


def _refuse_strangers(values: Any, name: str) -> None:
    """What NumPy would strip of its meaning, also inside of lists."""
    kind = type(values)
    if kind is float or kind is int or kind is np.float64:
        return
    if isinstance(values, (list, tuple)):
        for value in values:
            _refuse_strangers(value, name)
    elif isinstance(values, np.ma.MaskedArray):
        _refuse_masked(values, name)
    elif _has_unit(values):
        raise TypeError(
            f"{name}: expected plain numbers, got {_told(values)} with the unit "
            f"{getattr(values, 'units', getattr(values, 'unit', '?'))}; give its magnitude in SI "
            "units, .to_base_units().magnitude"
        )
    elif is_rotation(values):
        raise TypeError(
            f"{name}: expected numbers, got a Rotation; give .as_rotvec(), or .as_quat() with the "
            "scalar first, as is needed"
        )


def _has_unit(value: Any) -> bool:
    """Quantities of pint, astropy and unyt."""
    if hasattr(type(value), "to_base_units"):
        return True
    return isinstance(value, np.ndarray) and (hasattr(value, "units") or hasattr(value, "unit"))


def _refuse_masked(values: np.ma.MaskedArray[Any, Any], name: str) -> None:
    masked = np.argwhere(np.ma.getmaskarray(values))
    if len(masked):
        first = ", ".join(map(str, masked[0].tolist()))
        raise ValueError(
            f"{name}[{first}]: is masked, as are {len(masked)} numbers in all; leave these rows "
            "out (numpy.ma.compress_rows) or fill them in"
        )


def _from_objects(made: NDArray[Any], name: str) -> Array:
    """Objects that are real numbers, as fractions, decimals and large whole numbers are."""
    for value in made.flat:
        _refuse_strangers(value, name)
        if not isinstance(value, (Real, Decimal)):
            raise TypeError(f"{name}: expected numbers, got {_told(value)} among them")
    try:
        return made.astype(np.float64)
    except OverflowError:
        raise ValueError(f"{name}: a number is too large, beyond 1.8e308") from None


def _refuse_kind(values: Any, dtype: np.dtype[Any], name: str) -> NoReturn:
    what, remedy = _told(values), ""
    if dtype.kind == "c":
        what, remedy = "complex ones", "; take their real part (.real) if the rest is rounding"
        raise TypeError(f"{name}: expected real numbers, got {what}{remedy}")
    if dtype.names:
        what = f"records with the fields {', '.join(dtype.names)}"
        remedy = "; stack their columns, numpy.column_stack([a[field] for field in a.dtype.names])"
    elif dtype.kind in "US":
        remedy = "; texts with units are for scene files, here give the number in SI units"
    raise TypeError(f"{name}: expected numbers, got {what}{remedy}")


def _told(value: Any) -> str:
    """What came, in few words."""
    if value is None or isinstance(value, (str, bytes, bool)):
        return shortly(value)
    kind = type(value).__name__
    return f"{'an' if kind[:1].lower() in 'aeio' else 'a'} {kind}"
