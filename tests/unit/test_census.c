// SPDX-License-Identifier: MIT
// Tests each count of clrt check on meshes or scenes with the counted fault and without it.
#include "check/census.h"
#include "mesh/ply.h"
#include "unit/parsed.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define TETRAHEDRON "0 0 0  1 0 0  0 1 0  0 0 1"
#define FACES       "0 2 1  0 1 3  0 3 2  1 2 3"

static size_t count_words(const char *text)
{
    size_t count = 0;
    for (text += strspn(text, " "); *text != '\0'; text += strspn(text, " "), count++)
        text += strcspn(text, " ");
    return count;
}

// Stores a PLY file in `bytes`, and returns the file's size. `points` and `faces` are words
// separated by spaces, three per point or face.
static size_t write_ply(char *bytes, size_t size, const char *points, const char *faces)
{
    char copy[4096];
    int length = snprintf(bytes, size,
                          "ply\nformat ascii 1.0\nelement vertex %zu\nproperty double x\n"
                          "property double y\nproperty double z\nelement face %zu\n"
                          "property list uchar int vertex_indices\nend_header\n%s\n",
                          count_words(points) / 3, count_words(faces) / 3, points);
    snprintf(copy, sizeof copy, "%s", faces);
    size_t place = 0;
    for (char *word = strtok(copy, " "); word != NULL; word = strtok(NULL, " "))
        length += snprintf(bytes + length, size - (size_t)length, "%s%s ",
                           place++ % 3 == 0 ? "\n3 " : "", word);
    assert_true((size_t)length < size);
    return (size_t)length;
}

static Mesh mesh_read(const char *points, const char *faces)
{
    Mesh mesh;
    Error error = {0};
    char bytes[16384];
    const size_t size = write_ply(bytes, sizeof bytes, points, faces);
    if (!ply_parse(&mesh,
                   &(PlySource){.bytes = bytes, .size = size, .name = "t.ply", .is_tolerant = true},
                   &error))
        fail_msg("%s", error.text);
    return mesh;
}

typedef struct {
    Scene scene;
    Census census;
} Taken;

// Returns the census of a scene that contains only this mesh. Normalization changes no coordinate.
static Taken census_of_mesh(const char *points, const char *faces)
{
    Taken taken = {0};
    Error error = {0};
    const Normalization frame = {{0, 0, 0}, 1};
    const MeshObject object = {.mesh = mesh_read(points, faces)};
    assert_true(scene_init(&taken.scene, &error) &&
                array_push(&taken.scene.objects, object, &error) &&
                census_take(&taken.census, &taken.scene, &frame, &error));
    return taken;
}

static Taken census_of_scene(const char *text)
{
    Taken taken = {.scene = parsed(text)};
    Error error = {0};
    const Normalization frame = normalization_of(&taken.scene);
    assert_true(census_take(&taken.census, &taken.scene, &frame, &error));
    return taken;
}

static void release(Taken *taken)
{
    census_free(&taken->census);
    scene_free(&taken->scene);
}

static MeshCensus mesh_census(const char *points, const char *faces)
{
    FREED_BY(release) Taken taken = census_of_mesh(points, faces);
    const MeshCensus census = taken.census.meshes[0];
    return census;
}

// The expected count and first triangle of a fault.
typedef struct {
    size_t count, first;
} Expected;

static void expect_fault(const MeshFault *found, Expected expected)
{
    assert_int_equal(found->count, expected.count);
    if (expected.count > 0)
        assert_int_equal(found->first, expected.first);
}

static const struct {
    const char *points, *faces;
    size_t edge_count;
    Expected open, crowded, turned, pinched, duplicates;
    bool is_closed, is_inside_out;
} meshes[] = {
    {TETRAHEDRON, FACES, 6, .is_closed = true},
    {TETRAHEDRON, "0 1 2  0 3 1  0 2 3  1 3 2", 6, .is_closed = true, .is_inside_out = true},
    // A triangle is missing.
    {TETRAHEDRON, "0 1 3  0 3 2  1 2 3", 6, .open = {3, 0}},
    // Vertex 4 splits the edge between vertices 1 and 2 in one triangle, but not in the other.
    {TETRAHEDRON "  0.5 0.5 0", "0 2 1  0 1 3  0 3 2  1 4 3  4 2 3", 9, .open = {3, 0}},
    // A triangle is turned over.
    {TETRAHEDRON, "0 2 1  0 1 3  0 3 2  1 3 2", 6, .turned = {3, 0}},
    // An edge has a third triangle.
    {TETRAHEDRON "  -1 -1 0", FACES "  0 3 4", 8, .crowded = {1, 1}, .open = {2, 4}},
    // Two solids touch at a point.
    {TETRAHEDRON "  -1 0 0  0 -1 0  0 0 -1", FACES "  0 4 5  0 6 4  0 5 6  4 6 5", 12,
     .pinched = {1, 4}},
    // The first mesh has duplicate triangles by vertices, the second mesh by positions.
    {TETRAHEDRON, "0 1 2  0 1 3  1 2 0  2 1 0", 5, .open = {2, 1}, .crowded = {3, 0},
     .duplicates = {2, 2}},
    {"0 0 0  1 0 0  0 1 0  1 0 0", "0 1 2  0 3 2", 3, .turned = {3, 0}, .duplicates = {1, 1}},
};

