# SPDX-License-Identifier: MIT
"""Reads the PLY files of clrt's scenes and of the course (docs/scenes.md): float vertices with or
without normals, and triangles, little-endian or as text."""

import array
import struct


def read_header(file):
    """Returns whether the file is binary, and {element: (count, property lines)}."""
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
    """Returns lists of positions, normals and triangles' corners, three numbers each. The list of
    normals is empty if the file has none."""
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
