// SPDX-License-Identifier: MIT
// Finds and runs clrt-foreign, and limits its time and the size of its output. clrt-foreign itself
// limits its other resources.
#include "mesh/foreign_process.h"

#include <errno.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

// Assimp 5's file extensions. The list omits .ply, which clrt reads itself, .scn, which is clrt's
// own, and plain .xml, which identifies no format.
static const char *const endings[] = {
    "3d",      "3ds", "3mf",   "ac",   "ac3d",     "acc", "amf",    "ase",     "ask",
    "assbin",  "b3d", "blend", "bsp",  "bvh",      "cob", "csm",    "dae",     "dxf",
    "enff",    "fbx", "glb",   "gltf", "hmp",      "ifc", "ifczip", "iqm",     "irr",
    "irrmesh", "lwo", "lws",   "lxo",  "m3d",      "md2", "md3",    "md5anim", "md5camera",
    "md5mesh", "mdc", "mdl",   "mesh", "mesh.xml", "mot", "ms3d",   "ndo",     "nff",
    "obj",     "off", "ogex",  "pk3",  "pmx",      "prj", "q3o",    "q3s",     "raw",
    "sib",     "smd", "step",  "stl",  "stp",      "ter", "uc",     "vrm",     "vta",
    "x",       "x3d", "x3db",  "xgl",  "zae",      "zgl",
};

bool foreign_format_is(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        const size_t ending = strlen(endings[i]);
        if (length > ending && path[length - ending - 1] == '.' &&
            strcasecmp(path + length - ending, endings[i]) == 0)
            return true;
    }
    return false;
}

// The time exceeds clrt-foreign's own limit, so that clrt-foreign's alarm normally ends it first.
const ForeignReader foreign_reader = {.limits = {.seconds = 125, .bytes = (size_t)8 << 30}};

#ifdef CLRT_FOREIGN_FOLDER
// Other programs that use clrt's library find clrt-foreign in the configured installation folder.
static bool find_program(char path[COMPANION_PATH_SIZE], const char *model, Error *error)
{
    if (file_companion(path, "clrt-foreign", CLRT_FOREIGN_FOLDER) && access(path, X_OK) == 0)
        return true;
    snprintf(path, COMPANION_PATH_SIZE, "%s/clrt-foreign", CLRT_FOREIGN_INSTALLED);
    return access(path, X_OK) == 0 ||
           error_set(error, "%s: %s, which reads it, cannot be started: %s", model, path,
                     strerror(errno));
}
#else
static bool find_program(char path[COMPANION_PATH_SIZE], const char *model, Error *error)
{
    (void)path;
    return error_set(error,
                     "%s: this build reads only PLY meshes, because it lacks Assimp; add it: "
                     "tools/setup meshes && tools/render SCENE",
                     model);
}
#endif

static bool judge(ChildFate fate, int signal, const char *model, Error *error)
{
    switch (fate) {
    case CHILD_DONE:
        return true;
    case CHILD_LATE:
        return error_set(error, "%s: Assimp took too long to read it and was stopped", model);
    case CHILD_LONG:
        return error_set(error, "%s: Assimp exceeded the limit of its output and was stopped",
                         model);
    case CHILD_LOST:
        return error_set(error, "%s: the output of Assimp cannot be read", model);
    case CHILD_CRASHED:
        return error_set(error, "%s: Assimp crashed while reading it (signal %d)", model, signal);
    case CHILD_FAILED:
        break;
    }
    return error_set(error, "%s: clrt-foreign, which reads it, ended too early", model);
}

bool foreign_process_run(File *stream, const ForeignReader *reader, const char *path, Error *error)
{
    char found[COMPANION_PATH_SIZE];
    Error cause = {0};
    ChildProcess child;
    int signal;
    *stream = (File){0};
    if (reader->program == NULL && !find_program(found, path, error))
        return false;
    const char *program = reader->program != NULL ? reader->program : found;
    if (!child_spawn(&child, program, path, &cause))
        return error_set(error, "%s: %s, which reads it, cannot be started: %s", path, program,
                         cause.text);
    const ChildFate fate = child_collect(&child, &reader->limits, stream, &signal, error);
    const bool ok = judge(fate, signal, path, error);
    if (!ok)
        file_free(stream);
    return ok;
}
