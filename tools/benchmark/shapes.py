# SPDX-License-Identifier: MIT
"""Writes generated meshes with about the requested number of triangles. Each is a tube along a closed
curve, so it has no poles, and triangles resemble their neighbors in meshes of every size."""

import array
import math
import struct

RING, TUBE, HEIGHT = 0.45, 0.2, 0.35
BUMPS = [(3, 0.10), (7, 0.05), (19, 0.015)]  # of the torus: periods around it, and depth
COILS, COIL, WIRE = 9, 0.2, 0.05  # of the spring: windings, and radii of a winding and of the wire
TEETH, TOOTH = 24, 0.06  # of the gear: number and height

HEADER = """ply
format binary_little_endian 1.0
element vertex %d
%selement face %d
property list uchar int vertex_indices
end_header
"""


def waves(angle):
    """Returns (height, slope) of each kind of bump at an angle."""
    return [(math.sin(n * angle + n), n * math.cos(n * angle + n)) for n, _ in BUMPS]


def torus(along, across):
    """A smooth torus with bumps. Like each shape, returns a function of the indices of a vertex along
    and across the tube. The function returns the position and, unless the shape is flat, the
    normal."""
    over = [waves(math.tau * i / along) for i in range(along)]
    around = [waves(math.tau * j / across) for j in range(across)]

    def vertex(i, j):
        u, v = math.tau * i / along, math.tau * j / across
        radius, by_u, by_v = TUBE, 0.0, 0.0
        for (_, depth), (a, slope_a), (b, slope_b) in zip(BUMPS, over[i], around[j]):
            radius += TUBE * depth * a * b
            by_u += TUBE * depth * slope_a * b
            by_v += TUBE * depth * a * slope_b
        cosine, sine = math.cos(v), math.sin(v)
        out = RING + radius * cosine
        outward, upward = by_v * cosine - radius * sine, by_v * sine + radius * cosine
        # The components are across the ring, along the ring, and up.
        normal = (out * upward, by_u * (sine * outward - cosine * upward), -out * outward)
        return (*turned(u, out, 0, HEIGHT + radius * sine), *turned(u, *normal))
    return vertex


def spring(along, across):
    """A smooth wire that winds around a ring."""
    def vertex(i, j):
        u, v = math.tau * i / along, math.tau * j / across
        # The wire's direction has the component `ahead` along the ring and `beside` along the coil.
        ahead, beside = RING + COIL * math.cos(COILS * u), COILS * COIL
        length = math.hypot(ahead, beside)
        cosine, sine = math.cos(COILS * u), math.sin(COILS * u)
        outward, level = math.cos(v), math.sin(v)
        normal = (outward * cosine + level * ahead / length * sine, level * beside / length,
                  outward * sine - level * ahead / length * cosine)
        place = (RING + COIL * cosine + WIRE * normal[0], WIRE * normal[1],
                 HEIGHT + COIL * sine + WIRE * normal[2])
        return (*turned(u, *place), *turned(u, *normal))
    return vertex


def gear(along, across):
    """A ring with flat faces, steep teeth and a square profile."""
    def vertex(i, j):
        u, v = math.tau * i / along, math.tau * j / across
        cosine, sine = math.cos(v), math.sin(v)
        radius = TUBE / max(abs(cosine), abs(sine))
        tooth = TOOTH * math.tanh(8 * math.sin(TEETH * u)) if cosine > 0 else 0
        return turned(u, RING + radius * cosine + tooth, 0, HEIGHT + radius * sine)
    return vertex


def turned(angle, across, along, up):
    """Turns a vector with components across and along a ring."""
    c, s = math.cos(angle), math.sin(angle)
    return across * c - along * s, across * s + along * c, up


SHAPES = {"torus": (torus, 2), "spring": (spring, 16), "gear": (gear, 3)}


def write(path, name, wanted):
    """Writes a shape with about `wanted` triangles, and returns their number."""
    shape, ratio = SHAPES[name]
    across = max(3, round(math.sqrt(wanted / (2 * ratio))))
    along = ratio * across
    vertex = shape(along, across)
    names = ["x", "y", "z", "nx", "ny", "nz"][:len(vertex(0, 0))]
    with open(path, "wb") as file:
        words = "".join(f"property float {name}\n" for name in names)
        file.write((HEADER % (along * across, words, 2 * along * across)).encode())
        for i in range(along):
            row = array.array("f")
            for j in range(across):
                row.extend(vertex(i, j))
            file.write(row.tobytes())
        quads = struct.Struct("<" + "B3iB3i" * across)
        for i in range(along):
            here, there = i * across, (i + 1) % along * across
            row = []
            for j in range(across):
                k = (j + 1) % across
                row += (3, here + j, there + j, there + k, 3, here + j, there + k, here + k)
            file.write(quads.pack(*row))
    return 2 * along * across
