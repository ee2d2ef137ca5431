// SPDX-License-Identifier: MIT
// Winding numbers sum solid angles (Van Oosterom and Strackee, "The Solid Angle of a Plane
// Triangle", 1983). Blocks of points run through loops that the compiler can vectorize.
#include "library/winding.h"

#include "unit/cmocka_all.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BLOCK   256
#define NEAR    0x1p-21
#define NEAREST 0.01 // triangles with smaller solid angles are not near

typedef struct {
    double at[3][3];     // corners
    double inverse_area; // 1 / (2 * area)
} Facet;

// A block of points. Each point has a sum of solid angles and a number of near triangles.
typedef struct {
    double points[3][BLOCK], sums[BLOCK], nears[BLOCK];
} Block;

// Returns atan2(y, x) with an error of at most 1e-4. The polynomial is Abramowitz and Stegun's
// 4.4.47.
static inline double angle_of(double y, double x)
{
    const double a = fabs(x), b = fabs(y);
    const double larger = a > b ? a : b, smaller = a > b ? b : a;
    const double t = smaller / (larger + 1e-300), s = t * t;
    const double first =
        t * (0.9998660 + s * (-0.3302995 + s * (0.1801410 + s * (-0.0851330 + s * 0.0208351))));
    const double octant = a > b ? first : 1.5707963267948966 - first;
    const double half = x < 0 ? 3.141592653589793 - octant : octant;
    return y < 0 ? -half : half;
}

static void add_facet(Block *block, const Facet *facet)
{
    const double(*at)[3] = facet->at;
    for (int i = 0; i < BLOCK; i++) {
        const double x = block->points[0][i], y = block->points[1][i], z = block->points[2][i];
        const double ax = at[0][0] - x, ay = at[0][1] - y, az = at[0][2] - z;
        const double bx = at[1][0] - x, by = at[1][1] - y, bz = at[1][2] - z;
        const double cx = at[2][0] - x, cy = at[2][1] - y, cz = at[2][2] - z;
        const double a = sqrt(ax * ax + ay * ay + az * az);
        const double b = sqrt(bx * bx + by * by + bz * bz);
        const double c = sqrt(cx * cx + cy * cy + cz * cz);
        const double volume =
            ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
        const double rest = a * b * c + (ax * bx + ay * by + az * bz) * c +
                            (bx * cx + by * cy + bz * cz) * a + (cx * ax + cy * ay + cz * az) * b;
        const double angle = angle_of(volume, rest);
        const bool is_beside = (fabs(angle) > NEAREST) | (rest < 1e-9 * a * b * c); // on an edge
        const bool is_near = (fabs(volume) * facet->inverse_area < NEAR) & is_beside;
        block->sums[i] += angle;
        block->nears[i] += is_near ? 1 : 0;
    }
}

static Facet *facets_of(const ClosedMesh *mesh)
{
    Facet *facets = calloc(mesh->face_count, sizeof *facets);
    assert_non_null(facets);
    for (size_t face = 0; face < mesh->face_count; face++) {
        Facet *facet = &facets[face];
        double ab[3], ac[3];
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                facet->at[corner][axis] =
                    (double)mesh->vertices[mesh->faces[face][corner]][axis] / GRID;
        for (int axis = 0; axis < 3; axis++) {
            ab[axis] = facet->at[1][axis] - facet->at[0][axis];
            ac[axis] = facet->at[2][axis] - facet->at[0][axis];
        }
        const double x = ab[1] * ac[2] - ab[2] * ac[1], y = ab[2] * ac[0] - ab[0] * ac[2];
        const double z = ab[0] * ac[1] - ab[1] * ac[0];
        facet->inverse_area = 1 / sqrt(x * x + y * y + z * z);
    }
    return facets;
}

static PointPlace place_of(const Block *block, int i)
{
    const double winding = block->sums[i] / 6.283185307179586;
    if (block->nears[i] > 0)
        return POINT_ON_SURFACE;
    assert_true(fabs(winding - rint(winding)) < 0.1);
    return lrint(winding) % 2 != 0 ? POINT_INSIDE : POINT_OUTSIDE;
}

void winding_places(const ClosedMesh *mesh, const double (*points)[3], size_t count,
                    uint8_t *places)
{
    Facet *facets = facets_of(mesh);
    static Block block;
    for (size_t first = 0; first < count; first += BLOCK) {
        const size_t size = count - first < BLOCK ? count - first : BLOCK;
        memset(&block, 0, sizeof block);
        for (size_t i = 0; i < size; i++)
            for (int axis = 0; axis < 3; axis++)
                block.points[axis][i] = points[first + i][axis];
        for (size_t face = 0; face < mesh->face_count; face++)
            add_facet(&block, &facets[face]);
        for (size_t i = 0; i < size; i++)
            places[first + i] = (uint8_t)place_of(&block, (int)i);
    }
    free(facets);
}

// The most directions that are tried until a ray touches no outline.
#define TRIALS 8

__extension__ typedef __int128 Integer;

static Integer determinant(const Integer a[3], const Integer b[3], const Integer c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

static int sign(Integer a)
{
    return a > 0 ? 1 : a < 0 ? -1 : 0;
}

typedef enum { PASSES, CROSSES, TOUCHES, CONTAINS_POINT } Crossing;

// Returns how a ray from the origin meets a triangle. TOUCHES: the ray's line meets the outline or
// lies in the triangle's plane.
static Crossing cross(const Integer at[3][3], const Integer direction[3])
{
    const int sides[3] = {sign(determinant(direction, at[1], at[2])),
                          sign(determinant(direction, at[2], at[0])),
                          sign(determinant(direction, at[0], at[1]))};
    const int volume = sign(determinant(at[0], at[1], at[2]));
    bool front = false, back = false;
    for (int i = 0; i < 3; i++) {
        front = front || sides[i] > 0;
        back = back || sides[i] < 0;
    }
    if (front && back)
        return PASSES;
    if (sides[0] == 0 || sides[1] == 0 || sides[2] == 0)
        return TOUCHES;
    if (volume == 0)
        return CONTAINS_POINT;
    return (volume > 0) == front ? CROSSES : PASSES;
}

PointPlace exact_place(const ClosedMesh *mesh, const int32_t point[3])
{
    Integer direction[3] = {7919, 10007, 15485863};
    for (int trial = 0; trial < TRIALS; trial++) {
        bool inside = false, touches = false;
        for (size_t face = 0; face < mesh->face_count; face++) {
            Integer at[3][3];
            for (int corner = 0; corner < 3; corner++)
                for (int axis = 0; axis < 3; axis++)
                    at[corner][axis] =
                        mesh->vertices[mesh->faces[face][corner]][axis] - point[axis];
            const Crossing crossing = cross((const Integer(*)[3])at, direction);
            if (crossing == CONTAINS_POINT)
                return POINT_ON_SURFACE;
            touches = touches || crossing == TOUCHES;
            inside ^= crossing == CROSSES;
        }
        if (!touches)
            return inside ? POINT_INSIDE : POINT_OUTSIDE;
        direction[0] += 1009;
        direction[1] -= 2003;
    }
    return POINT_ON_SURFACE; // at an edge or vertex, which every ray touches
}
