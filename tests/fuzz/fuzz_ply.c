// SPDX-License-Identifier: MIT
// libFuzzer target: parses any bytes as a PLY file. A parsed mesh must satisfy mesh/mesh.h, with
// and without computed normals. A failure must return a message and no mesh. A mesh that
// a tolerant parse returns must also satisfy mesh.h, and be valid input for clrt check.
#include "demand.h"

#include "check/census.h"
#include "mesh/normals.h"
#include "mesh/ply.h"

#include <math.h>
#include <stdlib.h>

static void check_mesh(const Mesh *mesh)
{
    for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++) {
        for (size_t axis = 0; axis < 3; axis++) {
            demand(fabs(mesh->positions[vertex][axis]) < 1e30);
            demand(mesh->normals == NULL || isfinite(mesh->normals[vertex][axis]));
        }
    }
    for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
        for (size_t corner = 0; corner < 3; corner++)
            demand(mesh->triangles[triangle][corner] < mesh->vertex_count);
    }
}

static void judge_mesh(const Mesh *mesh)
{
    Edges edges = {0};
    MeshCensus census = {0};
    Error error = {0};
    const Normalization frame = {{0, 0, 0}, 1};
    demand(edges_make(&edges, mesh, &error) && mesh_faults_find(&census, mesh, &edges, &error));
    demand(edges.weld.unused_count + edges.weld.repeated_count <= mesh->vertex_count);
    demand(census.facts.edge_count <= 3 * mesh->triangle_count);
    demand(features_of(mesh, &frame).flat.count <= mesh->triangle_count);
    edges_free(&edges);
}

static void read_tolerantly(PlySource source)
{
    source.is_tolerant = true;
    Mesh mesh;
    Error error = {0};
    if (ply_parse(&mesh, &source, &error)) {
        check_mesh(&mesh);
        judge_mesh(&mesh);
    }
    mesh_free(&mesh);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const PlySource source = {.bytes = (const char *)data, .size = size, .name = "fuzz.ply"};
    read_tolerantly(source);
    Mesh mesh;
    Error error = {0};
    if (ply_parse(&mesh, &source, &error)) {
        check_mesh(&mesh);
        demand(mesh_compute_normals(&mesh, CREASE_DEGREES, &error));
        check_mesh(&mesh);
    } else {
        demand(error.text[0] != '\0' && mesh.positions == NULL && mesh.triangles == NULL);
    }
    mesh_free(&mesh);
    return 0;
}
