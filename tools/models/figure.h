// SPDX-License-Identifier: MIT
// The parts of the figure as signed distance fields. p is in the figure's coordinates unless a
// comment says otherwise. The figure looks along +x; its left is +y. figure.c combines the parts.
#pragma once

#include "base/vec.h"

// A laughing head at the origin, about 0.25 high. It looks along +x.
double head_field(Vec3 p);

// The bare torso with its neck.
double torso_field(Vec3 p);

// Both hands, and the visible foot. The right hand lies on the knee. The left palm faces up and can
// hold a ball of radius 0.048 at (0.262, 0.235, 0.462).
double limbs_field(Vec3 p);

// The robe over shoulders, arms and crossed legs, open in front. torso must be torso_field(p).
double robe_field(Vec3 p, double torso);

// Beads on a string around the neck. torso must be torso_field(p).
double beads_field(Vec3 p, double torso);

// A lotus seat around the z axis, about 0.2 high.
double lotus_field(Vec3 p);
