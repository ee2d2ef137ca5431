// SPDX-License-Identifier: MIT
// A scene as its file describes it, in the file's own coordinates and in fp64.
// Elements refer to each other by index, so that the arrays may move while they grow.
#pragma once

#include "../kernels/shared.h"
#include "base/array.h"
#include "base/vec.h"
#include "mesh/mesh.h"

// Limits that keep sample coordinates exact in float and loops bounded.
#define PICTURE_SIZE_MAX 65536
#define MAX_LEVEL_LIMIT  1000

#define COURSE_MATERIALS 4 // of every scene, its first

typedef struct {
    Vec3 position;
    double intensity; // 0 or more; white, without attenuation
} Light;

typedef struct {
    Vec3 center;
    double radius; // above 0
    uint32_t material;
} Sphere;

typedef struct {
    Mesh mesh;
    uint32_t material;
    uint32_t input;         // of the scene's, its file
    uint64_t number_before; // of triangles in other objects of that file, with those left out
    bool two_sided;
    bool smooth; // shade with the vertex normals where there are any
} MeshObject;

// A camera: up and look_at - eye are neither zero nor parallel.
typedef struct {
    Vec3 eye, look_at, up;
    double fov_degrees; // vertical, between 0 and 180
} Viewpoint;

typedef struct {
    char name[64];
    uint32_t material; // index
} MaterialName;

typedef struct {
    ARRAY(Light) lights;
    ARRAY(Sphere) spheres;
    ARRAY(MeshObject) objects;
    ARRAY(Material) materials;          // the first are the course's
    ARRAY(MaterialName) material_names; // of those defined
    ARRAY(Viewpoint) viewpoints;
    bool has_course_views; // the viewpoints are the course's six
    bool is_mesh;          // its file was a mesh alone; viewpoints and lights are clrt's own
    Vec3 background;       // each component in [0, 1]
    double ambient;        // in [0, 1]
    uint32_t width, height;
    uint32_t max_level;
    ARRAY(char *) inputs; // paths of the files it was read from; owned
    ARRAY(char *) notes;  // sentences on what was left out of them; owned
    double mesh_seconds;  // of the loading spent on reading meshes
    // XXH3 of the bytes of the scene file and its meshes in the order read, and of the meshes
    // alone, which is zero without any.
    uint64_t hash[2], mesh_hash[2];
} Scene;

// Fills scene with what a scene file starts from: the course's constants and four materials.
bool scene_init(Scene *scene, Error *error);

// Takes the course's six viewpoints where the scene has none of its own.
bool scene_complete(Scene *scene, Error *error);

// Mixes size bytes of input into scene->hash, those of a mesh into scene->mesh_hash too.
void scene_hash_input(Scene *scene, const void *bytes, size_t size);
void scene_hash_mesh(Scene *scene, const void *bytes, size_t size);

// 32 hexadecimal digits that name a hash, the high half first.
#define SCENE_HASH_SIZE 33
void scene_hash_name(const uint64_t hash[2], char name[SCENE_HASH_SIZE]);

// Notes that the scene was read from the file at path too.
bool scene_add_input(Scene *scene, const char *path, Error *error);

// Adds "PATH: TEXT" to the notes.
bool scene_add_note(Scene *scene, const char *path, const char *text, Error *error);

size_t scene_triangle_count(const Scene *scene);
void scene_free(Scene *scene);

// What is wrong with where the camera stands and looks, in words; NULL where nothing is.
const char *viewpoint_fault(const Viewpoint *viewpoint);

// The material of a define statement that gives nothing but its kind.
Material material_of_shader(Shader shader);
