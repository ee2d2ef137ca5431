# SPDX-License-Identifier: MIT
"""Calls libclrt. cffi reads clrt.h, so Python does not define the structs again."""

import contextlib
import functools
import os
import pathlib
import re
import weakref

import cffi
import numpy as np

_FOLDER = pathlib.Path(__file__).parent
_HEADERS = _FOLDER / "clrt.h", _FOLDER.parents[1] / "library" / "clrt.h"
_DECLARATIONS = re.sub(r'//.*|^#.*|^extern "C" {|^}$|CLRT_API ', "", next(
    header for header in _HEADERS if header.exists()).read_text(encoding="utf-8"), flags=re.M)
# The names of each function's parameters. cffi knows only their types.
_PARAMETERS = {name: re.findall(r"(\w+)(?:\[\d+\])?(?=[,)])", parameters)
               for name, parameters in re.findall(r"clrt_(\w+)(\([^;]+\));", _DECLARATIONS)}
_ADVICE = (
    "\nclrt needs an OpenCL driver and libOpenCL. PoCL runs on every CPU: apt install"
    " pocl-opencl-icd ocl-icd-libopencl1 (Debian), dnf install pocl 'libOpenCL.so.1()(64bit)'"
    " (Fedora), conda install pocl-cpu-minimal ocl-icd (conda-forge).")

NOTHING = 0xFFFFFFFF
_NUMBERS = {"double": "a number", "_Bool": "True or False",
            "uint32_t": f"an integer from 0 to {NOTHING}"}
ffi = cffi.FFI()
VECTOR, NUMBER, _POINTER = map(ffi.typeof, ("double[3]", "uint32_t", "void *"))
_user: list[int] = []  # the id of the first process that used a device, if any
_kept: weakref.WeakKeyDictionary = weakref.WeakKeyDictionary()


class Error(Exception):
    """A call of the library failed. The text contains the reason."""


class ArgumentError(Error, ValueError):
    """An argument is invalid."""


class SceneError(Error):
    """The scene cannot be read, stored or drawn."""


class DeviceError(Error, RuntimeError):
    """There is no device, the device failed, or memory ran out."""


class Stopped(Error):
    """The progress function stopped the call."""


_FAULTS = {1: Stopped, 2: ArgumentError, 3: SceneError, 4: DeviceError}


def _open():
    """Opens $CLRT_LIBRARY if it is set, else the wheel's library, else the system's library."""
    own = _FOLDER / "libclrt.so.0"
    try:
        # With this setting, PoCL compiles kernels in three quarters of the time. The program has
        # the same setting, so it can use the kernels that the library has cached.
        os.environ.setdefault("POCL_WORK_GROUP_SPECIALIZATION", "0")
        return ffi.dlopen(os.environ.get("CLRT_LIBRARY", str(own if own.exists() else own.name)))
    except OSError as error:
        text = str(error).partition(".  Additionally")[0]
        raise ImportError(text + _ADVICE if "OpenCL" in text else text) from None


ffi.cdef(_DECLARATIONS)
lib = _open()


def use_device():
    """Raises in forks of a process that has used a device, because drivers hang in such forks."""
    _user[:] = _user or [os.getpid()]
    if _user[0] != os.getpid():
        raise DeviceError("a fork of a process that has used a device cannot use one: fork earlier,"
                          " or start processes by multiprocessing's 'spawn'")


@functools.cache
def _types(name):
    """The types of a struct's members except `size`, or of a function's parameters."""
    if name in _PARAMETERS:
        # In clrt.h, parameters that point to doubles are vectors.
        kinds = ffi.typeof(getattr(lib, "clrt_" + name)).args
        kinds = (VECTOR if kind.cname == "double *" else kind for kind in kinds)
        return dict(zip(_PARAMETERS[name], kinds))
    return {member: field.type for member, field in ffi.typeof(name).fields if member != "size"}


def call(name, *arguments):
    """Calls clrt_NAME with a ClrtError as the last argument. Raises an Error if the call fails."""
    function, types, error = getattr(lib, "clrt_" + name), _types(name), ffi.new("ClrtError *")
    result = function(*map(c_value, arguments, types.values(), types), error)
    if not result:
        text = ffi.string(error.text).decode(errors="replace")
        raise _FAULTS[error.fault](text + _ADVICE if "no OpenCL" in text else text)
    return result


def struct(kind, **members):
    """Makes a struct of clrt.h, and keeps its arrays alive. None means the default."""
    types = _types(kind)
    if unknown := set(members) - set(types):
        raise TypeError(f"there is no setting {', '.join(map(repr, unknown))}")
    given = {name: c_value(value, types[name], name) for name, value in members.items()
             if value is not None}
    made = ffi.new(kind + " *", {"size": ffi.sizeof(kind), **given})
    _kept[made] = members, given
    return made


