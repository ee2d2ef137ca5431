// SPDX-License-Identifier: MIT
// Vectors of three Reals, and differences of products with exact signs. triangle.inc.cl includes
// this file, and lists the types that must be defined.

typedef struct {
    Real x, y, z;
} Real3;

// Returns a * b - c * d by Kahan's algorithm. Unless products underflow, the error is at most 1.5
// ulp, so the sign is exact (Jeannerod, Louvet and Muller, "Further analysis of Kahan's algorithm
// for the accurate computation of 2x2 determinants", 2013).
static inline Real OVERLOAD difference_of_products(Real a, Real b, Real c, Real d)
{
    const Real cd = c * d;
    const Real error = fma(-c, d, cd);
    return fma(a, b, -cd) + error;
}

static inline Real3 OVERLOAD difference(Real3 a, Real3 b)
{
    return (Real3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline Real3 OVERLOAD cross_product(Real3 a, Real3 b)
{
    return (Real3){difference_of_products(a.y, b.z, a.z, b.y),
                   difference_of_products(a.z, b.x, a.x, b.z),
                   difference_of_products(a.x, b.y, a.y, b.x)};
}

static inline Real OVERLOAD dot_product(Real3 a, Real3 b)
{
    return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x));
}

static inline Real3 OVERLOAD magnitudes(Real3 v)
{
    return (Real3){fabs(v.x), fabs(v.y), fabs(v.z)};
}

static inline Real OVERLOAD largest_component(Real3 v)
{
    return max(max(fabs(v.x), fabs(v.y)), fabs(v.z));
}

// Returns the distance at which a ray enters a box, given the distances at which it enters the
// three slabs. A ray that starts inside enters at 0.
static inline Real OVERLOAD entry_distance(Real3 near)
{
    return max(max(near.x, near.y), max(near.z, (Real)(0.0f)));
}

// Returns the distance at which a ray leaves a box, or `reach` if it leaves later.
static inline Real OVERLOAD leaving_distance(Real3 far, Real reach)
{
    return min(min(far.x, far.y), min(far.z, reach));
}

// Returns the component on an axis. Each lane has its own axis.
static inline Real OVERLOAD component(Real3 v, UInt axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
