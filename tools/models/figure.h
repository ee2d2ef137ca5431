// SPDX-License-Identifier: MIT
// The parts of the figure, as fields in its own coordinates unless said otherwise; figure.c puts
// them together.  The figure looks along +x; its left is +y.
#pragma once

#include "base/vec.h"

// A laughing head, centered at the origin and looking along +x; about 0.25 high.
double head_field(Vec3 p);

// The bare torso with its neck.
double torso_field(Vec3 p);

// The right hand on its knee and the left one with its palm up, to hold a ball of radius 0.048 at
// 0.262 0.235 0.462; the foot that looks out of the robe.
double limbs_field(Vec3 p);

// The robe over shoulders, arms and crossed legs, open in front; torso is torso_field at p.
double robe_field(Vec3 p, double torso);

// Beads on a string round the neck; torso is torso_field at p.
double beads_field(Vec3 p, double torso);

// A lotus seat about the z axis, 0.2 high.
double lotus_field(Vec3 p);
