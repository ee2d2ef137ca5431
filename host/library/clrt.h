// SPDX-License-Identifier: MIT
// libclrt renders scenes from your own program: `cc picture.c $(pkg-config --cflags --libs clrt)`.
//
// A picture equals, bit for bit, the picture that `clrt SCENE -o picture.pfm` writes with the same
// settings. The library prints nothing, never ends the program, installs no signal handlers and
// sets no environment variables. OpenCL drivers may do all of these.
//
// A failed call returns false or NULL and stores the reason in *error, unless `error` is NULL. The
// call changes nothing else, unless a comment says so. Calls copy arrays and structs, so the caller
// may free or reuse them after the call.
//
// Threads may call functions concurrently for different scenes and renderers. Several renderers may
// draw one scene while no thread changes it. While one call uses a renderer, other calls with this
// renderer fail, and clrt_renderer_free must not be called.
//
// Structs that callers pass begin with their size, `.size = sizeof(...)`. Later versions of the
// library may add members at the end. Members that an older program's struct lacks count as zero,
// which selects their defaults. A function that fills a struct writes at most its first `size`
// bytes, so the caller sets `size` before the call.
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

// The reasons for failed calls. Values 2 to 4 are also exit statuses of `clrt`.
typedef enum {
    CLRT_STOPPED = 1,  // the caller's progress function stopped the call
    CLRT_ARGUMENT = 2, // an argument is invalid
    CLRT_SCENE = 3,    // the scene cannot be read, stored or drawn
    CLRT_DEVICE = 4    // no device, a device failure, or too little memory
} ClrtFault;

typedef struct {
    ClrtFault fault;
    char text[4092]; // one message without a final period
} ClrtError;

// Scenes

typedef struct ClrtScene ClrtScene;

// The axis of a mesh file that points up in the scene, as in the option --up.
typedef enum {
    CLRT_UP_AUTO, // chosen by the file's format and the mesh's shape
    CLRT_UP_X,
    CLRT_UP_Y,
    CLRT_UP_Z,
    CLRT_UP_MINUS_X,
    CLRT_UP_MINUS_Y,
    CLRT_UP_MINUS_Z
} ClrtUp;

// Settings for mesh files. For scene files, which contain these settings, all members except `size`
// must be 0.
typedef struct {
    size_t size;
    ClrtUp up;
    bool flat;             // ignores the file's normals; otherwise, computes missing normals
    double crease_degrees; // larger angles between triangles stay sharp; at most 180; 0 selects 33
                           // or 70 by the shape; must be 0 with `flat`
    bool soft;             // replaces point lights by area lights, which cast soft shadows
} ClrtLoad;

// Reads a scene file (man 5 clrt-scene) or a mesh file, as `clrt` does. For mesh files other than
// PLY, the call starts clrt's program clrt-foreign. `load` may be NULL.
CLRT_API ClrtScene *clrt_scene_load(const char *path, const ClrtLoad *load, ClrtError *error);

// Returns a scene without objects, lights and views. It has a white background, an ambient light of
// 0.05 and the materials below.
CLRT_API ClrtScene *clrt_scene_create(ClrtError *error);

// Frees the scene. Accepts NULL.
CLRT_API void clrt_scene_free(ClrtScene *scene);

// The materials that every scene has. Added materials have higher numbers.
enum {
    CLRT_MATERIAL_SILHOUETTE,
    CLRT_MATERIAL_MATTE,
    CLRT_MATERIAL_BLINN_PHONG,
    CLRT_MATERIAL_MIRROR // matte, with a reflectivity of 0.25
};

typedef enum {
    CLRT_SHADING_SILHOUETTE,
    CLRT_SHADING_MATTE,
    CLRT_SHADING_BLINN_PHONG,
    CLRT_SHADING_GLASS
} ClrtShading;

