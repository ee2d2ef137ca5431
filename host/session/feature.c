// SPDX-License-Identifier: MIT
// The samples of a pixel count as a square lattice. A disk at a random place contains a point of
// the lattice if the disk's center lies within a disk of the same size around the point. The
// probability that the disk contains a point is therefore the fraction of a lattice cell that a
// disk around the cell's point covers. Bisection finds the diameter at which the mean of this
// probability over all pixels is PROBABILITY.
#include "session/feature.h"

#include <math.h>

#define PROBABILITY 0.95

// After this many steps, the interval of diameters is smaller than the spacing of floats near 1.
#define BISECTIONS 32

// A disk of this diameter always contains a point of a lattice with spacing 1.
#define LARGEST 1.41421357

// Returns the fraction of a unit square that a disk around the square's center covers.
static double covered_area(double diameter)
{
    const double pi = 3.14159265358979, radius = diameter / 2;
    if (diameter >= LARGEST)
        return 1;
    if (diameter <= 1)
        return pi * radius * radius;
    const double segment =
        radius * radius * acos(0.5 / radius) - 0.5 * sqrt(radius * radius - 0.25);
    return pi * radius * radius - 4 * segment;
}

double feature_smallest(const SampleShare *shares, size_t count)
{
    double least = 0, most = LARGEST;
    for (int i = 0; i < BISECTIONS; i++) {
        const double diameter = (least + most) / 2;
        double pixels = 0, found = 0;
        for (size_t share = 0; share < count; share++) {
            const double own = (double)shares[share].pixels;
            pixels += own;
            found += own * covered_area(diameter * sqrt(shares[share].samples));
        }
        *(found < PROBABILITY * pixels ? &least : &most) = diameter;
    }
    return most;
}
