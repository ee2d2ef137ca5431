# SPDX-License-Identifier: MIT
# Readers of PNG, PFM and OpenEXR files that share no code with clrt or with the libraries it uses.
# Rows come top first, each a flat list of red, green and blue.
import struct
import zlib

TYPES = {0: ("uint", "I"), 2: ("float", "f")}
ROWS = {0: 1, 2: 1, 3: 16}  # of a chunk, by compression


def read_pfm(path):
    """Returns rows of floats."""
    with open(path, "rb") as file:
        assert file.readline() == b"PF\n", "not a PFM"
        width, height = map(int, file.readline().split())
        assert file.readline() == b"-1.0\n"
        rows = [list(struct.unpack(f"<{3 * width}f", file.read(12 * width))) for _ in range(height)]
    return rows[::-1]


def pfm(*rows):
    """Returns the bytes of a PFM file, whose first row is the top one."""
    content = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows[::-1])
    return b"PF\n%d %d\n-1.0\n" % (len(rows[0]) // 3, len(rows)) + content


def read_png_chunks(data):
    """Returns the type and bytes of each chunk, whose checksums must be right."""
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
    """Returns rows of bytes, regardless of their filters."""
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
    """Returns the attributes' bytes by name, and where the header ends."""
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
    """Undoes ZIP: bytes are halved into even and odd ones, each the difference to the last."""
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
