# SPDX-License-Identifier: MIT
"""Meshes as the benchmark needs them: reads the PLY that clrt's own scenes and the course's use
(float vertices with or without normals, triangles), and writes the same."""

import array
import struct
import sys


def read_header(file):
    """Whether the file is binary, and each element's count and lines."""
    elements, binary = {}, False
    name = None
    while (line := file.readline().decode("ascii").split()) != ["end_header"]:
        if line[:1] == ["format"]:
            binary = line[1] == "binary_little_endian"
        elif line[:1] == ["element"]:
            name = line[1]
            elements[name] = (int(line[2]), [])
        elif line[:1] == ["property"]:
            elements[name][1].append(line[1:])
    return binary, elements


def read(path):
    """Positions and normals, three numbers each (no normals: empty), and corners, three each."""
    with open(path, "rb") as file:
        binary, elements = read_header(file)
        count, properties = elements["vertex"]
        names = [words[-1] for words in properties]
        faces = elements["face"][0]
        if binary:
            values = array.array("f")
            values.fromfile(file, count * len(names))
            packed = struct.Struct("<B3i")
            corners = [face[1:] for face in packed.iter_unpack(file.read(faces * packed.size))]
        else:
            lines = file.read().decode("ascii").split()
            values = list(map(float, lines[:count * len(names)]))
            rest = list(map(int, lines[count * len(names):][:4 * faces]))
            corners = list(zip(rest[1::4], rest[2::4], rest[3::4]))
    columns = {name: values[place::len(names)] for place, name in enumerate(names)}
    positions = list(zip(columns["x"], columns["y"], columns["z"]))
    normals = list(zip(columns["nx"], columns["ny"], columns["nz"])) if "nx" in columns else []
    return positions, normals, corners


def write(path, positions, corners):
    """Writes flat arrays: three floats a vertex, three indices a triangle."""
    assert sys.byteorder == "little"
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\n"
                   b"element vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                   b"element face %d\nproperty list uchar int vertex_indices\nend_header\n"
                   % (len(positions) // 3, len(corners) // 3))
        array.array("f", positions).tofile(file)
        face = struct.Struct("<B3i")
        file.write(b"".join(face.pack(3, *corners[i:i + 3]) for i in range(0, len(corners), 3)))
