# SPDX-License-Identifier: MIT
"""Writes a closed, bumpy torus with about the requested number of triangles. A torus has no poles,
so triangles resemble their neighbors in meshes of every size."""

import array
import math
import struct

RING, TUBE, HEIGHT = 0.45, 0.2, 0.35
BUMPS = [(3, 0.10), (7, 0.05), (19, 0.015)]  # periods around the torus, and depth

HEADER = b"""ply
format binary_little_endian 1.0
element vertex %d
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face %d
property list uchar int vertex_indices
end_header
"""


def waves(angle):
    """Returns (height, slope) of each kind of bump at an angle."""
    return [(math.sin(n * angle + n), n * math.cos(n * angle + n)) for n, _ in BUMPS]


def vertex(u, v, over, along):
    """Returns position and normal. u and v are (cosine, sine) of the two angles; over and along are
    their waves."""
    radius, by_u, by_v = TUBE, 0.0, 0.0
    for (_, depth), (a, slope_a), (b, slope_b) in zip(BUMPS, over, along):
        radius += TUBE * depth * a * b
        by_u += TUBE * depth * slope_a * b
        by_v += TUBE * depth * a * slope_b
    cosine, sine = v
    out = RING + radius * cosine
    outward, upward = by_v * cosine - radius * sine, by_v * sine + radius * cosine
    # The components are across the ring, along the ring, and up.
    normal = (out * upward, by_u * (sine * outward - cosine * upward), -out * outward)
    return (out * u[0], out * u[1], HEIGHT + radius * sine,
            normal[0] * u[0] - normal[1] * u[1], normal[0] * u[1] + normal[1] * u[0], normal[2])


def write(path, wanted):
    """Writes about `wanted` triangles, and returns their number."""
    across = max(3, round(math.sqrt(wanted / 4)))
    around = 2 * across
    angles = [math.tau * j / across for j in range(across)]
    tube = [((math.cos(v), math.sin(v)), waves(v)) for v in angles]
    with open(path, "wb") as file:
        file.write(HEADER % (around * across, 2 * around * across))
        for i in range(around):
            angle = math.tau * i / around
            u, over = (math.cos(angle), math.sin(angle)), waves(angle)
            row = array.array("f")
            for v, along in tube:
                row.extend(vertex(u, v, over, along))
            file.write(row.tobytes())
        quads = struct.Struct("<" + "B3iB3i" * across)
        for i in range(around):
            here, there = i * across, (i + 1) % around * across
            row = []
            for j in range(across):
                k = (j + 1) % across
                row += (3, here + j, there + j, there + k, 3, here + j, there + k, here + k)
            file.write(quads.pack(*row))
    return 2 * around * across