TEST(edges_points_and_triangles_are_counted_by_fault)
{
    for (size_t i = 0; i < sizeof meshes / sizeof *meshes; i++) {
        const MeshCensus found = mesh_census(meshes[i].points, meshes[i].faces);
        assert_int_equal(found.facts.edge_count, meshes[i].edge_count);
        expect_fault(&found.faults[FAULT_OPEN], meshes[i].open);
        expect_fault(&found.faults[FAULT_CROWDED], meshes[i].crowded);
        expect_fault(&found.faults[FAULT_TURNED], meshes[i].turned);
        expect_fault(&found.faults[FAULT_PINCHED], meshes[i].pinched);
        expect_fault(&found.faults[FAULT_DUPLICATES], meshes[i].duplicates);
        assert_int_equal(found.facts.closed, meshes[i].is_closed);
        assert_int_equal(found.facts.inside_out, meshes[i].is_inside_out);
    }
}

TEST(vertices_at_one_position_are_one_point)
{
    const MeshCensus found = mesh_census("0 0 0  0 1 0  1 0 0  0 0 0  1 0 0  0 0 1 "
                                         " -0 -0 0  0 0 1  0 1 0  1 0 0  0 1 0  0 0 1",
                                         "0 1 2  3 4 5  6 7 8  9 10 11");
    assert_true(found.facts.closed);
    assert_int_equal(found.facts.edge_count, 6);
    assert_int_equal(found.facts.repeated_vertices, 8);
    assert_int_equal(found.facts.unused_vertices, 0);
}

TEST(vertices_that_nothing_uses_are_counted_apart)
{
    const MeshCensus found = mesh_census("5 5 5  0 0 0  1 0 0  0 1 0  0 0 0  5 5 5", "1 2 3");
    assert_int_equal(found.facts.unused_vertices, 3);
    assert_int_equal(found.facts.repeated_vertices, 0);
    assert_true(found.features.extent == 1);
}

TEST(an_edge_of_many_triangles_is_sorted_too)
{
    char points[4096] = "0 0 0  1 0 0", faces[4096] = "";
    for (int i = 0; i < 60; i++) {
        snprintf(points + strlen(points), sizeof points - strlen(points), "  0 1 %d", i % 50);
        snprintf(faces + strlen(faces), sizeof faces - strlen(faces), "  0 1 %d", i + 2);
    }
    const MeshCensus found = mesh_census(points, faces);
    expect_fault(&found.faults[FAULT_CROWDED], (Expected){1, 0});
    expect_fault(&found.faults[FAULT_DUPLICATES], (Expected){10, 50});
    assert_int_equal(found.facts.edge_count, 1 + 2 * 50);
}

TEST(triangles_of_no_area_are_counted)
{
    const MeshCensus found =
        mesh_census("0 0 0  0.1 0.1 0.1  0.2 0.2 0.2  1 0 0  0 1 0  0.25 0.25 0.25 0.5 0.5 0.5",
                    "0 3 4  0 1 2  0 5 6");
    expect_fault(&found.features.flat, (Expected){2, 1});
}

// The triangle's area, 5e-341, is below the range of fp64.
TEST(a_tiny_triangle_has_an_area)
{
    FREED_BY(release)
    Taken taken = census_of_mesh("0 0 0  1e-170 0 0  0 1e-170 0", "0 1 2");
    expect_fault(&taken.census.meshes[0].features.flat, (Expected){0, 0});
}

TEST(nothing_of_an_empty_mesh_is_closed)
{
    FREED_BY(release) Taken taken = census_of_mesh("0 0 0", "");
    assert_int_equal(taken.census.empty_meshes, 1);
    assert_false(taken.census.meshes[0].facts.closed);
    assert_int_equal(taken.census.meshes[0].facts.unused_vertices, 1);
    assert_true(isinf(taken.census.meshes[0].features.edge.steps));
}

TEST(numbers_that_are_not_finite_are_counted_and_left_out)
{
    FREED_BY(mesh_free)
    Mesh mesh = mesh_read("0 0 0  1 nan inf  0 1 0  0 0 1  -inf 0 0  1e300 2 3  1 0 0",
                          "0 2 3  0 1 2  0 2 6  4 5 6  0 0 1");
    expect_fault(&mesh.bad_positions, (Expected){3, 1});
    expect_fault(&mesh.lost_corners, (Expected){3, 1});
    expect_fault(&mesh.equal_corners, (Expected){0, 0});
    assert_int_equal(mesh.triangle_count, 2);
    assert_int_equal(mesh.dropped.count, 3);
    for (size_t vertex = 0; vertex < mesh.vertex_count; vertex++)
        assert_true(isfinite(mesh.positions[vertex][0] + mesh.positions[vertex][1]));
}