// The visible color is (1 - reflectivity) * shaded + reflectivity * the reflected ray's color. For
// SILHOUETTE, `shaded` is `diffuse`. For MATTE, `shaded` is diffuse * (ambient + kd * D). D is the
// sum of intensity * color * cosine over the lights that reach the point. BLINN_PHONG adds specular
// * ks * S. S is the sum of intensity * color * (normal . half vector) ^ shininess over these
// lights. `shaded` is limited to 1. GLASS refracts and reflects rays. It uses only `ior` and
// `diffuse`, which is the color of refracted light.
//
// If `check_size` is above 0, space is divided into cubes of this size, and the colors `even` and
// `odd` of the cubes replace `diffuse`. Even and odd cubes alternate along each axis. A point of a
// triangle shows the color of the cube behind the triangle. A point of a sphere shows the color of
// the cube just inside the sphere. Solids therefore look as if they were cut out of a block of
// cubes.
typedef struct {
    size_t size;
    ClrtShading shading;
    double diffuse[3], specular[3]; // R G B in [0, 1]
    double kd, ks;                  // in [0, 1000]
    double shininess;               // in [0, 1e9]
    double reflectivity;            // in [0, 1]
    double check_size;              // in scene units; 0, or in [1e-30, 1e30]; rounded to float
    double even[3], odd[3]; // R G B in [0, 1]; the cube from 0 to check_size on every axis is even
    double ior;             // of GLASS: index of refraction, inside over outside, in [0.1, 10]
} ClrtMaterial;

// Adds a material and stores its number in *number.
CLRT_API bool clrt_scene_add_material(ClrtScene *scene, const ClrtMaterial *material,
                                      uint32_t *number, ClrtError *error);

// Adds a sphere. Its coordinates are at most 1e30 in magnitude, and its radius is in [1e-30, 1e30].
CLRT_API bool clrt_scene_add_sphere(ClrtScene *scene, const double center[3], double radius,
                                    uint32_t material, ClrtError *error);

// A triangle mesh. The corners of a triangle are in counter-clockwise order, seen from the front.
// clrt drops triangles that have two corners at one position.
typedef struct {
    size_t size;
    const double *positions;   // X Y Z per vertex, each number below 1e30 in magnitude
    const float *normals;      // X Y Z per vertex, of any length; 0 0 0: missing; may be NULL
    const uint32_t *triangles; // three vertex indices per triangle, counted from 0
    size_t vertex_count, triangle_count; // each at most 2147483647
    uint32_t material;
    bool two_sided;        // also visible from behind
    bool flat;             // ignores `normals`; must be false with `smooth`
    bool smooth;           // computes missing normals, like `normals smooth` in scene files
    double crease_degrees; // larger angles between triangles stay sharp; in [0, 180]; 0 means 33;
                           // must be 0 without `smooth`
    const float *colors;   // R G B per vertex, in [0, 1]; replaces diffuse colors; may be NULL
} ClrtMesh;

CLRT_API bool clrt_scene_add_mesh(ClrtScene *scene, const ClrtMesh *mesh, ClrtError *error);

// Adds a white point light. Its intensity is in [0, 1e30] and does not decrease with distance.
CLRT_API bool clrt_scene_add_light(ClrtScene *scene, const double position[3], double intensity,
                                   ClrtError *error);

// Adds a point light with a color, each component in [0, 1].
CLRT_API bool clrt_scene_add_colored_light(ClrtScene *scene, const double position[3],
                                           double intensity, const double color[3],
                                           ClrtError *error);

// Adds a light that is infinitely far away. `direction` points toward the light and must not be
// zero. Its length has no effect. The other arguments are as in clrt_scene_add_colored_light.
CLRT_API bool clrt_scene_add_sun(ClrtScene *scene, const double direction[3], double intensity,
                                 const double color[3], ClrtError *error);

// A parallelogram that emits light. It is divided into `cells` x `cells` equal cells, and each cell
// contains one point light.
typedef struct {
    size_t size;
    double position[3]; // of the center
    double side_u[3], side_v[3];
    uint32_t cells;   // along each side, in [1, 16]
    double intensity; // the sum over all point lights, in [0, 1e30]
    double color[3];
} ClrtAreaLight;

// Adds the point lights of an area light.
CLRT_API bool clrt_scene_add_area_light(ClrtScene *scene, const ClrtAreaLight *light,
                                        ClrtError *error);

