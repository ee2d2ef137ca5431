// SPDX-License-Identifier: MIT
// Mesh -> the number of rays that pass through it at its edges and points. The mesh is traced alone
// and two-sided, in its scene's normalized coordinates.
#pragma once

#include "check/aims.h"
#include "check/census.h"
#include "session/ray_caster.h"

// The check casts rays at no more than this number of aims per mesh.
#define LEAKS_AIMS 1048576

// Fills the facts about aims, rays and leaks in census. `normalization` is that of the mesh's
// scene.
bool leaks_count(MeshCensus *census, RayCaster *caster, const MeshObject *given,
                 const Normalization *normalization, const Session *session, Error *error);
