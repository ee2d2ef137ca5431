# SPDX-License-Identifier: MIT
# Encodes meshes of Python numbers in several formats. Each format has a function that returns the
# content of a file.
import io
import json
import math
import struct
import zipfile


def rounded(value):
    """Returns the float that is nearest to the value."""
    return struct.unpack("<f", struct.pack("<f", value))[0]


def knot(rings=24, sides=10):
    """Returns points and triangles of a closed tube around a trefoil. Most coordinates need many
    decimals."""
    points, triangles = [], []
    for ring in range(rings):
        turn = 2 * math.pi * ring / rings
        wide = 2 + math.cos(3 * turn)
        for side in range(sides):
            around = 2 * math.pi * side / sides
            far = wide + 0.4 * math.cos(around)
            point = far * math.cos(2 * turn), far * math.sin(2 * turn), math.sin(3 * turn) + 0.4 * math.sin(around)
            points.append(tuple(rounded(value) for value in point))
    for ring in range(rings):
        for side in range(sides):
            a, b = ring * sides + side, ring * sides + (side + 1) % sides
            c, d = (a + sides) % len(points), (b + sides) % len(points)
            triangles += [(a, c, b), (b, c, d)]
    return points, triangles


def coarse(points):
    """Returns the points rounded to multiples of 1/64, which every decimal notation preserves."""
    return [tuple(round(value * 64) / 64 for value in point) for point in points]


def normals_of(points):
    """Returns the direction from the origin to each point, in floats."""
    directions = []
    for x, y, z in points:
        length = math.sqrt(x * x + y * y + z * z) or 1
        directions.append((rounded(x / length), rounded(y / length), rounded(z / length)))
    return directions


def axes_of(points):
    """Returns the direction of the nearest axis for each point. Every notation and normalization
    preserves these directions."""
    nearest = [max(range(3), key=lambda axis: abs(point[axis])) for point in points]
    return [
        tuple(math.copysign(1.0, point[axis]) if axis == near else 0.0 for axis in range(3))
        for point, near in zip(points, nearest)
    ]


def ply(points, triangles, normals=None, colors=None):
    rows = [p + n for p, n in zip(points, normals)] if normals else points
    names = ["x", "y", "z"] + (["nx", "ny", "nz"] if normals else [])
    if colors:
        rows = [row + color for row, color in zip(rows, colors)]
        names += ["red", "green", "blue"]
    header = (
        "ply\nformat binary_little_endian 1.0\n"
        + f"element vertex {len(rows)}\n"
        + "".join(f"property float {name}\n" for name in names)
        + f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    body = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)
    return header.encode() + body + b"".join(struct.pack("<B3i", 3, *t) for t in triangles)


def collada(points, triangles, up):
    """Returns a Collada file whose axis `up`, a letter, points up."""
    numbers = " ".join(repr(value) for point in points for value in point)
    corners = " ".join(str(corner) for triangle in triangles for corner in triangle)
    accessor = "".join(f'<param name="{name}" type="float"/>' for name in "XYZ")
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><up_axis>{up.upper()}_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh>
<source id="p"><float_array id="f" count="{3 * len(points)}">{numbers}</float_array><technique_common>
<accessor source="#f" count="{len(points)}" stride="3">{accessor}</accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="{len(triangles)}"><input semantic="VERTEX" source="#v" offset="0"/><p>{corners}</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene>
</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene>
</COLLADA>
"""


def obj(points, triangles, head="", groups=None):
    """Returns an OBJ file. The last three numbers of a point may be its color. `groups` contains
    pairs of a line and the index of the triangle that follows the line."""
    lines = [head] + ["v " + " ".join(map(repr, point)) for point in points]
    starts = {first: line for line, first in groups or []}
    for number, triangle in enumerate(triangles):
        if number in starts:
            lines.append(starts[number])
        lines.append("f " + " ".join(str(corner + 1) for corner in triangle))
    return ("\n".join(lines) + "\n").encode()


def stl(points, triangles):
    """Returns a binary STL file with wrong normals, as many programs write them."""
    facets = b"".join(struct.pack("<12fH", 0, 0, 1, *points[a], *points[b], *points[c], 0) for a, b, c in triangles)
    return b"\0" * 80 + struct.pack("<I", len(triangles)) + facets


def off(points, triangles):
    lines = ["OFF", f"{len(points)} {len(triangles)} 0"]
    lines += [f"{x!r} {y!r} {z!r}" for x, y, z in points]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    return ("\n".join(lines) + "\n").encode()


def _low_high(points):
    columns = list(zip(*points))
    return [min(c) for c in columns], [max(c) for c in columns]


def glb(points, triangles, normals=None, node=None, change=None):
    """Returns a GLB file. `node` contains further properties of the mesh's node. `change` modifies
    the document before it is packed."""
    parts = [b"".join(struct.pack("<3I", *t) for t in triangles)]
    parts += [b"".join(struct.pack("<3f", *p) for p in v) for v in (points, normals) if v]
    low, high = _low_high(points)
    accessors = [{"bufferView": 0, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"},
                 {"bufferView": 1, "componentType": 5126, "count": len(points), "type": "VEC3",
                  "min": low, "max": high}]
    attributes = {"POSITION": 1}
    if normals:
        accessors.append({"bufferView": 2, "componentType": 5126, "count": len(normals), "type": "VEC3"})
        attributes["NORMAL"] = 2
    views, place = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": place, "byteLength": len(part)})
        place += len(part)
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, **(node or {})}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 0}]}],
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": place}],
    }
    if change:
        change(document)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = b"".join(parts)
    total = 12 + 8 + len(text) + 8 + len(body)
    head = struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON")
    return head + text + struct.pack("<I4s", len(body), b"BIN\0") + body


# %d is the vertex index of the triangle's last corner.
THREE_MF_TRIANGLE = """<model unit="millimeter"><resources><object id="1" type="model"><mesh>
<vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/>
</vertices><triangles><triangle v1="0" v2="1" v3="%d"/></triangles></mesh></object></resources>
<build><item objectid="1"/></build></model>"""


def three_mf(model, is_found=True):
    """Returns a 3MF file with the XML `model`. If is_found is false, no relation names the model."""
    relation = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
    target = f'<Relationship Target="/3D/3DModel.model" Id="rel0" Type="{relation}"/>'
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("_rels/.rels", f"<Relationships>{target}</Relationships>" if is_found else "")
        archive.writestr("3D/3DModel.model", model)
    return file.getvalue()
