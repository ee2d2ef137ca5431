// SPDX-License-Identifier: MIT
// Walks Assimp's tree of nodes, multiplies their matrices in fp64, and sends the meshes in the
// coordinates of the whole file. Identity matrices are not applied, so that coordinates keep their
// bits. If a matrix mirrors, the order of corners is reversed, which preserves front faces.
#include "foreign/parts.h"

#include "base/limits.h"

#include <assimp/material.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// clrt takes a material's diffuse color, specular color and exponent. The functions below multiply
// the specular color by its strength. The receiver clamps the values.

static bool find_color(const struct aiMaterial *material, const char *key, float color[3])
{
    struct aiColor4D found;
    if (aiGetMaterialColor(material, key, 0, 0, &found) != aiReturn_SUCCESS)
        return false;
    color[0] = found.r;
    color[1] = found.g;
    color[2] = found.b;
    return true;
}

static float find_number(const struct aiMaterial *material, const char *key, float otherwise)
{
    float found;
    return aiGetMaterialFloatArray(material, key, 0, 0, &found, NULL) == aiReturn_SUCCESS
               ? found
               : otherwise;
}

static void find_name(const struct aiMaterial *material, char *name, size_t size)
{
    struct aiString found = {0};
    if (aiGetMaterialString(material, AI_MATKEY_NAME, &found) == aiReturn_SUCCESS)
        snprintf(name, size, "%.*s", (int)size - 1, found.data);
    else
        name[0] = '\0';
}

// Returns false for materials that Assimp's importers add by themselves. These materials have
// Assimp's default name, or they have no name and a diffuse color of 60 % gray or white.
static bool material_is_given(const struct aiMaterial *material)
{
    const float gray = 0.6f, white = 1;
    char name[sizeof((ForeignMaterial *)0)->name];
    float color[3] = {0, 0, 0};
    find_name(material, name, sizeof name);
    find_color(material, "$clr.diffuse", color);
    const bool is_even = color[0] == color[1] && color[1] == color[2];
    const bool is_plain = is_even && (color[0] == gray || color[0] == white);
    return strcmp(name, AI_DEFAULT_MATERIAL_NAME) != 0 && !(name[0] == '\0' && is_plain);
}

static ForeignMaterial material_taken(const struct aiMaterial *material)
{
    ForeignMaterial taken = {.diffuse = {1, 1, 1}};
    find_name(material, taken.name, sizeof taken.name);
    if (!find_color(material, "$clr.diffuse", taken.diffuse))
        find_color(material, "$clr.base", taken.diffuse);
    find_color(material, "$clr.specular", taken.specular);
    const float strength = find_number(material, "$mat.shinpercent", 1);
    for (int channel = 0; channel < 3; channel++)
        taken.specular[channel] *= strength;
    taken.shininess = find_number(material, "$mat.shininess", 0);
    return taken;
}

static bool material_is_textured(const struct aiMaterial *material)
{
    return aiGetMaterialTextureCount(material, aiTextureType_DIFFUSE) > 0 ||
           aiGetMaterialTextureCount(material, aiTextureType_BASE_COLOR) > 0;
}

typedef struct {
    double rows[3][4];
} Placement;

typedef struct {
    double columns[3][3]; // of the matrix that transforms normals
    bool is_identity, is_mirror;
} NormalMatrix;

typedef struct {
    FILE *stream;
    const struct aiScene *scene;
    bool keeps_normals;
    PartCounts *counts;
    uint32_t *numbers; // per material of the scene: 1 + its index among sent materials; 0 if unsent
    uint32_t sent_count;
    ForeignPart part; // the part being collected
    ARRAY(Triangle) triangles;
    size_t vertex_capacity, normal_capacity, color_capacity;
    Error *error;
} Sender;

static const Placement identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

static Placement placement_below(const Placement *parent, const struct aiMatrix4x4 *matrix)
{
    const double own[4][4] = {
        {(double)matrix->a1, (double)matrix->a2, (double)matrix->a3, (double)matrix->a4},
        {(double)matrix->b1, (double)matrix->b2, (double)matrix->b3, (double)matrix->b4},
        {(double)matrix->c1, (double)matrix->c2, (double)matrix->c3, (double)matrix->c4},
        {0, 0, 0, 1}};
    Placement product;
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) {
            double sum = column == 3 ? parent->rows[row][3] : 0;
            for (int i = 0; i < 3; i++)
                sum += parent->rows[row][i] * own[i][column];
            product.rows[row][column] = sum;
        }
    return product;
}

static Vec3 column_of(const Placement *placement, int column)
{
    return vec3(placement->rows[0][column], placement->rows[1][column], placement->rows[2][column]);
}

// Returns whether the placement changes no coordinates. Negative zeros count as zeros.
static bool is_identity(const Placement *placement)
{
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            if (placement->rows[row][column] != identity.rows[row][column])
                return false;
    return true;
}

