# SPDX-License-Identifier: MIT
# Reads PNG, PFM and OpenEXR files without code of clrt, libpng or OpenEXR. The top row comes first.
# In PNG and PFM, a row is a flat list of red, green and blue values.
import struct
import zlib

TYPES = {0: ("uint", "I"), 2: ("float", "f")}


def read_pfm(path):
    """Returns rows of floats."""
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n", "not a PFM"
        width, height = map(int, file.readline().split())
        assert file.readline() == b"-1.0\n"
        rows = [list(struct.unpack(f"<{3 * width}f", file.read(12 * width))) for _ in range(height)]
    return rows[::-1]


def pfm(*rows):
    """Returns the bytes of a PFM file. The first argument is the top row."""
    content = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows[::-1])
    return b"PF\n%d %d\n-1.0\n" % (len(rows[0]) // 3, len(rows)) + content


def read_png_chunks(data):
    """Verifies the checksums, and returns the type and bytes of each chunk."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "the signature is wrong"
    chunks, place = [], 8
    while place < len(data):
        size, kind = struct.unpack_from(">I4s", data, place)
        body = data[place + 8 : place + 8 + size]
        (total,) = struct.unpack_from(">I", data, place + 8 + size)
        assert total == zlib.crc32(kind + body), f"the checksum of {kind} is wrong"
        chunks.append((kind, body))
        place += size + 12
    assert chunks[0][0] == b"IHDR" and chunks[-1][0] == b"IEND", "the order of chunks is wrong"
    return chunks


def read_png_texts(data):
    texts = (body.decode().split("\0") for kind, body in read_png_chunks(data) if kind == b"tEXt")
    return {name: value for name, value in texts}


def predict(kind, left, above, corner):
    if kind == 4:
        costs = [abs(above - corner), abs(left - corner), abs(left + above - 2 * corner)]
        return [left, above, corner][costs.index(min(costs))]
    return [0, left, above, (left + above) // 2][kind]


def read_png(data):
    """Undoes the filters, and returns rows of bytes."""
    chunks = read_png_chunks(data)
    width, height, *form = struct.unpack(">IIBBBBB", chunks[0][1])
    assert form == [8, 2, 0, 0, 0], f"not 8-bit RGB: {form}"
    filtered = zlib.decompress(b"".join(body for kind, body in chunks if kind == b"IDAT"))
    size = 3 * width
    assert len(filtered) == height * (size + 1), "the number of bytes is wrong"
    above, rows = [0] * size, []
    for start in range(0, len(filtered), size + 1):
        row = list(filtered[start + 1 : start + 1 + size])
        for i in range(size):
            left, corner = (row[i - 3], above[i - 3]) if i >= 3 else (0, 0)
            row[i] = (row[i] + predict(filtered[start], left, above[i], corner)) % 256
        rows.append(row)
        above = row
    return rows


def read_text(data, place):
    end = data.index(b"\0", place)
    return data[place:end].decode(), end + 1


def read_header(data):
    """Returns the attributes' bytes by name, and the offset of the header's end."""
    assert struct.unpack_from("<II", data) == (20000630, 0x202), "single part, tiles"
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
    """Undoes EXR's ZIP compression: inflates, adds up the differences, and interleaves the two halves."""
    if len(packed) == size:
        return packed
    steps = bytearray(zlib.decompress(packed))
    for i in range(1, len(steps)):
        steps[i] = (steps[i - 1] + steps[i] - 128) & 255
    plain = bytearray(size)
    plain[0::2] = steps[: (size + 1) // 2]
    plain[1::2] = steps[(size + 1) // 2 :]
    return bytes(plain)


def read_exr_tiles(data):
    """Yields the column, row and packed bytes of each tile that the file contains."""
    attributes, place = read_header(data)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = struct.unpack_from("<2I", attributes["tiles"])
    for number in range(((right - left) // width + 1) * ((bottom - top) // height + 1)):
        (start,) = struct.unpack_from("<Q", data, place + 8 * number)
        if start > 0:
            column, row, *level, size = struct.unpack_from("<5I", data, start)
            assert level == [0, 0]
            yield column, row, data[start + 20 : start + 20 + size]


def read_exr(path, row=None):
    """Returns the types and values of the channels. Pixels of missing tiles are 0. If `row` is given,
    the values begin at the top of this row's tiles and end with this row."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, _ = read_header(data)
    channels = list(read_channels(attributes["channels"]))
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    tile_width, tile_height = struct.unpack_from("<2I", attributes["tiles"])
    assert attributes["compression"] == b"\3", "ZIP"
    first, end = (0, height) if row is None else (row // tile_height * tile_height, row + 1)
    values = {name: [0] * (width * (end - first)) for name, _ in channels}
    for column, line, packed in read_exr_tiles(data):
        x, y = column * tile_width, line * tile_height
        if y < first or y >= end:
            continue
        across, down = min(tile_width, width - x), min(tile_height, height - y)
        plain = unpack_chunk(packed, 4 * across * down * len(channels))
        for i in range(min(down, end - y) * len(channels)):
            name, kind = channels[i % len(channels)]
            start = (y - first + i // len(channels)) * width + x
            values[name][start : start + across] = struct.unpack_from(
                f"<{across}{TYPES[kind][1]}", plain, 4 * across * i)
    return {name: TYPES[kind][0] for name, kind in channels}, values