typedef struct {
    size_t size;
    double eye[3], look_at[3];
    double up[3];         // 0 0 0 selects 0 0 1
    double fov_degrees;   // vertical, in [1e-6, 179.9999]
    double width_degrees; // the least horizontal angle, for narrow pictures; in [0, 179.9999]
    // If `height` is above 0, the camera is orthographic and ignores both angles.
    double height; // of the visible rectangle, in scene units; 0, or in [1e-30, 1e30]
    double width;  // the rectangle's least width, for narrow pictures; 0 for no minimum
} ClrtCamera;

// Adds a camera as the scene's last view.
CLRT_API bool clrt_scene_add_camera(ClrtScene *scene, const ClrtCamera *camera, ClrtError *error);

// Stores a view of the scene in *camera. Views are numbered from 1.
CLRT_API bool clrt_scene_get_camera(const ClrtScene *scene, uint32_t view, ClrtCamera *camera,
                                    ClrtError *error);

// Sets the color of rays that hit nothing: R G B in [0, 1].
CLRT_API bool clrt_scene_set_background(ClrtScene *scene, const double color[3], ClrtError *error);

// Sets the ambient light, in [0, 1].
CLRT_API bool clrt_scene_set_ambient(ClrtScene *scene, double intensity, ClrtError *error);

typedef struct {
    size_t size;
    uint32_t width, height; // from the scene file; otherwise 512
    uint32_t max_level;     // from the scene file; otherwise 3
    uint32_t view_count;
    uint32_t light_count, material_count, sphere_count;
    uint64_t triangle_count;
    uint64_t dropped_triangle_count; // triangles with two corners at one position
} ClrtSceneInfo;

// Stores facts about the scene in *info.
CLRT_API bool clrt_scene_get_info(const ClrtScene *scene, ClrtSceneInfo *info, ClrtError *error);

// Devices

typedef struct {
    size_t size;
    char device[32]; // a value of ClrtSettings::device: PLATFORM:DEVICE, such as "0:0"
    char type[16];   // cpu, gpu, accelerator or other
    char platform[256], name[256]; // as the driver reports them
    char driver[256];              // the driver's version
    uint32_t compute_units;
    uint64_t largest_allocation; // bytes
    bool fp64;                   // supports double arithmetic
    bool correctly_rounded;      // can round division and square root correctly
    bool denormals;              // does not round floats below 2^-126 to zero
    bool fma;                    // calculates fma in hardware
} ClrtDevice;

// Stores the number of OpenCL devices, at most 64, in *count. Fails if there are none.
CLRT_API bool clrt_device_count(uint32_t *count, ClrtError *error);

// Stores facts about a device in *device. Devices are numbered from 0.
CLRT_API bool clrt_device_get(uint32_t number, ClrtDevice *device, ClrtError *error);

// Renderers

typedef struct ClrtRenderer ClrtRenderer;

typedef enum { CLRT_FP32, CLRT_FP64 } ClrtPrecision;
typedef enum {
    CLRT_KERNEL_AUTO,
    CLRT_KERNEL_PAIR,  // single rays through nodes of two children
    CLRT_KERNEL_WIDE,  // single rays through nodes of eight children
    CLRT_KERNEL_PACKET // packets of rays through nodes of eight children
} ClrtKernel;
typedef enum {
    CLRT_SPECIALIZE_AUTO, // specializes if the kernel is compiled already, or if this saves more
                          // time than compiling takes
    CLRT_SPECIALIZE_ALWAYS,
    CLRT_SPECIALIZE_NEVER
} ClrtSpecialize;
typedef enum {
    CLRT_TREE_AUTO, // the surface area heuristic, unless the scene is faster without a tree
    CLRT_TREE_SAH,
    CLRT_TREE_MIDPOINT,
    CLRT_TREE_NONE
} ClrtTree;

typedef struct {
    size_t size;
    // PLATFORM:DEVICE, a type (cpu, gpu, accelerator, all) or part of a name, as for `clrt
    // --device`. NULL selects the first GPU or, without a GPU, the first device.
    const char *device;
    uint32_t threads; // of the host, for trees, refining and converting rays; 0: as many as the
                      // process may use
    ClrtPrecision precision; // error goals below 1.6e-4 require CLRT_FP64

    // The following settings are for experiments and change no bit of a picture.
    ClrtKernel kernel;
    uint32_t lanes; // vector width of CLRT_KERNEL_WIDE or _PACKET: 4, 8 or 16; 0: by the device
    ClrtSpecialize specialize;
    ClrtTree tree;
    uint32_t group_width, group_height; // of work-groups, at most 1024; 0: by the device
} ClrtSettings;

