// SPDX-License-Identifier: MIT
// libclrt: pictures of scenes, from your own program; `cc picture.c $(pkg-config --libs clrt)`.
//
// A picture has the bits that `clrt SCENE -o picture.pfm` writes of the same scene and settings.
// The library prints nothing, never ends the program, installs no signal handlers and leaves the
// environment alone; what OpenCL drivers do is theirs.  Where a call fails, it returns false or
// NULL and, if an error is given, says in it why; nothing has changed then but what the call says.
// Arrays and structs are copied: they are the caller's again when a call returns.
//
// Threads: calls for different scenes and renderers may run at once, and so may renderers that draw
// the same scene while nobody changes it.  A renderer draws one picture at a time.
//
// Structs begin with their size, `.size = sizeof(...)`: a later version of the library, which knows
// more members, takes what it is not given for zero, which is always the default.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CLRT_API __attribute__((visibility("default")))

// The version of the library as it is linked, such as "0.1.0".
CLRT_API const char *clrt_version(void);

// What stopped a call; those that `clrt` has too are its exit statuses.
typedef enum {
    CLRT_STOPPED = 1,  // by the caller's progress function
    CLRT_ARGUMENT = 2, // an argument is not what the call can work with
    CLRT_SCENE = 3,    // the scene cannot be read, kept or drawn
    CLRT_DEVICE = 4    // no device, or it failed
} ClrtFault;

typedef struct {
    ClrtFault fault;
    char text[4092]; // a sentence without a period
} ClrtError;

// Scenes

typedef struct ClrtScene ClrtScene;

// Reads a scene file (man 5 clrt-scene) or a lone mesh, as `clrt` does: for models other than PLY
// it starts clrt's program clrt-foreign where that is installed.
CLRT_API ClrtScene *clrt_scene_load(const char *path, ClrtError *error);

// An empty scene: a white background, ambient light of 0.05, and the materials below.
CLRT_API ClrtScene *clrt_scene_create(ClrtError *error);

// NULL is harmless.
CLRT_API void clrt_scene_free(ClrtScene *scene);

// Materials that every scene has; those added follow.
enum {
    CLRT_MATERIAL_SILHOUETTE,
    CLRT_MATERIAL_MATTE,
    CLRT_MATERIAL_BLINN_PHONG,
    CLRT_MATERIAL_MIRROR // matte, and a quarter mirror
};

typedef enum { CLRT_SHADING_SILHOUETTE, CLRT_SHADING_MATTE, CLRT_SHADING_BLINN_PHONG } ClrtShading;

// Color seen = (1 - reflectivity) * shaded + reflectivity * reflected, where shaded is
// diffuse * (ambient + kd * received light), to which BLINN_PHONG adds its highlights,
// specular * ks * cosine ^ shininess; of SILHOUETTE it is diffuse.
typedef struct {
    size_t size;
    ClrtShading shading;
    double diffuse[3], specular[3]; // R G B in [0, 1]
    double kd, ks;                  // in [0, 1000]
    double shininess;               // in [0, 1e9]
    double reflectivity;            // in [0, 1]
} ClrtMaterial;

// Leaves the number of the new material in *number.
CLRT_API bool clrt_scene_add_material(ClrtScene *scene, const ClrtMaterial *material,
                                      uint32_t *number, ClrtError *error);

// Coordinates are at most 1e30 in size, radii in [1e-30, 1e30].
CLRT_API bool clrt_scene_add_sphere(ClrtScene *scene, const double center[3], double radius,
                                    uint32_t material, ClrtError *error);

// Triangles whose corners are counter-clockwise where they are seen from in front.  Those with two
// equal corners are left out.
typedef struct {
    size_t size;
    const double *positions;   // vertex_count times X Y Z
    const float *normals;      // the same of any length, zero for a vertex without; NULL for none
    const uint32_t *triangles; // triangle_count times three vertices, from 0
    size_t vertex_count, triangle_count; // each at most 2147483647
    uint32_t material;
    bool two_sided; // seen from behind too
    bool flat;      // shaded without the normals
} ClrtMesh;

