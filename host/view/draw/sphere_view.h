// SPDX-License-Identifier: MIT
// A model's spheres, exact in every pixel.
#pragma once

#include "view/draw/light.h"
#include "view/lens.h"
#include "view/model.h"

typedef struct {
    GLuint program, corners, spheres, array;
    ARRAY(float) numbers; // of all spheres, in OpenGL's layout
} SphereView;

bool sphere_view_open(SphereView *view, Error *error);
void sphere_view_close(SphereView *view);

// Allocates memory for the model's spheres.
bool sphere_view_load(SphereView *view, const Model *model, Error *error);

void sphere_view_draw(SphereView *view, const Model *model, const Lens *lens, const Tone *tone);