// Opens an OpenCL device. The first call that needs a kernel compiles the kernel. Compiling takes
// seconds, unless the kernel is cached. `settings` may be NULL.
//
// On a CPU device, the driver chooses the number of threads that draw. To limit PoCL's threads, a
// program sets the environment variable POCL_MAX_PTHREAD_COUNT (POCL_CPU_MAX_CU_COUNT in newer
// versions of PoCL) before the first OpenCL call. If a program sets POCL_WORK_GROUP_SPECIALIZATION
// to 0 before this call, kernels compile in three quarters of the time, and the program clrt can
// share them.
//
// clrt_renderer_create, clrt_device_count and clrt_device_get read environment variables, and PoCL
// sets some during the first of these calls. During these calls, other threads must not use the
// environment, because most versions of getenv and setenv are not thread-safe. All other calls only
// read the environment, and only to compile or store kernels.
//
// The library stores compiled kernels with checksums in the first of $POCL_CACHE_DIR/clrt,
// $XDG_CACHE_HOME/clrt and ~/.cache/clrt that exists or can be created. It compiles damaged kernels
// again. PoCL stores its own files in $POCL_CACHE_DIR, $XDG_CACHE_HOME/pocl or ~/.cache/pocl. If
// PoCL cannot write its files, it finds no device. Processes that share PoCL's files compile one at
// a time.
CLRT_API ClrtRenderer *clrt_renderer_create(const ClrtSettings *settings, ClrtError *error);

// Stores the renderer's new kernels in the cache, which takes up to a second, and frees the
// renderer. Accepts NULL.
CLRT_API void clrt_renderer_free(ClrtRenderer *renderer);

// Pictures

// A callback that runs in the caller's thread after each finished tile of a picture and after each
// finished part of a batch of rays. It returns whether to continue. It must not free the renderer
// or use the renderer for another call. Channels and passes toward a goal may count their own
// tiles, so `tiles_done` may start again from 1.
typedef bool ClrtProgress(void *user, uint64_t tiles_done, uint64_t tiles);

// A channel: for each pixel, values other than its color. Later versions will not extend this
// struct.
typedef struct {
    const char *name; // see clrt_channel_get
    void *values;     // receives ClrtChannelInfo::components floats or uint32_t per pixel
} ClrtChannel;

typedef struct {
    size_t size;
    char name[16];       // as in `clrt --aov`
    uint32_t components; // values per pixel
    bool is_integer;     // values are uint32_t; otherwise float
    char help[192];      // the meaning of the values
} ClrtChannelInfo;

// clrt_channel_count returns the number of kinds of channels. clrt_channel_get stores facts about
// one kind. Kinds are numbered from 0.
CLRT_API uint32_t clrt_channel_count(void);
CLRT_API bool clrt_channel_get(uint32_t number, ClrtChannelInfo *info, ClrtError *error);

// Facts about a drawn picture. The counts of samples, rays and tests exclude the work for channels.
typedef struct {
    size_t size;
    uint32_t width, height; // of the picture or its crop
    uint32_t samples;       // N of the N x N samples per pixel; 1 with a goal
    uint32_t max_level;     // rays of this level see only the background
    double truncation;      // bound on the error that max_level causes in any color; with glass,
                            // bound on the RMSE that max_level causes
    bool goal_missed;       // the error may be above the goal, or the first pass took longer than
                            // ClrtPicture::seconds
    double error, error_bound; // of error and time goals: the estimated RMSE, and its upper bound
                               // with 95 % confidence
    uint64_t sample_count;     // samples taken
    double smallest_feature;   // in pixels: a disk of this diameter at a random place contains a
                               // sample with a probability of 95 %
    // Numbers of pixels with the values 0, 0.5 and 1 in the channel certainty.
    uint64_t pixels_open, pixels_repaired, pixels_certified;
    double seconds; // for the colors and channels, including the time to compile their kernels
    bool cached;    // an earlier process compiled the kernel of the colors

    // The following counts are zero without ClrtPicture::statistics.
    uint64_t camera_rays, shadow_rays, reflected_rays, camera_hits, shaded_points;
    uint64_t triangle_tests, box_tests, sphere_tests;
} ClrtResult;

