// SPDX-License-Identifier: MIT
// Copies a model into OpenGL buffers and draws it. Triangles are drawn as meshes, spheres by a ray
// cast in each pixel, and boxes and normals as lines.
#include "view/draw/scene_view.h"

#include <stdlib.h>
#include <string.h>

// The following functions draw triangles. Buffer 0 has the points of all meshes, then their
// normals, and then their colors if any mesh has colors. Triangles share vertices as in the meshes,
// and each object takes one draw call. A mesh without colors is drawn in its material's color.

enum { POINT, NORMAL, TINT }; // the numbers of the attributes

#define VECTOR (3 * sizeof(float))

bool triangle_view_open(Drawing *view, Error *error)
{
    static const DrawingLayout layout = {
        shader_triangles, false, {{"position", 0}, {"normal", 0}, {"tint", 0}}};
    return drawing_open(view, &layout, error);
}

static bool has_colors(const Scene *scene)
{
    bool found = false;
    for (size_t i = 0; i < scene->objects.count; i++)
        found |= scene->objects.data[i].mesh.colors != NULL;
    return found;
}

// Copies vectors to the current buffer. Does nothing if `vectors` is NULL, because the mesh has no
// vectors of this kind.
static void fill_vectors(size_t offset, const void *vectors, size_t count)
{
    if (vectors != NULL)
        glBufferSubData(GL_ARRAY_BUFFER, (GLintptr)offset, (GLsizeiptr)(count * VECTOR), vectors);
}

void triangle_view_load(const Drawing *view, const Model *model)
{
    const Scene *scene = &model->scene;
    const Triangles *triangles = &model->stages.triangles;
    const size_t count = triangles->point_count;
    const size_t normals = count * sizeof *triangles->points, colors = normals + count * VECTOR;
    glBindVertexArray(view->array);
    drawing_fill(view, 0, NULL, colors + (has_colors(scene) ? count * VECTOR : 0));
    glVertexAttribPointer(POINT, 3, GL_FLOAT, GL_FALSE, sizeof *triangles->points, NULL);
    glVertexAttribPointer(NORMAL, 3, GL_FLOAT, GL_FALSE, 0, (void *)normals);
    glVertexAttribPointer(TINT, 3, GL_FLOAT, GL_FALSE, 0, (void *)colors);
    glEnableVertexAttribArray(POINT);
    glBindVertexArray(0);
    glBufferSubData(GL_ARRAY_BUFFER, 0, (GLsizeiptr)normals, triangles->points);
    for (size_t i = 0, first = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        fill_vectors(normals + first * VECTOR, mesh->normals, mesh->vertex_count);
        fill_vectors(colors + first * VECTOR, mesh->colors, mesh->vertex_count);
        first += mesh->vertex_count;
    }
    drawing_fill(view, 1, triangles->corners, triangles->count * sizeof *triangles->corners);
}

// Makes the next draw call read the attribute from the buffer or, if `vectors` is NULL, use one
// value for all vertices.
static void use_vectors(GLuint attribute, const void *vectors)
{
    (vectors != NULL ? glEnableVertexAttribArray : glDisableVertexAttribArray)(attribute);
}

// Sets the material of an object. Vertex colors replace the material's checker.
static void set_material(GLuint program, const Model *model, const MeshObject *object)
{
    static const char *const names[MATERIAL_VECTORS] = {"diffuse", "specular", "look",
                                                        "even",    "odd",      "shift"};
    float vectors[MATERIAL_VECTORS][4];
    Material material = model->scene.materials.data[object->material];
    if (object->mesh.colors != NULL)
        material.check_size = 0;
    light_store_material(vectors, &material, &model->normalization);
    for (int i = 0; i < MATERIAL_VECTORS; i++)
        glUniform4fv(glGetUniformLocation(program, names[i]), 1, vectors[i]);
    glVertexAttrib3fv(TINT, material.diffuse);
}