CLRT_API bool clrt_scene_add_mesh(ClrtScene *scene, const ClrtMesh *mesh, ClrtError *error);

// A white point light of an intensity in [0, 1e30], without attenuation.
CLRT_API bool clrt_scene_add_light(ClrtScene *scene, const double position[3], double intensity,
                                   ClrtError *error);

typedef struct {
    size_t size;
    double eye[3], look_at[3];
    double up[3];       // 0 0 0 stands for 0 0 1
    double fov_degrees; // vertical, in [1e-6, 179.9999]
} ClrtCamera;

// The scene's next view.
CLRT_API bool clrt_scene_add_camera(ClrtScene *scene, const ClrtCamera *camera, ClrtError *error);

// R G B in [0, 1], of what rays see that meet nothing.
CLRT_API bool clrt_scene_set_background(ClrtScene *scene, const double color[3], ClrtError *error);

// In [0, 1].
CLRT_API bool clrt_scene_set_ambient(ClrtScene *scene, double intensity, ClrtError *error);

typedef struct {
    size_t size;
    uint32_t width, height; // that its file gives; 512 512
    uint32_t max_level;     // likewise; 3
    uint32_t view_count;
    uint32_t light_count, material_count, sphere_count;
    uint64_t triangle_count;
    uint64_t dropped_triangle_count; // left out for two equal corners
} ClrtSceneInfo;

// Fills the size bytes at info that the caller has set.
CLRT_API bool clrt_scene_get_info(const ClrtScene *scene, ClrtSceneInfo *info, ClrtError *error);

// Renderers

typedef struct ClrtRenderer ClrtRenderer;

// Opens an OpenCL device and compiles the kernels for it, which takes a second or two where the
// driver has not kept them.  device is what `clrt --device` takes: PLATFORM:DEVICE, a type (cpu,
// gpu, accelerator, all) or part of a name; NULL is the first GPU, else the first device.  Trees
// are built by that many threads; 0 stands for as many as affinity and the control groups' quotas
// allow. How many a CPU device has is up to its driver and, as libraries set no environment, to the
// program: PoCL reads POCL_MAX_PTHREAD_COUNT, later POCL_CPU_MAX_CU_COUNT, at its first call.
// A lock in $XDG_CACHE_HOME/clrt/library, else ~/.cache/clrt/library, keeps processes that compile
// at once from losing PoCL's kernels, and checksums there find kernels that were damaged since,
// which are compiled again.  PoCL itself finds no device where it can write neither to its cache in
// those folders nor to $POCL_CACHE_DIR.
CLRT_API ClrtRenderer *clrt_renderer_create(const char *device, uint32_t threads, ClrtError *error);

// NULL is harmless.
CLRT_API void clrt_renderer_free(ClrtRenderer *renderer);

// Is told, in the thread that draws, of every finished tile, and returns whether to go on.  It may
// not free the renderer, and draw with another one only.
typedef bool ClrtProgress(void *user, uint64_t tiles_done, uint64_t tiles);

typedef struct {
    size_t size;
    uint32_t width, height; // of the picture in pixels, each in [1, 65536]
    uint32_t view;          // of the scene, from 1; 0 is 1
    uint32_t samples;       // N takes N x N samples in every pixel, at most 64; 0 is 1
    uint32_t max_level;     // rays of that level return the background, up to 1000; 0: the scene's
    const ClrtCamera *camera; // to be used instead of the scene's view; NULL for none
    ClrtProgress *progress;   // NULL for none
    void *user;               // for progress
} ClrtPicture;

// Draws the scene into rgb, which has room for 3 * width * height floats: R G B in [0, 1], the top
// row first.  The first picture of a scene, and the first after it was changed, also builds its
// tree; another size or camera costs nothing.  False with CLRT_STOPPED where progress did not want
// to go on before the last tile.  A picture that is not whole has whole tiles of 128 x 128 pixels;
// the rest of rgb is as it was.
CLRT_API bool clrt_render(ClrtRenderer *renderer, const ClrtScene *scene,
                          const ClrtPicture *picture, float *rgb, ClrtError *error);

#ifdef __cplusplus
}
#endif