// With this max_level, even camera rays see only the background.
enum { CLRT_LEVEL_NONE = -1 };

// A request for a picture. If only `size` is set, clrt draws the scene's first view as `clrt SCENE
// -o FILE` does. At most one of `contrast`, `error` and `seconds` may be above 0. The one above 0
// is the picture's goal. A goal decides where to take samples, so it excludes `samples`, a crop, a
// tile size and the channels boxtests, tritests and certainty.
typedef struct {
    size_t size;
    uint32_t width, height;                      // in pixels, each at most 131072; 0: the scene's
    uint32_t left, top, crop_width, crop_height; // draws only this crop; 0, 0, 0, 0: all
    uint32_t view;                               // views are numbered from 1; 0 selects view 1
    const ClrtCamera *camera;                    // replaces `view`; may be NULL
    double turn_degrees;                         // turns the eye as --turntable does

    uint32_t samples; // N of N x N samples per pixel; at most 64; 0: 3 (mesh files) or 1
    double contrast;  // adds samples where neighbors differ by more than this; at most 1
    double error;     // adds samples until the RMSE is at most this; at most 1; values below 1.6e-4
                      // require a renderer with CLRT_FP64
    double seconds;   // adds samples for this many seconds; at most 1e6
    int32_t max_level; // rays of this level see the background; CLRT_LEVEL_NONE, or at most 1000;
                       // 0: `truncation` or `error` selects it; if both are 0, the scene's
    double truncation; // above 0: selects the smallest max_level whose error is at most this; in
                       // scenes with glass, the error is measured in a coarse picture of the whole
                       // frame, and a truncation below 2^-22 selects level 16
    uint32_t reference_samples; // per pixel, of clrt_reference; even, at most 65536; 0 means 256

    uint32_t tile_width, tile_height; // unit of `progress`, in pixels; changes no bit; 0: 128
    bool statistics;                  // counts rays and tests
    ClrtProgress *progress;           // may be NULL
    void *user;                       // passed to progress

    // Outputs other than the colors.
    const ClrtChannel *channels; // channel_count elements with different names
    uint32_t channel_count;
    ClrtResult *result; // receives facts about the picture; may be NULL
} ClrtPicture;

// Draws the scene into `rgb`, an array of 3 * width * height floats: R G B in [0, 1], top row
// first. With a crop, these are the width and height of the crop. If the channel certainty is
// requested, pixels that are certain in fp64, but not in float, get the colors of fp64. The first
// picture of a new or changed scene also builds the scene's tree, if clrt uses one. Later pictures
// reuse the tree, even with another size or camera.
//
// Returns false with CLRT_STOPPED if `progress` stops the picture before the last tile. If the
// picture is stopped or the device fails, `rgb` contains the complete tiles, and all other pixels
// are unchanged. With a goal, `rgb` is then undefined.
CLRT_API bool clrt_render(ClrtRenderer *renderer, const ClrtScene *scene,
                          const ClrtPicture *picture, float *rgb, ClrtError *error);

// Draws the reference of a picture: the same picture with picture->reference_samples samples per
// pixel, the accuracy of fp64 and at least the scene's max_level. Stores the reference's own
// estimated RMSE in picture->result->error. The request must have no channels.
CLRT_API bool clrt_reference(ClrtRenderer *renderer, const ClrtScene *scene,
                             const ClrtPicture *picture, float *rgb, ClrtError *error);

// Stores the hash that `clrt --hash` prints: 32 hexadecimal digits and a terminating zero. The hash
// identifies the picture's size and exact bits.
CLRT_API void clrt_hash(const float *rgb, uint32_t width, uint32_t height, char hash[33]);

// Rays

// Stands for no primitive, no mesh or no triangle.
#define CLRT_NOTHING 0xffffffffu

