// SPDX-License-Identifier: MIT
// The file extensions that Assimp 5 reads. The list omits .ply, which clrt reads itself, .scn,
// which is clrt's own format, and plain .xml, which identifies no format.
#include "mesh/foreign_format.h"

#include <string.h>
#include <strings.h>

const char *const foreign_endings[] = {
    "3d",      "3ds", "3mf",   "ac",   "ac3d",     "acc", "amf",    "ase",     "ask",
    "assbin",  "b3d", "blend", "bsp",  "bvh",      "cob", "csm",    "dae",     "dxf",
    "enff",    "fbx", "glb",   "gltf", "hmp",      "ifc", "ifczip", "iqm",     "irr",
    "irrmesh", "lwo", "lws",   "lxo",  "m3d",      "md2", "md3",    "md5anim", "md5camera",
    "md5mesh", "mdc", "mdl",   "mesh", "mesh.xml", "mot", "ms3d",   "ndo",     "nff",
    "obj",     "off", "ogex",  "pk3",  "pmx",      "prj", "q3o",    "q3s",     "raw",
    "sib",     "smd", "step",  "stl",  "stp",      "ter", "uc",     "vrm",     "vta",
    "x",       "x3d", "x3db",  "xgl",  "zae",      "zgl",
};
const size_t foreign_ending_count = sizeof foreign_endings / sizeof foreign_endings[0];

bool foreign_format_is(const char *path)
{
    const size_t length = strlen(path);
    for (size_t i = 0; i < foreign_ending_count; i++) {
        const size_t ending = strlen(foreign_endings[i]);
        if (length > ending && path[length - ending - 1] == '.' &&
            strcasecmp(path + length - ending, foreign_endings[i]) == 0)
            return true;
    }
    return false;
}
