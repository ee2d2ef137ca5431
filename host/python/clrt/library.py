# SPDX-License-Identifier: MIT
"""Calls libclrt. cffi reads clrt.h, so every struct is defined once."""

import os
import pathlib
import re
import weakref

import cffi
import numpy as np

_FOLDER = pathlib.Path(__file__).parent

ffi = cffi.FFI()


class Error(Exception):
    """A call of the library failed. The text says why."""


class ArgumentError(Error, ValueError):
    """An argument is invalid."""


class SceneError(Error):
    """The scene cannot be read, stored or drawn."""


class DeviceError(Error, RuntimeError):
    """There is no device, or the device failed."""


class Stopped(Error):
    """The progress function stopped the call."""


_FAULTS = {1: Stopped, 2: ArgumentError, 3: SceneError, 4: DeviceError}
_ADVICE = (
    "\nclrt needs an OpenCL driver. PoCL runs on every CPU: apt install pocl-opencl-icd (Debian),"
    " dnf install pocl (Fedora), conda install pocl-cpu-minimal (conda-forge)."
)


def _header():
    """The text of clrt.h: in a wheel beside this file, in a checkout in host/library."""
    places = (_FOLDER / "clrt.h", _FOLDER.parents[1] / "library" / "clrt.h")
    return next(place for place in places if place.exists()).read_text()


def _declarations(header):
    """The header without comments, directives and export marks, which cffi does not read."""
    text = re.sub(r"//.*", "", header).replace('extern "C" {', "").replace("CLRT_API ", "")
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    return "\n".join(lines).rstrip().removesuffix("}")


def _open():
    """Opens $CLRT_LIBRARY, the wheel's library or the system's."""
    given = os.environ.get("CLRT_LIBRARY")
    own = _FOLDER / "libclrt.so.0"
    return ffi.dlopen(given or (str(own) if own.exists() else "libclrt.so.0"))


ffi.cdef(_declarations(_header()))
_library = _open()

NOTHING = 0xFFFFFFFF


def call(name, *arguments):
    """Calls clrt_NAME with a ClrtError at the end. Raises the library's error."""
    error = ffi.new("ClrtError *")
    result = getattr(_library, "clrt_" + name)(*arguments, error)
    if not result:
        text = ffi.string(error.text).decode(errors="replace")
        kind = _FAULTS[error.fault]
        raise kind(text + _ADVICE if "no OpenCL" in text else text)
    return result


def plain(name, *arguments):
    """Calls clrt_NAME, which cannot fail."""
    return getattr(_library, "clrt_" + name)(*arguments)


def handle(name, *arguments, free):
    """Calls clrt_NAME, which returns a handle, and frees the handle with its last reference."""
    return ffi.gc(call(name, *arguments), getattr(_library, f"clrt_{free}_free"))


_kept = weakref.WeakKeyDictionary()


def struct(kind, **members):
    """Makes a struct of clrt.h. Arrays in it live as long as the struct. None is the default."""
    given = {name: value for name, value in members.items() if value is not None}
    made = ffi.new(kind + " *", {"size": ffi.sizeof(kind)})
    kept = [setting for setting in (_set(made, *item) for item in given.items())]
    _kept[made] = kept
    return made


def _set(made, name, value):
    if isinstance(value, np.ndarray):
        value = ffi.from_buffer(value) if value.size else ffi.NULL
        kind = next(member.type for key, member in ffi.typeof(made[0]).fields if key == name)
        setattr(made, name, ffi.cast(kind, value))
    else:
        if isinstance(value, str):
            value = ffi.new("char[]", os.fsencode(value))
        setattr(made, name, value)
    return value


def values_of(given):
    """A struct as a dict without its size. Texts become str, arrays tuples."""
    names = [name for name, _ in ffi.typeof(given[0]).fields if name != "size"]
    return {name: _value_of(getattr(given, name)) for name in names}


def _value_of(value):
    if not isinstance(value, ffi.CData):
        return value
    if ffi.typeof(value).item.cname == "char":
        return ffi.string(value).decode(errors="replace")
    return tuple(value)


def rows(array, dtype, columns, what):
    """A contiguous array of `columns` values per row. Copies only if it must."""
    rows_ = np.ascontiguousarray(array, dtype)
    if rows_.ndim != 2 or rows_.shape[1] != columns:
        raise ArgumentError(f"{what} have the shape {rows_.shape}, not (n, {columns})")
    return rows_


def check_unsigned(numbers, what):
    """Raises unless the numbers are integers that uint32 can hold."""
    if numbers.size and (numbers.dtype.kind not in "iu" or numbers.min() < 0
                         or numbers.max() > NOTHING):
        raise ArgumentError(f"a {what} is not an integer from 0 to {NOTHING}")


def vector(values, what):
    """Three doubles for the library."""
    array = np.asarray(values, np.float64)
    if array.shape != (3,):
        raise ArgumentError(f"{what} is not three numbers")
    return ffi.new("double[3]", array.tolist())


def progress_of(progress):
    """A callback for the library from a function, from True (tqdm if installed) or from None."""

    def nothing():
        pass

    def ask(_, done, all_):
        return progress(done, all_) is not False

    if not progress:
        return None, nothing
    if progress is not True:
        return ffi.callback("ClrtProgress", ask), nothing
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return None, nothing
    bar = tqdm(unit="tile")

    def advance(_, done, all_):
        bar.total = all_
        bar.n = done
        bar.refresh()
        return True

    return ffi.callback("ClrtProgress", advance), bar.close
