// SPDX-License-Identifier: MIT
// Finds names by a hash table with linear probing. At most half of the slots are in use, so a
// search tests few slots.
#include "scene/material_names.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#define FIRST_SLOTS 64

// Returns the slot of the name, or the empty slot where the name belongs.
static uint32_t *find_slot(const MaterialNames *names, const char *name, size_t length)
{
    const size_t mask = names->slots.count - 1;
    for (size_t place = XXH3_64bits(name, length) & mask;; place = (place + 1) & mask) {
        uint32_t *slot = &names->slots.data[place];
        if (*slot == 0)
            return slot;
        const char *held = names->list.data[*slot - 1].name;
        if (strlen(held) == length && memcmp(held, name, length) == 0)
            return slot;
    }
}

// Stores the entry in the table, unless an earlier entry has the same name.
static void enter(MaterialNames *names, size_t index)
{
    const char *name = names->list.data[index].name;
    uint32_t *slot = find_slot(names, name, strlen(name));
    if (*slot == 0)
        *slot = (uint32_t)index + 1;
}

// Doubles the table and enters all names again.
static bool grow(MaterialNames *names, Error *error)
{
    const size_t count = names->slots.count == 0 ? FIRST_SLOTS : 2 * names->slots.count;
    uint32_t *slots = memory_zeroed(count, sizeof *slots, error);
    if (slots == NULL)
        return false;
    free(names->slots.memory);
    names->slots.data = slots;
    names->slots.count = names->slots.capacity = count;
    for (size_t index = 0; index < names->list.count; index++)
        enter(names, index);
    return true;
}

bool material_names_add(MaterialNames *names, const MaterialName *name, Error *error)
{
    if ((2 * (names->list.count + 1) > names->slots.count && !grow(names, error)) ||
        !array_push(&names->list, *name, error))
        return false;
    enter(names, names->list.count - 1);
    return true;
}

const MaterialName *material_names_find(const MaterialNames *names, const char *name, size_t length)
{
    const uint32_t slot = names->slots.count == 0 ? 0 : *find_slot(names, name, length);
    return slot == 0 ? NULL : &names->list.data[slot - 1];
}

void material_names_free(MaterialNames *names)
{
    free(names->list.memory);
    free(names->slots.memory);
    *names = (MaterialNames){0};
}
