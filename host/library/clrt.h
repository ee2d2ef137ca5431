// SPDX-License-Identifier: MIT
// libclrt renders scenes from your own program: `cc picture.c $(pkg-config --libs clrt)`.
//
// A picture has the bits that `clrt SCENE -o picture.pfm` writes for the same scene and settings.
// The library prints nothing, never ends the program, installs no signal handlers and does not
// touch the environment.  OpenCL drivers may do so.  A failed call returns false or NULL and fills
// error unless it is NULL.  It changes nothing unless its comment says so.  Calls copy arrays and
// structs, so the caller may free or reuse them afterwards.
//
// Threads: calls for different scenes and renderers may run concurrently.  Several renderers may
// draw one scene as long as nobody changes it.  A renderer draws one picture at a time.
//
// Every struct begins with its size, `.size = sizeof(...)`.  A later version of the library, with
// more members, treats missing members as zero.  Zero is always the default.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CLRT_API __attribute__((visibility("default")))

// Returns the version of the linked library, such as "0.1.0".
CLRT_API const char *clrt_version(void);

// Why a call failed.  Values 2 to 4 are also exit statuses of `clrt`.
typedef enum {
    CLRT_STOPPED = 1,  // the caller's progress function stopped it
    CLRT_ARGUMENT = 2, // an argument is invalid
    CLRT_SCENE = 3,    // the scene cannot be read, stored or drawn
    CLRT_DEVICE = 4    // no device, or a device failure
} ClrtFault;

typedef struct {
    ClrtFault fault;
    char text[4092]; // one message without a final period
} ClrtError;

// Scenes

typedef struct ClrtScene ClrtScene;

// Reads a scene file (man 5 clrt-scene) or a single mesh, as `clrt` does.  Models other than PLY
// need clrt's program clrt-foreign, which the call starts.
CLRT_API ClrtScene *clrt_scene_load(const char *path, ClrtError *error);

// Returns an empty scene: a white background, ambient light of 0.05, and the materials below.
CLRT_API ClrtScene *clrt_scene_create(ClrtError *error);

// Accepts NULL.
CLRT_API void clrt_scene_free(ClrtScene *scene);

// The materials of every scene; added materials follow.
enum {
    CLRT_MATERIAL_SILHOUETTE,
    CLRT_MATERIAL_MATTE,
    CLRT_MATERIAL_BLINN_PHONG,
    CLRT_MATERIAL_MIRROR // matte, with a reflectivity of 0.25
};

typedef enum { CLRT_SHADING_SILHOUETTE, CLRT_SHADING_MATTE, CLRT_SHADING_BLINN_PHONG } ClrtShading;

// The visible color is (1 - reflectivity) * shaded + reflectivity * reflected.  For MATTE, shaded
// is diffuse * (ambient + kd * received light).  BLINN_PHONG adds highlights of specular * ks *
// cosine ^ shininess.  For SILHOUETTE, shaded is diffuse.
typedef struct {
    size_t size;
    ClrtShading shading;
    double diffuse[3], specular[3]; // R G B in [0, 1]
    double kd, ks;                  // in [0, 1000]
    double shininess;               // in [0, 1e9]
    double reflectivity;            // in [0, 1]
} ClrtMaterial;

// Stores the number of the new material in *number.
CLRT_API bool clrt_scene_add_material(ClrtScene *scene, const ClrtMaterial *material,
                                      uint32_t *number, ClrtError *error);

// Coordinates are at most 1e30 in magnitude, radii are in [1e-30, 1e30].
CLRT_API bool clrt_scene_add_sphere(ClrtScene *scene, const double center[3], double radius,
                                    uint32_t material, ClrtError *error);

// Triangles with counter-clockwise corners seen from the front.  clrt drops triangles with two
// equal corners.
typedef struct {
    size_t size;
    const double *positions;   // X Y Z of each vertex
    const float *normals;      // X Y Z of each vertex, any length; zero for none; NULL without
    const uint32_t *triangles; // three vertices of each triangle, from 0
    size_t vertex_count, triangle_count; // each at most 2147483647
    uint32_t material;
    bool two_sided; // visible from behind, too
    bool flat;      // shaded without the normals
} ClrtMesh;