// Returns the matrix of cofactors, negated if the placement mirrors. This matrix is a positive
// multiple of the inverse transpose.
static NormalMatrix normal_matrix_of(const Placement *placement)
{
    NormalMatrix normal_matrix = {.is_identity = is_identity(placement)};
    const Vec3 x = column_of(placement, 0), y = column_of(placement, 1),
               z = column_of(placement, 2);
    const Vec3 cofactors[3] = {vec3_cross(y, z), vec3_cross(z, x), vec3_cross(x, y)};
    const double determinant = vec3_dot(x, cofactors[0]);
    normal_matrix.is_mirror = determinant < 0;
    for (int column = 0; column < 3; column++) {
        const Vec3 c = vec3_scale(cofactors[column], normal_matrix.is_mirror ? -1 : 1);
        normal_matrix.columns[column][0] = c.x;
        normal_matrix.columns[column][1] = c.y;
        normal_matrix.columns[column][2] = c.z;
    }
    return normal_matrix;
}

static void place_vertices(const Sender *sender, const struct aiMesh *mesh,
                           const Placement *placement, bool stays)
{
    double(*positions)[3] = sender->part.mesh.positions + sender->part.mesh.vertex_count;
    for (size_t i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *v = &mesh->mVertices[i];
        const double given[3] = {(double)v->x, (double)v->y, (double)v->z};
        for (int row = 0; row < 3; row++) {
            const double *r = placement->rows[row];
            positions[i][row] =
                stays ? given[row] : r[0] * given[0] + r[1] * given[1] + r[2] * given[2] + r[3];
        }
    }
}

// Transforms a normal. Normalizing before and after the transform avoids overflow.
static void transform_normal(const struct aiVector3D *given, const NormalMatrix *normal_matrix,
                             float normal[3])
{
    const Vec3 unit = vec3_normalize(vec3((double)given->x, (double)given->y, (double)given->z));
    Vec3 turned = {0, 0, 0};
    const double parts[3] = {unit.x, unit.y, unit.z};
    for (int i = 0; i < 3; i++) {
        const double *c = normal_matrix->columns[i];
        turned = vec3_add(turned, vec3_scale(vec3_of_doubles(c), parts[i]));
    }
    turned = vec3_normalize(turned);
    vec3_store(normal, turned);
}

static void place_normals(const Sender *sender, const struct aiMesh *mesh,
                          const NormalMatrix *normal_matrix)
{
    float(*normals)[3] = sender->part.mesh.normals + sender->part.mesh.vertex_count;
    for (size_t i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *given = &mesh->mNormals[i];
        if (normal_matrix->is_identity || (given->x == 0 && given->y == 0 && given->z == 0)) {
            normals[i][0] = given->x;
            normals[i][1] = given->y;
            normals[i][2] = given->z;
        } else {
            transform_normal(given, normal_matrix, normals[i]);
        }
    }
}

static void copy_colors(const Sender *sender, const struct aiMesh *mesh)
{
    float(*colors)[3] = sender->part.mesh.colors + sender->part.mesh.vertex_count;
    for (size_t i = 0; i < mesh->mNumVertices; i++)
        memcpy(colors[i], &mesh->mColors[0][i], sizeof *colors); // without the alpha at the end
}

// Returns whether a face's corners are vertices of its mesh. Assimp does not always check this.
static bool is_within(const struct aiFace *face, size_t vertex_count)
{
    for (size_t corner = 0; corner < face->mNumIndices; corner++)
        if (face->mIndices[corner] >= vertex_count)
            return false;
    return true;
}

static bool add_triangles(Sender *sender, const struct aiMesh *mesh, bool is_mirror)
{
    const uint32_t base = (uint32_t)sender->part.mesh.vertex_count;
    for (size_t i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (face->mNumIndices != 3) {
            sender->counts->others++;
            continue;
        }
        if (!is_within(face, mesh->mNumVertices))
            return error_set(sender->error, "one of its faces refers to a missing vertex");
        if (!array_reserve(&sender->triangles.memory, &sender->triangles.capacity,
                           sender->triangles.count + 1, sizeof(Triangle), sender->error))
            return false;
        uint32_t *triangle = sender->triangles.data[sender->triangles.count++];
        triangle[0] = base + face->mIndices[0];
        triangle[1] = base + face->mIndices[is_mirror ? 2 : 1];
        triangle[2] = base + face->mIndices[is_mirror ? 1 : 2];
    }
    return true;
}

static bool send_part_so_far(Sender *sender)
{
    Mesh *mesh = &sender->part.mesh;
    mesh->triangles = sender->triangles.data;
    mesh->triangle_count = sender->triangles.count;
    sender->counts->triangles += mesh->triangle_count;
    if (mesh->triangle_count > 0)
        send_part(sender->stream, &sender->part);
    mesh_free(mesh);
    sender->triangles.memory = NULL;
    sender->triangles.count = sender->triangles.capacity = 0;
    sender->vertex_capacity = sender->normal_capacity = sender->color_capacity = 0;
    return ferror(sender->stream) == 0 ||
           error_set(sender->error, "the receiver has closed the stream");
}