TEST(numbers_that_are_not_finite_are_counted_in_binary_files_too)
{
    static const char head[] = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
                               "property float x\nproperty float y\nproperty float z\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "end_header\n";
    const float values[18] = {0, 0, 0, 0, NAN, 1, 1, NAN, NAN, 0, 0, 1, 2, 0, 0, INFINITY, 0, NAN};
    char bytes[sizeof head + sizeof values];
    Mesh mesh;
    Error error = {0};
    memcpy(bytes, head, sizeof head - 1);
    memcpy(bytes + sizeof head - 1, values, sizeof values);
    const size_t size = sizeof head - 1 + sizeof values;
    PlySource source = {.bytes = bytes, .size = size, .name = "t.ply", .is_tolerant = true};
    assert_true(ply_parse(&mesh, &source, &error));
    expect_fault(&mesh.bad_positions, (Expected){1, 1});
    expect_fault(&mesh.bad_normals, (Expected){2, 0});
    assert_true(mesh.normals[2][0] == 0 && mesh.normals[2][2] == 0 && mesh.positions[2][0] == 2);
    mesh_free(&mesh);
    source.is_tolerant = false;
    assert_false(ply_parse(&mesh, &source, &error));
}

TEST(two_equal_corners_are_reported_with_the_triangles_number_in_the_file)
{
    FREED_BY(mesh_free) Mesh mesh = mesh_read("0 0 0  1 0 0  0 1 0  1 0 0", "0 1 2  0 1 3  2 2 0");
    expect_fault(&mesh.equal_corners, (Expected){2, 1});
    expect_fault(&mesh.lost_corners, (Expected){0, 0});
}

TEST(edges_and_heights_are_measured_in_steps_of_float)
{
    // Between 0.5 and 1, the spacing of floats is 2^-24.
    const MeshCensus found = mesh_census(
        "0.5 0 0  0.75 0 0  0.5 0.03125 0  0 0 0  0.875 0 0  0 0.875 0", "3 4 5  0 1 2");
    assert_true(found.features.edge.steps == 0x1p-5 * 0x1p24);
    assert_true(found.features.edge.size == 0x1p-5);
    assert_int_equal(found.features.edge.triangle, 1);
    const double height = 0.25 * 0x1p-5 / sqrt(0.0625 + 0x1p-10);
    assert_true(fabs(found.features.height.size / height - 1) < 1e-12);
    assert_true(fabs(found.features.height.steps / (height * 0x1p24) - 1) < 1e-12);
    assert_true(found.features.extent == 0.875);
    assert_true(found.features.holds_floats);
}

TEST(coordinates_far_from_the_origin_are_written_in_coarser_steps)
{
    Taken taken = census_of_scene("mesh cube.ply translate 1048576 0 0");
    const Features *features = &taken.census.meshes[0].features;
    assert_true(features->offset >= 0x1p20 - 2 && features->extent <= 4);
    assert_true(features->written_edge.steps <= features->extent * 16);
    assert_true(features->edge.steps > 1e5);
    release(&taken);
    taken = census_of_scene("mesh cube.ply translate 0.1 0 0");
    assert_false(taken.census.meshes[0].features.holds_floats);
    release(&taken);
}

TEST(repeated_meshes_spheres_and_lights_are_duplicates)
{
    FREED_BY(release)
    Taken taken = census_of_scene("light 1 2 3 1\nlight 1 2 4 1\nlight 1 2 3 0.5\n"
                                  "sun 1 2 3 1\nsun 0.5 1 1.5 1\nsun 1 2 -3 1\n"
                                  "sphere 0 0 0 1\nsphere 0 -0 0 1\nsphere 0 0 0 2\n"
                                  "ply_file cube.ply\nply_file cone.ply\nply_file cube.ply\n"
                                  "mesh cube.ply translate 1 0 0");
    assert_int_equal(taken.census.duplicate_lights, 2);
    assert_int_equal(taken.census.duplicate_spheres, 1);
    assert_int_equal(taken.census.duplicate_meshes, 1);
}

TEST(defined_materials_that_nothing_has_are_unused)
{
    FREED_BY(release)
    Taken taken = census_of_scene("define red matte\ndefine green matte\ndefine blue matte\n"
                                  "material green\nsphere 0 0 0 1\nmaterial red\n"
                                  "ply_file cube.ply");
    assert_int_equal(taken.census.unused_materials, 1);
}