// Rays origin + t * direction. A ray hits primitives at t in [near, far]. It hits triangles from
// both sides, unless `one_sided` is set. A ray hits nothing if its origin, direction or near is not
// finite, or if its far is NaN. It also hits nothing if all components of its direction are below
// 1e-300 in magnitude, or if their magnitudes add up to more than 1e300.
//
// `starts` contains the primitive on which each ray starts. The ray does not hit this primitive
// again. The only exception is a ray with near 0 that hits its sphere from inside. If near is 0 and
// the primitive is a triangle, clrt moves the origin onto the triangle's plane. The ray then does
// not hit neighbors of the triangle that only rounding places ahead of the origin. The call fails
// if the origin is farther than 2^-15 from the plane, in the units that clrt_trace describes.
typedef struct {
    size_t size;
    size_t count;
    const double *origins;                  // X Y Z per ray
    const double *directions;               // X Y Z per ray; NULL means 0 0 1 for all
    size_t origin_stride, direction_stride; // bytes from one ray to the next; 0 means 24
    const double *nears, *fars;             // one per ray; NULL means 0 and INFINITY
    const uint32_t *starts; // ids as in ClrtHits::primitives, or CLRT_NOTHING; may be NULL
    bool one_sided;         // rays pass through the backs of triangles that are not two_sided
    ClrtProgress *progress; // counts parts of up to 65536 rays; may be NULL
    void *user;             // passed to progress
} ClrtRays;

// Arrays for the results, with one entry per ray unless stated otherwise. NULL omits a result. A
// failed call may have stored the results of some rays.
typedef struct {
    size_t size;
    double *distances;    // t of the hit; INFINITY: no hit
    uint32_t *primitives; // ids: first all spheres, then all triangles; CLRT_NOTHING: no hit
    uint32_t *meshes;     // numbers of the meshes, counted from 0; CLRT_NOTHING: sphere or no hit
    uint32_t *triangles;  // numbers in the meshes, counted from 0; CLRT_NOTHING: sphere or no hit
    double *weights; // two per ray: the barycentric coordinates of the triangle's second and third
                     // corner; 0 0: sphere or no hit
    double *normals; // unit normal of the front side: X Y Z per ray; 0 0 0: no hit
    uint8_t *fronts; // 1 if the ray hits the front side, which is a sphere's outside; otherwise 0

    // Only for clrt_trace_all.
    uint32_t *counts; // number of crossings, which may exceed `room`
    size_t room;      // entries per ray in the arrays above `counts`, at most 1048576

    // Only for clrt_trace, on devices with doubles.
    uint8_t *certain; // 1 if rounding cannot have changed which primitive is hit, or that none is;
                      // otherwise 0
} ClrtHits;

// Finds each ray's nearest hit. At equal distances, the primitive with the lowest id is hit, so the
// order of triangles can change the primitive, but not the distance. The distances of triangles
// that overlap in one plane may differ by rounding, unless their corners are equal. A ray's results
// depend only on the ray and the scene, and not on the batch, the threads or the device. A ray
// through an edge or vertex of a closed mesh hits the mesh. A ray misses a triangle if the ray
// starts so close to the triangle that rounding could move the start to the other side.
//
// These statements hold exactly for the coordinates that clrt traces. clrt centers the scene in
// double precision, scales it by a power of two so that the longest side of the box around all
// triangles is in [1, 2), and rounds coordinates to float. Without triangles, the box contains the
// spheres. The origin first moves to the ray's point at near. If the origin then has a coordinate
// above 4 in magnitude, it moves along the ray toward the box. In scenes with spheres, the limit is
// about 4 times the scene's largest coordinate, but at least 4.
//
// In traced coordinates, let r be the distance from the moved origin to the triangle's farthest
// corner. Rounding moves each corner by at most 6 * 2^-24 r per axis. The distance to the moved
// triangle is off by at most 18 * 2^-24 r, measured along the axis of the direction's largest
// component. The hit point is therefore close to the stored triangle. However, if the ray is almost
// parallel to the triangle, the hit's distance can be off by up to the triangle's length along the
// ray. A hit on a sphere is off along the ray by at most 2^-18 of the sum of four lengths: the ray
// up to the hit, the radius, and the distances of the moved origin and of the sphere's center from
// the point 0 0 0. In tests, the relative error of distances to spheres is at most 3e-7.
//
// If a ray's `certain` is 1, exact arithmetic finds the same primitive or no hit, both for the
// caller's ray in doubles and for the traced ray in floats. Rays through edges, and rays with hits
// at almost equal distances, are uncertain.
CLRT_API bool clrt_trace(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                         const ClrtHits *hits, ClrtError *error);