void triangle_view_draw(const Drawing *view, const Model *model, const Lens *lens, const Tone *tone)
{
    const Scene *scene = &model->scene;
    size_t first = 0;
    drawing_use(view);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, view->buffers[1]);
    lens_apply(lens, view->program);
    light_apply(scene, &model->normalization, tone, view->program);
    glVertexAttrib3f(NORMAL, 0, 0, 0);
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        (object->two_sided ? glDisable : glEnable)(GL_CULL_FACE);
        set_material(view->program, model, object);
        use_vectors(NORMAL, object->mesh.normals);
        use_vectors(TINT, object->mesh.colors);
        glDrawElements(GL_TRIANGLES, (GLsizei)(3 * object->mesh.triangle_count), GL_UNSIGNED_INT,
                       (void *)(3 * first * sizeof(GLuint)));
        first += object->mesh.triangle_count;
    }
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
}

// The following functions draw spheres. For every frame, each sphere's position relative to the eye
// is computed in fp64. In fp32, rounding would lose the eye's height above a ground sphere of
// radius 1e9.

// Floats per sphere: center, radius, and the material's vectors. The float at HEIGHT_PLACE, which
// no material uses, holds the eye's height above the sphere.
#define SPHERE_NUMBERS (4 + 4 * MATERIAL_VECTORS)
#define HEIGHT_PLACE   13
#define CUBE_VERTICES  36 // of the triangles of a cube (spheres.glsl)

bool sphere_view_open(Drawing *view, Error *error)
{
    static const DrawingLayout layout = {shader_spheres,
                                         true,
                                         {{"sphere", 4},
                                          {"diffuse", 4},
                                          {"specular", 4},
                                          {"look", 4},
                                          {"even", 4},
                                          {"odd", 4},
                                          {"shift", 4}}};
    return drawing_open(view, &layout, error);
}

static void store_sphere(float *numbers, const Model *model, const Sphere *sphere, Vec3 eye)
{
    float material[MATERIAL_VECTORS][4];
    const Vec3 place = normalize_point(&model->normalization, sphere->center);
    const Vec3 offset = vec3_sub(place, eye);
    const double radius = sphere->radius * model->normalization.scale;
    light_store_material(material, &model->scene.materials.data[sphere->material],
                         &model->normalization);
    vec3_store(numbers, offset);
    numbers[3] = (float)radius;
    memcpy(numbers + 4, material, sizeof material);
    numbers[HEIGHT_PLACE] = (float)(vec3_length(offset) - radius);
}

void sphere_view_draw(const Drawing *view, const Model *model, const Lens *lens, const Tone *tone)
{
    const Scene *scene = &model->scene;
    const size_t count = scene->spheres.count;
    if (count == 0)
        return;
    drawing_use(view);
    drawing_fill(view, 0, NULL, SPHERE_NUMBERS * count * sizeof(float));
    float *numbers = glMapBuffer(GL_ARRAY_BUFFER, GL_WRITE_ONLY);
    if (numbers == NULL)
        return;
    for (size_t i = 0; i < count; i++)
        store_sphere(numbers + SPHERE_NUMBERS * i, model, &scene->spheres.data[i], lens->eye);
    glUnmapBuffer(GL_ARRAY_BUFFER);
    lens_apply(lens, view->program);
    light_apply(scene, &model->normalization, tone, view->program);
    // Draws only the back faces of the cube, which cover the sphere even if the eye is inside the
    // cube.
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    glDrawArraysInstanced(GL_TRIANGLES, 0, CUBE_VERTICES, (GLsizei)count);
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
}

// The following functions draw each box as an instance of a cube's edges, or of a cube's diagonal.
// The diagonal's two vertices follow the vertices of the edges (lines.glsl).

#define EDGE_VERTICES 24

bool line_view_open(LineView *view, bool is_diagonal, Error *error)
{
    static const DrawingLayout layout = {shader_lines, true, {{"low", 3}, {"high", 3}}};
    *view = (LineView){.is_diagonal = is_diagonal};
    return drawing_open(&view->drawing, &layout, error);
}

void line_view_load(LineView *view, const Box *boxes, size_t count)
{
    view->count = (uint32_t)count;
    drawing_fill(&view->drawing, 0, boxes, count * sizeof *boxes);
}

