// SPDX-License-Identifier: MIT
// A model's spheres, each as round as its pixels.
#pragma once

#include "view/draw/light.h"
#include "view/lens.h"
#include "view/model.h"

typedef struct {
    GLuint program, corners, spheres, array;
    ARRAY(float) numbers; // of all spheres, as OpenGL reads them
} SphereView;

bool sphere_view_open(SphereView *view, Error *error);
void sphere_view_close(SphereView *view);

// Makes room for the model's spheres.
bool sphere_view_load(SphereView *view, const Model *model, Error *error);

void sphere_view_draw(SphereView *view, const Model *model, const Lens *lens, const Tone *tone);
