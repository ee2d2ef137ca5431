#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads a PNG file with its own decoder and compares it with the PFM file of the same picture. On a
fault, prints it and exits with status 1. Usage: check_png.py PICTURE.png PICTURE.pfm [raw|srgb]"""

import struct
import sys
import zlib

TEXTS = ["Software", "clrt:version", "clrt:scene_hash", "clrt:mesh_hash", "clrt:settings",
         "clrt:device", "clrt:driver", "clrt:pixel_hash", "clrt:complete"]


def read_chunks(data):
    """Returns type and content of each chunk. Checks the CRCs."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "the signature is wrong"
    chunks, place = [], 8
    while place < len(data):
        size, kind = struct.unpack_from(">I4s", data, place)
        body = data[place + 8 : place + 8 + size]
        (total,) = struct.unpack_from(">I", data, place + 8 + size)
        assert total == zlib.crc32(kind + body), f"the sum of {kind} is wrong"
        chunks.append((kind, body))
        place += size + 12
    return chunks


def predict(kind, left, above, corner):
    if kind == 4:
        costs = [abs(above - corner), abs(left - corner), abs(left + above - 2 * corner)]
        return [left, above, corner][costs.index(min(costs))]
    return [0, left, above, (left + above) // 2][kind]


def unfilter(data, width, height):
    """Returns the rows' bytes after undoing their filters."""
    size = 3 * width
    assert len(data) == height * (size + 1), "the number of bytes is wrong"
    above, rows = bytes(size), []
    for start in range(0, len(data), size + 1):
        row = bytearray(data[start + 1 : start + 1 + size])
        for i in range(size):
            left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            row[i] = (row[i] + predict(data[start], left, above[i], corner)) % 256
        rows.append(bytes(row))
        above = row
    return rows


def read_png(path):
    with open(path, "rb") as file:
        chunks = read_chunks(file.read())
    kinds = [kind for kind, _ in chunks]
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND", "the order of chunks is wrong"
    width, height, *form = struct.unpack(">IIBBBBB", chunks[0][1])
    assert form == [8, 2, 0, 0, 0], f"not 8-bit RGB: {form}"
    texts = dict(body.split(b"\0") for kind, body in chunks if kind == b"tEXt")
    assert [name.decode() for name in texts] == TEXTS, f"the texts are {list(texts)}"
    assert all(texts.values()), "a text is empty"
    stream = b"".join(body for kind, body in chunks if kind == b"IDAT")
    return width, height, unfilter(zlib.decompress(stream), width, height)


def shown(value, encoding):
    if encoding == "srgb":
        value = 12.92 * value if value <= 0.0031308 else 1.055 * value ** (1 / 2.4) - 0.055
    return int(value * 255 + 0.5)


def read_pfm(path, encoding):
    """Returns the PFM file's rows as the PNG file should contain them."""
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n", "not a PFM"
        width, height = map(int, file.readline().split())
        file.readline()
        rows = [struct.unpack(f"<{3 * width}f", file.read(12 * width)) for _ in range(height)]
    return width, height, [bytes(shown(value, encoding) for value in row) for row in rows[::-1]]


def main():
    picture, reference, *encoding = sys.argv[1:]
    found, wanted = read_png(picture), read_pfm(reference, *encoding or ["raw"])
    assert found[:2] == wanted[:2], f"the size is {found[:2]}"
    for number, (row, right) in enumerate(zip(found[2], wanted[2])):
        assert row == right, f"row {number} is wrong"


try:
    main()
except (AssertionError, OSError, ValueError, struct.error, zlib.error) as fault:
    sys.exit(f"{sys.argv[1]}: {fault}")
