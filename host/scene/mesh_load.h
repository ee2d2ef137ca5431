// SPDX-License-Identifier: MIT
// A mesh file -> objects of a scene. A lone mesh file -> a whole scene (mesh_scene.c).
#pragma once

#include "base/file.h"
#include "mesh/normals.h"
#include "mesh/ply.h"
#include "scene/scene.h"

typedef enum {
    NORMALS_AUTO,  // as NORMALS_SMOOTH with CREASE_BY_SHAPE
    NORMALS_FLAT,  // ignore the file's normals
    NORMALS_SMOOTH // compute the normals that the file lacks
} Normals;

// The options of scn_load. {0} suits most callers. Scene text sets up axes and normals by
// statements. For scene text, scn_load therefore fails unless `up` and `normals` are 0.
typedef struct {
    bool is_tolerant;      // reads PLY meshes with ply_parse_tolerantly
    UpAxis up;             // of a lone mesh file
    Normals normals;       // of a lone mesh file
    double crease_degrees; // an angle or CREASE_BY_SHAPE; used only with NORMALS_SMOOTH
} SceneLoadOptions;

#define NO_CREASE (-2)

// The outputs of clrt-foreign for the files of a scene, kept so that each file is read once. If all
// outputs together would exceed FOREIGN_KEPT_MOST bytes, the file is read again by each statement.
#define FOREIGN_KEPT_MOST ((size_t)256 << 20)
typedef struct {
    char *path;
    File stream;
} ForeignFile;
typedef struct {
    ARRAY(ForeignFile) files;
    size_t size;
} ForeignFiles;

void foreign_files_free(ForeignFiles *files);

// Options for loading a file.
typedef struct {
    MeshObject object;        // properties of the file's objects, without meshes
    bool is_flat;             // ignores the file's normals
    double crease_degrees;    // for computing missing normals, or CREASE_BY_SHAPE; NO_CREASE leaves
                              // them missing
    bool takes_own_materials; // the file's materials replace the object's, if the file has any;
                              // false also ignores the file's colors
    uint32_t colored_material; // replaces the object's material for meshes that have colors
    bool is_plain_ply;         // PLY only, without transforms
    PlyParse *parse;           // the reader of PLY files
    ForeignFiles *kept;        // files in other formats; borrowed; NULL keeps none
} MeshLoadOptions;

// Adds an object with the mesh of the file read from path, and adds the file to the inputs.
bool ply_mesh_add(Scene *scene, const File *file, const char *path, const MeshLoadOptions *options,
                  Error *error);

// Adds an object for each part of the file at path, and the file's materials if requested. Adds all
// files read to the inputs. On failure, returns false with a message that names the file.
bool foreign_mesh_add(Scene *scene, const char *path, const MeshLoadOptions *options, Error *error);

// Drops or computes the normals of the scene's objects from index `first` on. Meshes read by
// ply_parse_tolerantly keep their vertices, because clrt check reports the vertices of the file. On
// failure, returns false with a message that names the file.
bool mesh_load_normals(const Scene *scene, size_t first, const MeshLoadOptions *options,
                       Error *error);

// The scene of a lone mesh file has lights, a floor, and cameras that frame the mesh. The mesh is
// turned upright and is visible from both sides.

// Returns whether the bytes are a PLY file. All other bytes are read as scene text.
bool mesh_scene_is_mesh(const char *bytes, size_t size);

// Fills scene from a PLY file in memory. If ply is NULL, reads the file at path in another format,
// with the file's own materials. Adds the viewpoints three-quarter, front, right, back, left and
// top. z is up.
bool mesh_scene_load(Scene *scene, const File *ply, const char *path,
                     const SceneLoadOptions *options, Error *error);