CLRT_API bool clrt_scene_add_mesh(ClrtScene *scene, const ClrtMesh *mesh, ClrtError *error);

// Adds a white point light of an intensity in [0, 1e30], without attenuation.
CLRT_API bool clrt_scene_add_light(ClrtScene *scene, const double position[3], double intensity,
                                   ClrtError *error);

typedef struct {
    size_t size;
    double eye[3], look_at[3];
    double up[3];       // 0 0 0 means 0 0 1
    double fov_degrees; // vertical, in [1e-6, 179.9999]
} ClrtCamera;

// Appends a view to the scene.
CLRT_API bool clrt_scene_add_camera(ClrtScene *scene, const ClrtCamera *camera, ClrtError *error);

// Sets the color of rays that hit nothing: R G B in [0, 1].
CLRT_API bool clrt_scene_set_background(ClrtScene *scene, const double color[3], ClrtError *error);

// Sets the ambient light, in [0, 1].
CLRT_API bool clrt_scene_set_ambient(ClrtScene *scene, double intensity, ClrtError *error);

typedef struct {
    size_t size;
    uint32_t width, height; // from the scene file; else 512 512
    uint32_t max_level;     // from the scene file; else 3
    uint32_t view_count;
    uint32_t light_count, material_count, sphere_count;
    uint64_t triangle_count;
    uint64_t dropped_triangle_count; // dropped for two equal corners
} ClrtSceneInfo;

// Fills the first info->size bytes of info; the caller sets size.
CLRT_API bool clrt_scene_get_info(const ClrtScene *scene, ClrtSceneInfo *info, ClrtError *error);

// Renderers

typedef struct ClrtRenderer ClrtRenderer;

// Opens an OpenCL device and compiles the kernels for it.  Compiling takes a second or two unless
// the driver has cached them.  device has the syntax of `clrt --device`: PLATFORM:DEVICE, a type
// (cpu, gpu, accelerator, all) or part of a name.  NULL selects the first GPU, else the first
// device.
//
// threads is the number of threads that build trees; 0 selects as many as the affinity mask and the
// control groups' quotas allow.  The driver sets the number of threads of a CPU device.  The
// library sets no environment variable, so the program must: PoCL reads POCL_MAX_PTHREAD_COUNT
// (later versions: POCL_CPU_MAX_CU_COUNT) at its first call.
//
// A lock in $XDG_CACHE_HOME/clrt/library, else ~/.cache/clrt/library, keeps processes that compile
// concurrently from losing PoCL's kernels.  Checksums in this folder detect damaged kernels, which
// are compiled again.  PoCL finds no device unless it can write to its cache there or to
// $POCL_CACHE_DIR.
CLRT_API ClrtRenderer *clrt_renderer_create(const char *device, uint32_t threads, ClrtError *error);

// Accepts NULL.
CLRT_API void clrt_renderer_free(ClrtRenderer *renderer);

// Called for every finished tile, in the drawing thread; returns whether to continue.  It must not
// free the renderer, and may draw only with another one.
typedef bool ClrtProgress(void *user, uint64_t tiles_done, uint64_t tiles);

typedef struct {
    size_t size;
    uint32_t width, height; // in pixels, each in [1, 65536]
    uint32_t view;          // of the scene, from 1; 0 means 1
    uint32_t samples;       // per pixel and axis: N means N x N, at most 64; 0 means 1
    uint32_t max_level; // rays of this level return the background; at most 1000; 0: the scene's
    const ClrtCamera *camera; // replaces the scene's view; NULL for none
    ClrtProgress *progress;   // NULL for none
    void *user;               // passed to progress
} ClrtPicture;

// Draws the scene into rgb, an array of 3 * width * height floats: R G B in [0, 1], top row first.
// The first picture of a new or changed scene also builds its tree; a new size or camera costs
// nothing. Returns false with CLRT_STOPPED if progress stopped the picture before its last tile.
// An incomplete picture has whole tiles of 128 x 128 pixels, and the rest of rgb is unchanged.
CLRT_API bool clrt_render(ClrtRenderer *renderer, const ClrtScene *scene,
                          const ClrtPicture *picture, float *rgb, ClrtError *error);

#ifdef __cplusplus
}
#endif
