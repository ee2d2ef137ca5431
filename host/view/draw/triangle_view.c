// SPDX-License-Identifier: MIT
// Triangles share vertices as in the meshes. Each object takes one draw call.
#include "view/draw/draw.h"

#include <stddef.h>
#include <stdlib.h>

typedef struct {
    float position[3];
    float normal[3]; // zero for none
} Vertex;

bool triangle_view_open(Drawing *view, Error *error)
{
    static const DrawingLayout layout = {shader_triangles,
                                         {sizeof(Vertex), 0},
                                         {{"position", 0, 3, offsetof(Vertex, position)},
                                          {"normal", 0, 3, offsetof(Vertex, normal)}}};
    return drawing_open(view, &layout, error);
}

static void store_vertex(Vertex *vertex, const float point[4], const float *normal)
{
    for (int axis = 0; axis < 3; axis++)
        vertex->position[axis] = point[axis];
    vec3_store(vertex->normal,
               normal == NULL ? vec3(0, 0, 0) : vec3_normalize(vec3_of_floats(normal)));
}

static void store_vertices(Vertex *vertices, const Model *model)
{
    size_t place = 0;
    for (size_t i = 0; i < model->scene.objects.count; i++) {
        const Mesh *mesh = &model->scene.objects.data[i].mesh;
        for (size_t vertex = 0; vertex < mesh->vertex_count; vertex++, place++)
            store_vertex(&vertices[place], model->stages.triangles.points[place],
                         mesh->normals == NULL ? NULL : mesh->normals[vertex]);
    }
}

bool triangle_view_load(const Drawing *view, const Model *model, Error *error)
{
    const Triangles *triangles = &model->stages.triangles;
    Vertex *vertices = memory_raw(triangles->point_count, sizeof *vertices, error);
    if (vertices == NULL)
        return false;
    store_vertices(vertices, model);
    drawing_fill(view, 0, vertices, triangles->point_count * sizeof *vertices);
    drawing_fill(view, 1, triangles->corners, triangles->count * sizeof *triangles->corners);
    free(vertices);
    return true;
}

static void set_material(GLuint program, const Material *material)
{
    float vectors[3][4];
    light_store_material(vectors, material);
    glUniform4fv(glGetUniformLocation(program, "diffuse"), 1, vectors[0]);
    glUniform4fv(glGetUniformLocation(program, "specular"), 1, vectors[1]);
    glUniform4fv(glGetUniformLocation(program, "look"), 1, vectors[2]);
}

void triangle_view_draw(const Drawing *view, const Model *model, const Lens *lens, const Tone *tone)
{
    const Scene *scene = &model->scene;
    size_t first = 0;
    drawing_use(view);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, view->buffers[1]);
    lens_apply(lens, view->program);
    light_apply(scene, &model->normalization, tone, view->program);
    for (size_t i = 0; i < scene->objects.count; i++) {
        const MeshObject *object = &scene->objects.data[i];
        (object->two_sided ? glDisable : glEnable)(GL_CULL_FACE);
        set_material(view->program, &scene->materials.data[object->material]);
        glDrawElements(GL_TRIANGLES, (GLsizei)(3 * object->mesh.triangle_count), GL_UNSIGNED_INT,
                       (void *)(3 * first * sizeof(GLuint)));
        first += object->mesh.triangle_count;
    }
    glDisable(GL_CULL_FACE);
    glBindVertexArray(0);
}
