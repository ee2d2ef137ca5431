// SPDX-License-Identifier: MIT
// A scene as its file describes it, in fp64 and in the file's coordinates. Elements refer to each
// other by index, because arrays may move when they grow. Every later stage borrows the scene and
// leaves it unchanged.
#pragma once

#include "../kernels/shared.h"
#include "base/array.h"
#include "base/vec.h"
#include "mesh/mesh.h"

// The first limit keeps sample coordinates exact in float, and the second keeps loops short.
#define PICTURE_SIZE_MAX 131072
#define MAX_LEVEL_LIMIT  1000

// Every scene begins with the materials of the UvA course (docs/scenes.md).
#define COURSE_MATERIALS 4
#define COURSE_MATTE     1

// If the scene's file is a lone mesh, two more materials follow, for meshes without materials and
// for the floor. The file's own materials come last.
enum { MESH_CLAY = COURSE_MATERIALS, MESH_FLOOR, MESH_OWN_MATERIALS };

typedef struct {
    Vec3 position;    // of a sun: a vector toward it, not 0
    double intensity; // 0 or more; does not decrease with the distance
    Vec3 color;       // each component in [0, 1]
    bool is_sun;      // infinitely far away
} Light;

// A parallelogram around a light's position, divided into a grid of cells.
typedef struct {
    Vec3 sides[2];
    uint32_t cells; // along each side, in [1, AREA_CELLS_MOST]
} LightArea;

// A light with an area, as scene text states it. Its point lights are consecutive in Scene::lights.
typedef struct {
    Light light;
    LightArea area;
    size_t first; // index of its first point light
} AreaLight;

typedef struct {
    Vec3 center;
    double radius; // above 0
    uint32_t material;
} Sphere;

#define NO_INPUT UINT32_MAX

typedef struct {
    Mesh mesh;              // shaded smoothly if it has normals
    uint32_t material;      // if the mesh has colors, they replace the diffuse color
    uint32_t input;         // index of the mesh's file in Scene::inputs; NO_INPUT without a file
    uint64_t number_before; // triangles in earlier objects of the file, including dropped ones
    bool two_sided;
} MeshObject;

typedef struct {
    char name[64];
    uint32_t material; // index in Scene::materials
} MaterialName;

// {0} has no names.
typedef struct {
    ARRAY(MaterialName *) list; // owned
    void *tree;                 // a tree of tsearch, ordered by name
} MaterialNames;

// A camera. The vectors `up` and `look_at` - `eye` must be neither zero nor parallel. An
// orthographic camera has a `height` above 0, and its angles are not used. Its parallel rays start
// on a plane through the eye.
typedef struct {
    Vec3 eye, look_at, up;
    double fov_degrees;   // vertical, between 0 and 180
    double width_degrees; // narrow pictures show at least this horizontal angle; 0 for no minimum
    double height;        // of an orthographic picture, in scene units; 0 for a pinhole camera
    double width;         // narrow orthographic pictures show at least this width; 0 for no minimum
} Viewpoint;

typedef struct {
    ARRAY(Light) lights;
    ARRAY(AreaLight) area_lights; // of more than one point light, in the order of `lights`
    ARRAY(Sphere) spheres;
    ARRAY(MeshObject) objects;
    ARRAY(Material) materials;    // the course's materials, then defined and imported materials
    MaterialNames material_names; // names of defined and imported materials
    ARRAY(Viewpoint) viewpoints;
    bool has_course_views; // the viewpoints are the course's six
    UpAxis mesh_up;        // the axis of a lone mesh that was turned to z; UP_AUTO for scene text
    Vec3 background;       // each component in [0, 1]
    double ambient;        // in [0, 1]
    uint32_t width, height;
    uint32_t max_level;
    ARRAY(char *) inputs; // paths of the files read; owned
    ARRAY(char *) notes;  // messages about the files, for example about omitted data; owned
    double mesh_seconds;  // time spent on loading meshes
    // `hash` combines the XXH3 hashes of the scene's text, of its mesh files and, for a lone mesh,
    // of the up axis, the normals and the studio. `mesh_hash` combines only the hashes of the mesh
    // files, and is zero without meshes.
    uint64_t hash[2], mesh_hash[2];
} Scene;

// Fills *scene with the defaults of a scene file: the course's constants and four materials.
bool scene_init(Scene *scene, Error *error);

// Adds the course's six viewpoints if the scene has no viewpoint.
bool scene_complete(Scene *scene, Error *error);

// Adds to the scene's lights a point light in each cell of the area. Together, the point lights
// have the intensity of `light`. If memory runs out, adds nothing.
bool scene_add_area_light(Scene *scene, const Light *light, const LightArea *area, Error *error);

// Both functions combine a hash of the bytes with scene->hash. scene_hash_mesh also changes
// scene->mesh_hash.
void scene_hash_input(Scene *scene, const void *bytes, size_t size);
void scene_hash_mesh(Scene *scene, const void *bytes, size_t size);

// Writes a hash as 32 hexadecimal digits, the high half first.
#define SCENE_HASH_SIZE 33
void scene_hash_name(const uint64_t hash[2], char name[SCENE_HASH_SIZE]);

// Appends a copy of `path` to the scene's inputs.
bool scene_add_input(Scene *scene, const char *path, Error *error);

// Appends "PATH: TEXT" to the scene's notes.
bool scene_add_note(Scene *scene, const char *path, const char *text, Error *error);

size_t scene_triangle_count(const Scene *scene);
size_t scene_dropped_count(const Scene *scene); // triangles that were removed from meshes

// Returns a triangle's number in its file. The numbers include dropped triangles.
uint64_t scene_number_in_file(const MeshObject *object, size_t triangle);

void scene_free(Scene *scene);

// Returns the reason why the viewpoint is invalid, or NULL if it is valid.
const char *viewpoint_fault(const Viewpoint *viewpoint);

// The names of shaders in scene text, indexed by Shader.
extern const char *const shader_names[];

// Returns the shader's default material, which a `define` statement without properties creates.
Material material_of_shader(Shader shader);

void material_set_shininess(Material *material, float shininess);

// Appends a name. Returns false if memory runs out.
bool material_names_add(MaterialNames *names, const MaterialName *name, Error *error);

// Returns the first entry with this name, or NULL if there is none.
const MaterialName *material_names_find(const MaterialNames *names, const char *name,
                                        size_t length);

void material_names_free(MaterialNames *names);

typedef struct {
    const char *kind; // a name for programs; NULL if nothing is missing
    const char *text; // a clause for messages
    bool is_fault;    // the files contain only parts that clrt cannot draw
} MissingPart;

// Returns the first missing part: objects to render, or lights for surfaces that need them.
MissingPart scene_missing(const Scene *scene);

// A ray's weight is the product of the reflectivities on its path. Colors are at most 1, so the
// error that `max_level` causes is at most the largest weight of a ray of this level.

// Returns an upper bound on the error of every color if rays of level `max_level` return the
// background.
double truncation_bound(const Scene *scene, uint32_t max_level);

bool scene_has_glass(const Scene *scene);

// Returns the largest max_level that pictures of the scene can have. Higher values are reduced to
// this limit.
uint32_t scene_level_limit(const Scene *scene);

// Returns the smallest max_level whose truncation_bound is at most `bound`, but not more than
// scene_level_limit.
uint32_t truncation_level(const Scene *scene, double bound);
