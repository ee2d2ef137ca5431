// SPDX-License-Identifier: MIT
// The names of materials, in the order in which they were added, and a tree that finds them.
#pragma once

#include "base/array.h"

#include <stdint.h>

typedef struct {
    char name[64];
    uint32_t material; // index in Scene::materials
} MaterialName;

// {0} has no names.
typedef struct {
    ARRAY(MaterialName *) list; // owned
    void *tree;                 // by name; of tsearch
} MaterialNames;

// Appends a name. Returns false if memory runs out.
bool material_names_add(MaterialNames *names, const MaterialName *name, Error *error);

// Returns the first entry with this name, or NULL if there is none.
const MaterialName *material_names_find(const MaterialNames *names, const char *name,
                                        size_t length);

void material_names_free(MaterialNames *names);
