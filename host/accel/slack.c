// SPDX-License-Identifier: MIT
// Adds the slack in fp64, where the sum is nearly exact. Rounds the sum outward to float.
#include "accel/slack.h"

#include <math.h>

static float largest_coordinate(const Box *box)
{
    float largest = 0;
    for (int axis = 0; axis < 3; axis++)
        largest = fmaxf(largest, fmaxf(fabsf(box->low[axis]), fabsf(box->high[axis])));
    return largest;
}

static float rounded_down(double value)
{
    const float nearest = (float)value;
    return (double)nearest <= value ? nearest : nextafterf(nearest, -INFINITY);
}

static float rounded_up(double value)
{
    return -rounded_down(-value);
}

Box slack_grow(const Box *box)
{
    const double slack = (double)BVH_SLACK * (double)largest_coordinate(box);
    Box grown;
    for (int axis = 0; axis < 3; axis++) {
        grown.low[axis] = rounded_down((double)box->low[axis] - slack);
        grown.high[axis] = rounded_up((double)box->high[axis] + slack);
    }
    return grown;
}
