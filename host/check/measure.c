// SPDX-License-Identifier: MIT
// Takes the census of a scene, and counts the leaks of each mesh.
#include "check/measure.h"

#include <stdlib.h>

bool check_measure(Check *check, Error *error)
{
    check->normalization = normalization_of(check->scene);
    normalization_check(&check->normalization, check->scene, &check->scale_fault);
    return census_take(&check->census, check->scene, &check->normalization, error);
}

static bool count_leaks(Check *check, const Session *session, RayCaster *caster, Error *error)
{
    bool ok = true;
    for (size_t object = 0; ok && object < check->scene->objects.count; object++) {
        const MeshObject *given = &check->scene->objects.data[object];
        if (given->mesh.triangle_count > 0)
            ok = leaks_count(&check->census.meshes[object], caster, given, &check->normalization,
                             session, error);
    }
    return ok;
}

bool check_trace(Check *check, Session *session, Error *error)
{
    RayCaster caster = {0};
    const bool ok = ray_caster_open(&caster, session, RAYS_NEAREST, error) &&
                    count_leaks(check, session, &caster, error);
    ray_caster_close(&caster);
    check->device = ok ? session->device.facts.name : NULL;
    return ok;
}

void check_free(Check *check)
{
    free(check->findings.memory);
    census_free(&check->census);
    *check = (Check){0};
}
