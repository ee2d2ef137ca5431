// SPDX-License-Identifier: MIT
// Finds names in a balanced tree of the C library.
#include "scene/material_names.h"

#include <search.h>
#include <stdlib.h>
#include <string.h>

static int compare(const void *first, const void *second)
{
    const MaterialName *a = first, *b = second;
    return strcmp(a->name, b->name);
}

bool material_names_add(MaterialNames *names, const MaterialName *name, Error *error)
{
    MaterialName *held = memory_raw(1, sizeof *held, error);
    if (held == NULL || !array_push(&names->list, held, error)) {
        free(held);
        return false;
    }
    *held = *name;
    return tsearch(held, &names->tree, compare) != NULL || error_out_of_memory(error, sizeof *held);
}

const MaterialName *material_names_find(const MaterialNames *names, const char *name, size_t length)
{
    MaterialName key = {0};
    if (length >= sizeof key.name)
        return NULL;
    memcpy(key.name, name, length);
    MaterialName *const *found = tfind(&key, &names->tree, compare);
    return found == NULL ? NULL : *found;
}

static void keep(void *name)
{
    (void)name; // list owns it
}

void material_names_free(MaterialNames *names)
{
    tdestroy(names->tree, keep);
    for (size_t i = 0; i < names->list.count; i++)
        free(names->list.data[i]);
    free(names->list.memory);
    *names = (MaterialNames){0};
}
