// SPDX-License-Identifier: MIT
// The figure: a round, laughing monk on a lotus, with about 122 thousand triangles. It looks
// along +x and sits on z = 0.
#include "figure.h"
#include "model.h"
#include "shape.h"

static double figure_field(Vec3 p)
{
    const double torso = torso_field(p);
    double field = shape_join(torso, robe_field(p, torso), 0.022);
    field = shape_join(field, beads_field(p, torso), 0.006);
    field = shape_join(field, limbs_field(p), 0.012);
    field = shape_join(
        field, 1.06 * head_field(vec3_scale(vec3_sub(p, vec3(0.035, 0, 0.835)), 1 / 1.06)), 0.025);
    return shape_join(field, lotus_field(p), 0.02);
}

const Model model_figure = {
    .name = "figure",
    .field = figure_field,
    .low = {-0.55, -0.55, -0.05},
    .high = {0.55, 0.55, 1.7},
    .cell = 0.0115,
    .taper = 0.44,
};