void line_view_draw(const LineView *view, const Lens *lens, const float color[3])
{
    drawing_use(&view->drawing);
    lens_apply(lens, view->drawing.program);
    drawing_set_vector(view->drawing.program, "paint", color);
    if (view->is_diagonal)
        glDrawArraysInstanced(GL_LINES, EDGE_VERTICES, 2, (GLsizei)view->count);
    else
        glDrawArraysInstanced(GL_LINES, 0, EDGE_VERTICES, (GLsizei)view->count);
    glBindVertexArray(0);
}

typedef struct {
    Boxes *boxes;
    const Bvh *bvh;
    uint32_t depth; // 0 for leaves, 1 for the root
    Error *error;
} Collection;

// Adds the boxes of those nodes below node `number` whose depth in the whole tree is
// collection->depth. Node `number` has the depth `depth`. The tree's depth bounds the recursion.
static bool collect(const Collection *collection, uint32_t number, uint32_t depth)
{
    const BvhNode *node = &collection->bvh->nodes[number];
    const bool is_leaf = node->count > 0;
    if (is_leaf ? collection->depth == 0 : collection->depth == depth)
        return array_push(collection->boxes, node->box, collection->error);
    return is_leaf || (collect(collection, node->first, depth + 1) &&
                       collect(collection, node->first + 1, depth + 1));
}

uint32_t boxes_deepest(const Bvh *bvh)
{
    return bvh->depth > 0 ? bvh->depth - 1 : 0;
}

bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t depth, Error *error)
{
    const Collection collection = {boxes, bvh, depth, error};
    return bvh->node_count == 0 || collect(&collection, 0, 1);
}

void boxes_free(Boxes *boxes)
{
    free(boxes->memory);
    *boxes = (Boxes){0};
}

// The length of a drawn normal, in normalized coordinates.
#define LINE_LENGTH 0.075

static bool add_line(Boxes *lines, Vec3 start, Vec3 normal, Error *error)
{
    const Vec3 end = vec3_add(start, vec3_scale(vec3_normalize(normal), LINE_LENGTH));
    Box line;
    vec3_store(line.low, start);
    vec3_store(line.high, end);
    return array_push(lines, line, error);
}

static bool add_vertices(Boxes *lines, const Mesh *mesh, const float (*points)[4], Error *error)
{
    bool ok = true;
    for (size_t vertex = 0; ok && vertex < mesh->vertex_count; vertex++) {
        const Vec3 normal = vec3_of_floats(mesh->normals[vertex]);
        if (vec3_extent(normal) > 0)
            ok = add_line(lines, vec3_of_floats(points[vertex]), normal, error);
    }
    return ok;
}

static bool add_faces(Boxes *lines, const Mesh *mesh, const float (*points)[4], Error *error)
{
    bool ok = true;
    for (size_t triangle = 0; ok && triangle < mesh->triangle_count; triangle++) {
        const uint32_t *corners = mesh->triangles[triangle];
        const Vec3 a = vec3_of_floats(points[corners[0]]), b = vec3_of_floats(points[corners[1]]);
        const Vec3 c = vec3_of_floats(points[corners[2]]);
        const Vec3 normal = vec3_cross(vec3_sub(b, a), vec3_sub(c, a));
        const Vec3 middle = vec3_scale(vec3_add(a, vec3_add(b, c)), 1.0 / 3);
        ok = add_line(lines, middle, normal, error);
    }
    return ok;
}

bool boxes_of_normals(Boxes *lines, const Model *model, Error *error)
{
    const float(*points)[4] = (const float(*)[4])model->stages.triangles.points;
    for (size_t i = 0; i < model->scene.objects.count; i++) {
        const MeshObject *object = &model->scene.objects.data[i];
        const bool is_smooth = object->mesh.normals != NULL;
        if (!(is_smooth ? add_vertices : add_faces)(lines, &object->mesh, points, error))
            return false;
        points += object->mesh.vertex_count;
    }
    return true;
}
