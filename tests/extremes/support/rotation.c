// SPDX-License-Identifier: MIT
// The rotation that a random quaternion stands for (Shoemake, "Uniform random rotations", 1992).
#include "rotation.h"

void random_rotation(Random *random, Vec3 axes[3])
{
    double q[4], squared;
    do {
        squared = 0;
        for (int i = 0; i < 4; i++) {
            q[i] = random_between(random, -1, 1);
            squared += q[i] * q[i];
        }
    } while (squared > 1 || squared < 0.01);
    const double s = 2 / squared, w = q[0], x = q[1], y = q[2], z = q[3];
    axes[0] = vec3(1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y));
    axes[1] = vec3(s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x));
    axes[2] = vec3(s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y));
}

Vec3 rotated(const Vec3 axes[3], Vec3 coordinates)
{
    return vec3_add(
        vec3_scale(axes[0], coordinates.x),
        vec3_add(vec3_scale(axes[1], coordinates.y), vec3_scale(axes[2], coordinates.z)));
}