def c_value(value, kind, what):
    """The value as the C type `kind`. Raises if the type cannot hold it."""
    if kind.cname == "char *":
        if "\0" in instance(value, str, what):
            raise ArgumentError(f"{what} contains a null character: {value!r}")
        return ffi.new("char[]", os.fsencode(value))
    if kind.kind == "pointer":
        return ffi.cast(_POINTER, value.ctypes.data) if isinstance(value, np.ndarray) else value
    if kind.kind == "array":
        return tuple(threes(value, np.float64, what).tolist())
    if kind.kind == "enum":
        return _names(kind).index(*choices(_names(kind), [value], what))
    try:
        return ffi.new(kind.cname + "[1]", [value])[0]  # Also raises for None.
    except (OverflowError, TypeError):
        expected = _NUMBERS.get(kind.cname, "an integer")
        raise ArgumentError(f"{what} is {value!r}, not {expected}") from None


def value_of(value, kind):
    """Converts structs to dicts without size, arrays to str or tuples, and enumerations to str."""
    if kind.kind == "struct":
        return {name: value_of(getattr(value, name), field.type) for name, field in kind.fields[1:]}
    if kind.kind == "array":
        is_text = kind.item.cname == "char"
        return ffi.string(value).decode(errors="replace") if is_text else tuple(value)
    return _names(kind)[value] if kind.kind == "enum" else value


def _names(enumeration):
    """The constants of an enumeration of clrt.h as in clrt's options: "-x" is CLRT_UP_MINUS_X."""
    return [name.split("_", 2)[-1].lower().replace("minus_", "-")
            for _, name in sorted(enumeration.elements.items())]


def result_of(name, *arguments):
    """Calls clrt_NAME, and returns the number or struct that the call fills."""
    kind = ffi.typeof(getattr(lib, "clrt_" + name)).args[-2]
    made = struct(kind.item.cname) if kind.item.kind == "struct" else ffi.new(kind)
    call(name, *arguments, made)
    return value_of(made[0], kind.item)


def instance(value, kind, what):
    """Returns the value. Raises unless it is an instance of `kind`."""
    if not isinstance(value, kind):
        raise ArgumentError(f"{what} is of the type {type(value).__name__}, not {kind.__name__}")
    return value


def numbers(values, dtype, what, shape=None):
    """The values as an array. Copies only if necessary. Raises if uint32 cannot hold a value."""
    try:
        values = np.asarray(values)
        if np.iscomplexobj(values):
            raise TypeError("the numbers are complex")
        values = values if shape is None else np.broadcast_to(values, shape)
        if values.dtype == dtype:
            return values
        with np.errstate(invalid="ignore"):
            made = values.astype(dtype)
    except (OverflowError, TypeError, ValueError) as fault:
        raise ArgumentError(f"{what}: {fault}") from None
    if dtype == np.uint32 and (made != values).any():
        raise ArgumentError(f"a number of the {what} is not an integer from 0 to {NOTHING}")
    return made


def fractions(values):
    """The values as an array. uint8 and uint16 become numbers in [0, 1], as in picture files."""
    values = np.asarray(values)
    most = {"uint8": 255, "uint16": 65535}.get(values.dtype.name)
    return (values / most).astype(np.float32) if most else values


def threes(values, dtype, what, *axes):
    """The values as an array of the shape (*axes, 3). Copies only if necessary."""
    array = numbers(values, dtype, what)
    if array.shape == (0,) and len(axes) == 1:
        array = array.reshape(0, 3)
    if array.shape[len(axes):] != (3,):
        raise ArgumentError(f"{what}: the shape is {array.shape}, not ({', '.join((*axes, '3'))})")
    return array


def parts(values, what, *names):
    """The values as a tuple. Raises unless it has one element for each name."""
    made = tuple(values) if np.iterable(values) else ()
    if len(made) != len(names):
        raise ArgumentError(f"{what} is {values!r}, not ({', '.join(names)})")
    return made


def choices(names, given, what):
    """The given names without repetitions. A string is one name. Raises if one is unknown."""
    given = list(dict.fromkeys([given] if isinstance(given, str) else given))
    for name in given:
        if name not in names:
            raise ArgumentError(f"{what} is {name!r}, not one of {', '.join(names)}")
    return given


@contextlib.contextmanager
def progress_of(progress):
    """Yields a ClrtProgress that calls `progress` or, if it is True, shows a bar. None: NULL."""
    faults, advance = [], _bar() if progress is True else progress
    callback = advance and ffi.callback(
        "ClrtProgress", lambda _, *parts: not faults and not _is_false(advance(*parts)),
        error=False, onerror=lambda _, fault, __: faults.append(fault))
    try:
        yield callback or ffi.NULL
    finally:
        if faults:
            raise faults[0] from None


def _is_false(value):
    return isinstance(value, (bool, np.bool_)) and not value


def _bar():
    """A progress function that shows a bar by tqdm, or None if tqdm is missing."""
    with contextlib.suppress(ImportError):
        from tqdm.auto import tqdm
        bar = tqdm(unit="part")

        def advance(done, all_):
            bar.total, bar.n = all_, done
            bar.refresh()

        return advance
    return None
