// SPDX-License-Identifier: MIT
// A device, its kernels, and a scene in the layouts of these kernels. The program, the window and
// the library draw by a session. A session works on one thread at a time.
#pragma once

#include "device/cache_private.h"
#include "render/renderer.h"
#include "session/geometry.h"

// The program that draws: general, or specialized for this scene. Both draw the same picture.
typedef enum {
    SPECIALIZE_AUTO, // specialized if compiled already, or if it saves more than compiling takes
    SPECIALIZE_ALWAYS,
    SPECIALIZE_NEVER
} Specialization;

// Whether rays find triangles with a tree.
typedef enum {
    TREE_AUTO, // unless testing all triangles is faster
    TREE_ALWAYS,
    TREE_NEVER
} TreeUse;

// How a session draws. No member changes a picture.
typedef struct {
    const char *device;        // for device_open
    uint32_t threads;          // on the host; 0: as many as the process may use
    const char *kernel_folder; // replaces the embedded kernels; may be NULL
    const char *extra_options; // for the kernels' compiler; may be NULL
    KernelRequest kernel;
    Specialization specialization;
    BvhBuilder builder;
    TreeUse tree;
    uint32_t group_width, group_height; // of work-groups; 0: the kernels' default
} SessionSettings;

// A scene in one layout of nodes.
typedef struct {
    FlatScene flat;
    SceneBuffers buffers; // empty until a renderer needs them
    Bvh tree;             // only its counts
} SceneForm;

typedef struct {
    const Scene *scene; // borrowed
    Normalization normalization;
    const CompileStages *stages;      // borrowed; NULL: the session makes them for each form
    SceneForm forms[NODE_LAYOUTS][2]; // without and with a tree; empty until needed
} SessionScene;

// Callers fill settings and open the cache. The other members belong to the session.
typedef struct {
    SessionSettings settings;
    Cache cache;
    Device device;
    double device_seconds; // spent on opening the device
    KernelChoice choice;
    bool is_quick; // choice compiles faster than the device's usual kernels
    KernelSet kernels;
    SessionScene scene;
    Error error; // of opening the device
    pthread_t thread;
    bool is_open, is_running;
} Session;

// Starts a thread that opens the device. Until session_await returns, the caller may only use the
// scene.
void session_begin(Session *session);

// The work of all pictures, by which the session chooses kernels.
typedef struct {
    const KernelEntry *entry; // of the kernel that draws
    double samples;
    double seconds; // limit for all pictures; 0 for none
    bool counts;    // statistics must not depend on the cached kernels
} SessionWork;

// Waits for the device and chooses the kernels. Without work, the choice depends only on the
// device.
bool session_await(Session *session, const SessionWork *work, Error *error);

// Opens the device on the caller's thread.
bool session_open(Session *session, Error *error);

// Saves new kernels to the cache, and waits for the thread of session_begin.
void session_save(Session *session);

// Saves new kernels and releases everything except the cache.
void session_close(Session *session);

// Sets the scene. It must exist until the next session_take or session_close. Fails if the scene's
// coordinates differ too much in size.
bool session_take(Session *session, const Scene *scene, Error *error);

// Releases the compiled forms of a scene.
void session_scene_free(SessionScene *scene);

// Returns whether a tree pays for the session's scene in this layout.
bool session_wants_tree(const Session *session, NodeLayout layout);

// Returns the scene in a layout of nodes, compiled once, or NULL. The tree is left out if
// has_tree is false, or if the settings or the number of triangles say so.
SceneForm *session_form(Session *session, NodeLayout layout, bool has_tree, Error *error);

// Returns the settings for trees that suit the session's kernels.
BvhSettings session_tree(const Session *session);

// Returns the scene in the layout of session->choice, or NULL.
SceneForm *session_own_form(Session *session, Error *error);

// The kernel of a renderer.
typedef struct {
    const KernelEntry *entry;
    const KernelChoice *choice; // NULL: the session's
    bool counts;                // rays and tests
    bool is_general;            // never specialized
} RendererUse;

// Returns the kernel for a scene with these traits, or NULL.
const Kernel *session_kernel(Session *session, const RendererUse *use, const SceneTraits *traits,
                             Error *error);

// Makes a renderer for the session's scene. It is valid while the session has the scene.
bool session_renderer(Session *session, const RendererUse *use, const RenderSettings *settings,
                      Renderer *renderer, Error *error);

// Returns the kernels that draw the reference: the same float scene in double arithmetic.
KernelChoice session_exact_choice(void);
