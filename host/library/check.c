// SPDX-License-Identifier: MIT
// Scene -> the measurements and findings of `clrt check`. A ClrtCheck refers to no scene, so the
// caller may change or free the scene.
#include "check/measure.h"
#include "library/handles.h"

#include <stdio.h>
#include <stdlib.h>

struct ClrtCheck {
    ClrtCheckInfo info;
    ClrtCheckedMesh *meshes;
    ClrtFinding *findings;
};

void clrt_check_free(ClrtCheck *check)
{
    if (check == NULL)
        return;
    free(check->meshes);
    free(check->findings);
    free(check);
}

// Moves the results of *check into *made, which is empty.
static bool keep(ClrtCheck *made, Check *check, Error *cause)
{
    const size_t meshes = check->scene->objects.count;
    made->info = (ClrtCheckInfo){.fine = check_count_failing(check) == 0,
                                 .mesh_count = (uint32_t)meshes,
                                 .finding_count = (uint32_t)check->findings.count};
    made->findings = check->findings.data;
    check->findings.memory = NULL;
    made->meshes = memory_raw(meshes, sizeof *made->meshes, cause);
    for (size_t i = 0; made->meshes != NULL && i < meshes; i++) {
        const char *path = check_mesh_path(check, i);
        made->meshes[i] = check->census.meshes[i].facts;
        snprintf(made->meshes[i].path, sizeof made->meshes[i].path, "%s", path != NULL ? path : "");
    }
    return made->meshes != NULL;
}

ClrtCheck *clrt_check(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    Error cause = {0};
    if (!renderer_handle_begin(renderer, scene, error))
        return NULL;
    Check check = {.scene = &scene->scene};
    ClrtCheck *made = memory_zeroed(1, sizeof *made, &cause);
    const bool ok = made != NULL && check_measure(&check, &cause) &&
                    check_trace(&check, &renderer->session, &cause) && check_find(&check, &cause) &&
                    keep(made, &check, &cause);
    check_free(&check);
    renderer_handle_end(renderer);
    if (ok)
        return made;
    library_fail_for(error, CLRT_DEVICE, &cause);
    clrt_check_free(made);
    return NULL;
}

bool clrt_check_get_info(const ClrtCheck *check, ClrtCheckInfo *info, ClrtError *error)
{
    return argument_given(error, "the check", check) &&
           argument_fill(error, "the info", info, &check->info, sizeof check->info);
}

bool clrt_check_get_mesh(const ClrtCheck *check, uint32_t number, ClrtCheckedMesh *mesh,
                         ClrtError *error)
{
    if (!argument_given(error, "the check", check))
        return false;
    if (number >= check->info.mesh_count)
        return library_fail(error, CLRT_ARGUMENT, "there is no mesh %u", number);
    return argument_fill(error, "the mesh", mesh, &check->meshes[number], sizeof *mesh);
}

bool clrt_check_get_finding(const ClrtCheck *check, uint32_t number, ClrtFinding *finding,
                            ClrtError *error)
{
    if (!argument_given(error, "the check", check))
        return false;
    if (number >= check->info.finding_count)
        return library_fail(error, CLRT_ARGUMENT, "there is no finding %u", number);
    return argument_fill(error, "the finding", finding, &check->findings[number], sizeof *finding);
}
