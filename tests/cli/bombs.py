# SPDX-License-Identifier: MIT
# Makes small files with huge pictures or headers. All pixels are zero.
import json
import struct
import zlib


def _png_chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def png(width, height, texts=0):
    """Returns a PNG file with compressed texts of 900,000 bytes each."""
    packer = zlib.compressobj(9)
    row = bytes(3 * width + 1)
    pixels = b"".join(packer.compress(row) for _ in range(height)) + packer.flush()
    text = _png_chunk(b"zTXt", b"key\0\0" + zlib.compress(b"a" * 900000, 9))
    head = _png_chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + texts * text + _png_chunk(b"IDAT", pixels) + _png_chunk(b"IEND", b"")


def _attribute(name, kind, body):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<I", len(body)) + body


def _exr_head(width, height, pixel_type, flags, more):
    channels = b"".join(name + b"\0" + struct.pack("<I4xII", pixel_type, 1, 1) for name in (b"B", b"G", b"R"))
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    attributes = [
        ("channels", "chlist", channels + b"\0"), ("compression", "compression", b"\3"), ("dataWindow", "box2i", box),
        ("displayWindow", "box2i", box), ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", struct.pack("<f", 1)), ("screenWindowCenter", "v2f", bytes(8)),
        ("screenWindowWidth", "float", struct.pack("<f", 1)), *more,
    ]  # fmt: skip
    return struct.pack("<II", 20000630, 2 | flags) + b"".join(_attribute(*a) for a in attributes) + b"\0"


def exr(width, height):
    """Returns an EXR file with three channels of half floats, in ZIP blocks of 16 rows."""
    head = _exr_head(width, height, 1, 0, [])
    packed = zlib.compress(b"\0" + b"\x80" * (width * 16 * 6 - 1), 9)
    blocks = range(height // 16)
    starts = (len(head) + 8 * len(blocks) + i * (8 + len(packed)) for i in blocks)
    return head + b"".join(struct.pack("<Q", start) for start in starts) + b"".join(
        struct.pack("<iI", 16 * i, len(packed)) + packed for i in blocks)


def exr_part(settings, attributes=0):
    """Returns the EXR file of a part with these settings and without tiles. `attributes` is the
    number of further attributes, which clrt does not know."""
    (width, height), tile = (settings["width"], settings["height"]), settings["tile"]
    texts = {"clrt:version": "1", "clrt:complete": "yes", "clrt:settings": json.dumps(settings)}
    more = [(f"a{i}", "string", b"x") for i in range(attributes)]
    more += [(name, "string", text.encode()) for name, text in texts.items()]
    more.append(("tiles", "tiledesc", struct.pack("<IIB", *tile, 0)))
    return _exr_head(width, height, 2, 0x200, more) + bytes(8 * (-(-width // tile[0]) * -(-height // tile[1])))
