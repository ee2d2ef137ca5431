// SPDX-License-Identifier: MIT
// A session computes results from a Scene on a device. It holds the device, the kernels made for
// the device, and the scene in each layout that a kernel needs. The program, the window and the
// library use sessions for pictures, channels, references, explanations and rays.
//
// A session makes kernels and layouts at their first use and then keeps them. Only one thread at a
// time may use a session.
//
// Invariant: the settings change no bit of a picture. The exceptions are the precision, other
// sources of kernels, and extra options for the compiler.
#pragma once

#include "accel/scene_compile.h"
#include "device/cache_private.h"
#include "library/clrt.h"
#include "mesh/mesh_pieces.h"
#include "render/renderer.h"

typedef struct {
    ClrtSettings wanted;       // wanted.size is not used
    const char *kernel_folder; // replaces the embedded kernels; may be NULL
    const char *extra_options; // for the kernels' compiler; may be NULL
} SessionSettings;

// A scene in one layout of nodes.
typedef struct {
    FlatScene flat;
    SceneBuffers buffers; // empty until a renderer needs them
    CompileStages stages; // SessionScene::forms keep only the counts of the tree
} SceneForm;

typedef struct {
    const Scene *scene; // borrowed
    Normalization normalization;
    const CompileStages *stages;      // borrowed; NULL: the session makes them for each form
    ARRAY(MeshPieces) pieces;         // of each object; empty until needed
    SceneForm forms[NODE_LAYOUTS][2]; // [0]: without a tree, [1]: with a tree; empty until needed
} SessionScene;

// Callers fill `settings` and open `cache`. The other members belong to the session.
typedef struct {
    SessionSettings settings;
    Cache cache;
    Device device;
    double device_seconds; // time to open the device
    KernelChoice choice;
    bool is_quick; // `choice` compiles faster than the device's usual kernels
    KernelSet kernels;
    SessionScene scene;
    Error error; // set if opening the device failed
    pthread_t thread;
    bool is_open, is_running;
} Session;

// Starts a thread that opens the device. Until session_await returns, the caller may call only
// session_scene_take, session_save and session_close.
void session_begin(Session *session);

// The work of a run, by which the session chooses kernels.
typedef struct {
    const KernelEntry *entry; // the kernel that draws
    double samples;
    double seconds; // time limit of the run; 0 for none
    bool counts;    // the run counts rays and tests, which requires the device's usual kernels
} SessionWork;

// Waits for the device and chooses the kernels. If `work` is NULL, the choice depends only on the
// settings and the device.
bool session_await(Session *session, const SessionWork *work, Error *error);

// Opens the device on the caller's thread.
bool session_open(Session *session, Error *error);

// Waits for the thread of session_begin, and saves new kernels to the cache. Returns false if a
// kernel could not be saved.
bool session_save(Session *session);

// Saves new kernels and releases everything except the cache.
void session_close(Session *session);

// Sets the scene, which must exist until the next session_scene_take or session_close. Fails if the
// scene's coordinates differ too much in size.
bool session_scene_take(Session *session, const Scene *scene, Error *error);

// Releases the forms of a scene, and empties *scene.
void session_scene_free(SessionScene *scene);

// Returns whether the scene needs a tree in this layout. The result is false only if wanted.tree is
// CLRT_TREE_AUTO and the scene is traced faster without a tree.
bool session_scene_wants_tree(const Session *session, NodeLayout layout);

// Compiles a scene into *form with the session's tree builder and threads (scene_compile). *form
// must be {0}, and gets no buffers. If the call succeeds, the caller must free the form.
bool session_scene_compile(const Session *session, const FlatSource *source, SceneForm *form,
                           Error *error);
void scene_form_free(SceneForm *form);

// Returns the session's scene in this layout, or NULL on failure. The first call compiles the
// scene. The form has no tree if `has_tree` is false or session_scene_wants_tree returns false.
SceneForm *session_scene_form(Session *session, NodeLayout layout, bool has_tree, Error *error);

// Finds the pieces of all objects, unless an earlier call has found them.
bool session_scene_find_pieces(Session *session, Error *error);

BvhBuilder session_scene_builder(const ClrtSettings *settings);

// Returns the session's scene in the layout of session->choice, or NULL on failure.
SceneForm *session_scene_own_form(Session *session, Error *error);

typedef struct {
    const KernelEntry *entry;
    const KernelChoice *choice; // NULL: Session::choice
    bool counts;                // counts rays and tests
    bool is_general;            // never specialized
} RendererUse;

// Returns the kernel for a scene with these traits, or NULL on failure.
const Kernel *session_kernel(Session *session, const RendererUse *use, const SceneTraits *traits,
                             Error *error);

// Makes a renderer for the session's scene. The renderer is valid until the next session_scene_take
// or session_close.
bool session_renderer(Session *session, const RendererUse *use, const RenderSettings *settings,
                      Renderer *renderer, Error *error);

// Returns the choice for kernels that compute certainty. They use double arithmetic on the scene's
// floats.
KernelChoice session_exact_choice(void);