// Finds all points where a ray crosses a triangle or a sphere, and stores the nearest hits->room of
// them, ordered by distance and then by id. The results of ray i start at entry i * room. Unused
// entries have the values for no hit. A ray that enters or leaves a closed mesh through an edge or
// vertex crosses an odd number of triangles there, usually one. If the ray only touches the mesh,
// it crosses an even number. A ray that starts at a point of a triangle crosses the triangle,
// unless `starts` contains the triangle. A ray crosses a sphere twice, where it enters and where it
// leaves. If a ray with near 0 starts on a sphere by `starts`, the ray crosses only the sphere's
// far wall.
CLRT_API bool clrt_trace_all(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                             const ClrtHits *hits, ClrtError *error);

// Stores 1 in inside[i] if the origin of ray i is inside the meshes and spheres, otherwise 0. An
// origin is inside if its ray crosses an odd number of surfaces. A point of a sphere inside a mesh
// therefore counts as outside. The meshes must be closed. The call does not check whether they are,
// but clrt_check does. The direction has no effect, unless the origin is so close to a surface that
// rounding decides. NULL directions are fastest. A failed call may have stored some results.
CLRT_API bool clrt_contains(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                            uint8_t *inside, ClrtError *error);

// Stores 1 in occluded[i] if clrt_trace would find a hit for ray i, otherwise 0. A failed call may
// have stored some results.
CLRT_API bool clrt_occluded(ClrtRenderer *renderer, const ClrtScene *scene, const ClrtRays *rays,
                            uint8_t *occluded, ClrtError *error);

// Checks

// The facts about a scene's geometry that `clrt check` reports.
typedef struct ClrtCheck ClrtCheck;

// Examines the meshes of the scene, and casts rays at their edges and vertices to find leaks.
CLRT_API ClrtCheck *clrt_check(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error);

// Frees the check. Accepts NULL.
CLRT_API void clrt_check_free(ClrtCheck *check);

typedef struct {
    size_t size;
    bool fine; // no finding is a fault
    uint32_t mesh_count, finding_count;
} ClrtCheckInfo;

typedef struct {
    size_t size;
    char path[1024]; // of the mesh's file; empty without one
    bool closed; // each edge has two consistently oriented triangles; no parts meet only at a point
    bool inside_out; // the mesh is closed, and the fronts of its triangles face inwards
    uint64_t triangle_count, vertex_count, edge_count;
    uint64_t unused_vertices;            // that no triangle uses
    uint64_t repeated_vertices;          // used, but at the position of an earlier vertex
    double shortest_edge, lowest_height; // of all triangles, in scene units
    double shortest_steps, lowest_steps; // both lengths in steps between traced floats
    // Aims are places at edges and vertices at which clrt_check casts rays.
    uint64_t aim_count, aimed_at, ray_count; // all aims; aims with a ray; all rays
    uint64_t hidden, leaks; // aims behind other triangles; rays that passed through the mesh
} ClrtCheckedMesh;

typedef struct {
    size_t size;
    char kind[32];  // as in `clrt check --json`
    bool fails;     // the finding is a fault; other findings may be intended
    uint32_t mesh;  // number of the mesh; CLRT_NOTHING: the whole scene
    uint64_t count; // number of occurrences; 1 for advice
    uint64_t first; // number of the first triangle or vertex with a fault; otherwise 0
    char text[320]; // one message without a final period
} ClrtFinding;

// These functions store the facts about the check, about a mesh, and about a finding. Meshes and
// findings are numbered from 0.
CLRT_API bool clrt_check_get_info(const ClrtCheck *check, ClrtCheckInfo *info, ClrtError *error);
CLRT_API bool clrt_check_get_mesh(const ClrtCheck *check, uint32_t number, ClrtCheckedMesh *mesh,
                                  ClrtError *error);
CLRT_API bool clrt_check_get_finding(const ClrtCheck *check, uint32_t number, ClrtFinding *finding,
                                     ClrtError *error);

// Explanations