static uint32_t number_of_material(Sender *sender, const struct aiMesh *mesh)
{
    if (mesh->mMaterialIndex >= sender->scene->mNumMaterials)
        return FOREIGN_NO_MATERIAL;
    const struct aiMaterial *material = sender->scene->mMaterials[mesh->mMaterialIndex];
    uint32_t *number = &sender->numbers[mesh->mMaterialIndex];
    if (!material_is_given(material))
        return FOREIGN_NO_MATERIAL;
    if (*number == 0) {
        const ForeignMaterial taken = material_taken(material);
        send_bytes(sender->stream, FOREIGN_MATERIAL, &taken, sizeof taken);
        sender->counts->is_textured |= material_is_textured(material);
        *number = ++sender->sent_count;
    }
    return *number - 1;
}

// Reserves memory for `count` more vertices. If any vertex of the part has a normal, vertices
// without normals get zero vectors.
static bool reserve_vertices(Sender *sender, size_t count, bool has_normals, bool has_colors)
{
    Mesh *mesh = &sender->part.mesh;
    void *positions = mesh->positions, *normals = mesh->normals, *colors = mesh->colors;
    const size_t held = mesh->normals != NULL ? mesh->vertex_count : 0;
    const size_t wanted = mesh->vertex_count + count;
    bool ok = array_reserve(&positions, &sender->vertex_capacity, wanted, sizeof *mesh->positions,
                            sender->error);
    mesh->positions = positions;
    if (ok && (has_normals || normals != NULL))
        ok = array_reserve(&normals, &sender->normal_capacity, wanted, sizeof *mesh->normals,
                           sender->error);
    mesh->normals = normals;
    if (ok && normals != NULL)
        memset(mesh->normals + held, 0, (wanted - held) * sizeof *mesh->normals);
    if (ok && has_colors)
        ok = array_reserve(&colors, &sender->color_capacity, wanted, sizeof *mesh->colors,
                           sender->error);
    mesh->colors = colors;
    return ok;
}

// Returns whether the receiver rejects one of the `count` vertices after the part's vertices.
static bool has_invalid_vertex(const Mesh *part, size_t count)
{
    for (size_t i = part->vertex_count; i < part->vertex_count + count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (!(fabs(part->positions[i][axis]) < COORDINATE_MOST) ||
                (part->normals != NULL && !isfinite(part->normals[i][axis])))
                return true;
    return false;
}

static bool add_mesh(Sender *sender, const struct aiMesh *mesh, const Placement *placement)
{
    Mesh *part = &sender->part.mesh;
    const uint32_t material = number_of_material(sender, mesh);
    const NormalMatrix normal_matrix = normal_matrix_of(placement);
    const bool has_normals = sender->keeps_normals && mesh->mNormals != NULL;
    const bool has_colors = mesh->mColors[0] != NULL;
    const bool fits = part->vertex_count + mesh->mNumVertices < (size_t)MESH_COUNT_MOST;
    const bool differs = material != sender->part.material || has_colors != (part->colors != NULL);
    if ((differs || !fits) && !send_part_so_far(sender))
        return false;
    sender->part.material = material;
    if (!reserve_vertices(sender, mesh->mNumVertices, has_normals, has_colors))
        return false;
    place_vertices(sender, mesh, placement, normal_matrix.is_identity);
    if (has_normals)
        place_normals(sender, mesh, &normal_matrix);
    if (has_colors)
        copy_colors(sender, mesh);
    if (mesh->mName.data[0] != '\0' && has_invalid_vertex(part, mesh->mNumVertices))
        send_text(sender->stream, FOREIGN_OBJECT, "%s", mesh->mName.data);
    if (!add_triangles(sender, mesh, normal_matrix.is_mirror))
        return false;
    part->vertex_count += mesh->mNumVertices;
    return true;
}

static bool add_node(Sender *sender, const struct aiNode *node, const Placement *above)
{
    const Placement placement = placement_below(above, &node->mTransformation);
    for (size_t i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] >= sender->scene->mNumMeshes)
            return error_set(sender->error, "one of its nodes refers to a missing mesh");
        if (!add_mesh(sender, sender->scene->mMeshes[node->mMeshes[i]], &placement))
            return false;
    }
    for (size_t i = 0; i < node->mNumChildren; i++)
        if (!add_node(sender, node->mChildren[i], &placement))
            return false;
    return true;
}

bool parts_send(FILE *stream, const struct aiScene *scene, bool keeps_normals, PartCounts *counts,
                Error *error)
{
    Sender sender = {.stream = stream,
                     .scene = scene,
                     .keeps_normals = keeps_normals,
                     .counts = counts,
                     .part = {.material = FOREIGN_NO_MATERIAL},
                     .error = error};
    *counts = (PartCounts){0};
    if (scene->mRootNode == NULL)
        return true;
    sender.numbers = memory_zeroed(scene->mNumMaterials, sizeof *sender.numbers, error);
    const bool ok = sender.numbers != NULL && add_node(&sender, scene->mRootNode, &identity) &&
                    send_part_so_far(&sender);
    mesh_free(&sender.part.mesh);
    free(sender.triangles.memory);
    free(sender.numbers);
    return ok;
}
