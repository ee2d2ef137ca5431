#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# A separate reader of OpenEXR files: single part, scanlines, uncompressed or ZIP. Succeeds if the
# Python EXPRESSION is true. In it, `types` maps channels to "uint" or "float", and `c` maps
# channels to lists of values, the top row first. With ROW, the lists contain only the chunk of this
# row. Usage: read_exr.py FILE EXPRESSION [ROW]
import math
import struct
import sys
import zlib

TYPES = {0: ("uint", "I"), 2: ("float", "f")}
ROWS = {0: 1, 2: 1, 3: 16}  # rows of a chunk, by compression


def read_text(data, place):
    end = data.index(b"\0", place)
    return data[place:end].decode(), end + 1


def read_header(data):
    """Returns {name: bytes} of the attributes, and the position after the header."""
    assert struct.unpack_from("<II", data) == (20000630, 2), "single part, scanlines"
    attributes, place = {}, 8
    while data[place] != 0:
        name, place = read_text(data, place)
        _, place = read_text(data, place)
        (size,) = struct.unpack_from("<I", data, place)
        attributes[name] = data[place + 4 : place + 4 + size]
        place += 4 + size
    return attributes, place + 1


def read_channels(data):
    """Yields the name and type of each channel, in the order of the file."""
    place = 0
    while data[place] != 0:
        name, place = read_text(data, place)
        yield name, struct.unpack_from("<I", data, place)[0]
        place += 16


def unpack_chunk(packed, size):
    """Decompresses a ZIP chunk, then undoes the differences between bytes and the separation of
    even and odd bytes."""
    if len(packed) == size:
        return packed
    steps = bytearray(zlib.decompress(packed))
    for i in range(1, len(steps)):
        steps[i] = (steps[i - 1] + steps[i] - 128) & 255
    plain = bytearray(size)
    plain[0::2] = steps[: (size + 1) // 2]
    plain[1::2] = steps[(size + 1) // 2 :]
    return bytes(plain)


def read_exr(path, row=None):
    with open(path, "rb") as file:
        data = file.read()
    attributes, place = read_header(data)
    channels = list(read_channels(attributes["channels"]))
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, rows = right - left + 1, ROWS[attributes["compression"][0]]
    values = {name: [] for name, _ in channels}
    chunks = range((bottom - top + rows) // rows) if row is None else [row // rows]
    for chunk in chunks:
        (start,) = struct.unpack_from("<Q", data, place + 8 * chunk)
        first, size = struct.unpack_from("<iI", data, start)
        count = min(rows, bottom - first + 1)
        line = 4 * width * len(channels)
        plain = unpack_chunk(data[start + 8 : start + 8 + size], count * line)
        for i in range(count * len(channels)):
            name, kind = channels[i % len(channels)]
            values[name] += struct.unpack_from(f"<{width}{TYPES[kind][1]}", plain, 4 * width * i)
    return {name: TYPES[kind][0] for name, kind in channels}, values


def main():
    types, c = read_exr(sys.argv[1], int(sys.argv[3]) if len(sys.argv) > 3 else None)
    return not eval(sys.argv[2], {"types": types, "c": c, "inf": math.inf})


if __name__ == "__main__":
    sys.exit(main())