// The computation of a pixel's color: the samples, the rays of each sample, and the lights at each
// hit point.
typedef struct ClrtExplanation ClrtExplanation;

// Explains a pixel of the picture that clrt_render draws: column pixel[0] and row pixel[1], both
// counted from 0. `picture` must have no goal and no crop. Its channels are ignored.
CLRT_API ClrtExplanation *clrt_explain(ClrtRenderer *renderer, const ClrtScene *scene,
                                       const ClrtPicture *picture, const uint32_t pixel[2],
                                       ClrtError *error);

// Frees the explanation. Accepts NULL.
CLRT_API void clrt_explanation_free(ClrtExplanation *explanation);

typedef struct {
    size_t size;
    float color[3]; // the pixel's color in clrt_render
    uint32_t sample_count;
} ClrtExplainedPixel;

// A sample's color is a sum, limited to 1 and rounded to multiples of 2^-32. The sum adds share *
// (tint * shaded) for each ray, in the order of the rays, and then background_weight * background.
// The operations have the precision of the kernels.
typedef struct {
    size_t size;
    double color[3];
    double background_weight; // 0 in scenes with glass, whose rays add the background
    uint32_t ray_count;       // the camera ray and all rays that follow from it
} ClrtExplainedSample;

// A ray of a sample. A ray that hits glass can split into a refracted and a reflected ray. The
// refracted ray and all rays that follow from it come before the reflected ray.
typedef struct {
    size_t size;
    double origin[3], direction[3]; // direction has length 1
    double weight;                  // of the ray's color in the sample's color
    uint32_t primitive;             // id of the hit, or CLRT_NOTHING
    uint32_t material; // this member and the next ones, up to `normal`, are 0 without a hit
    double distance, distance_error; // distance_error bounds the error of `distance`
    double point[3], normal[3];
    double share;         // weight of `shaded` in the sample's color
    double shaded[3];     // the surface's color without reflections; without a hit, the background
    uint32_t light_count; // all lights of the scene, in order; 0 for silhouettes, for glass and
                          // without a hit
    double tint[3];       // the color of the glass on the path; multiplies `weight` and `share`
    uint32_t level;       // 0 for the camera ray
    bool is_refracted;
    bool is_cut; // its level is max_level, so it hits nothing
} ClrtExplainedRay;

typedef enum {
    CLRT_LIGHT_BEHIND,     // the surface's normal faces away from the light
    CLRT_LIGHT_REACHES,    // the point receives light
    CLRT_LIGHT_BLOCKED,    // a primitive is between the point and the light
    CLRT_LIGHT_BEHIND_FACE // the triangle faces away, although the shading normal does not
} ClrtLightState;

typedef struct {
    size_t size;
    ClrtLightState state;
    uint32_t blocker; // the primitive of CLRT_LIGHT_BLOCKED; otherwise CLRT_NOTHING
    double cosine;    // of the angle between the normal and the direction to the light
    double distance;  // INFINITY for a sun
    double blocker_distance;
    // Unless the light reaches the point, the next two are 0 and `tint` is 1 1 1.
    double diffuse;  // intensity * cosine
    double specular; // intensity * (normal . half vector) ^ shininess
    double tint[3];  // the color of the glass on the way; multiplies `diffuse` and `specular`
} ClrtExplainedLight;

// Each function stores a part of the explanation. `place` is the number of a sample, the numbers
// {sample, ray} of a ray, or the numbers {sample, ray, light} of a light. All numbers start at 0.
CLRT_API bool clrt_explanation_get_pixel(const ClrtExplanation *explanation,
                                         ClrtExplainedPixel *pixel, ClrtError *error);
CLRT_API bool clrt_explanation_get_sample(const ClrtExplanation *explanation, uint32_t place,
                                          ClrtExplainedSample *sample, ClrtError *error);
CLRT_API bool clrt_explanation_get_ray(const ClrtExplanation *explanation, const uint32_t place[2],
                                       ClrtExplainedRay *ray, ClrtError *error);
CLRT_API bool clrt_explanation_get_light(const ClrtExplanation *explanation,
                                         const uint32_t place[3], ClrtExplainedLight *light,
                                         ClrtError *error);

#ifdef __cplusplus
}
#endif
