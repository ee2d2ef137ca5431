// SPDX-License-Identifier: MIT
// The course's viewer draws normals of length 0.15. Its scenes have a size of 2 to 4, which
// normalization reduces to 1 to 2. The normals here are therefore half as long.
#include "view/draw/draw.h"

#include <stdlib.h>

typedef struct {
    Boxes *boxes;
    const Bvh *bvh;
    uint32_t level; // 0 for leaves, 1 for the root
    Error *error;
} Collection;

// Adds a subtree's boxes of collection->level. The depth of the tree bounds the recursion.
static bool collect(const Collection *collection, uint32_t number, uint32_t level)
{
    const BvhNode *node = &collection->bvh->nodes[number];
    const bool is_leaf = node->count > 0;
    if (is_leaf ? collection->level == 0 : collection->level == level)
        return array_push(collection->boxes, node->box, collection->error);
    return is_leaf || (collect(collection, node->first, level + 1) &&
                       collect(collection, node->first + 1, level + 1));
}

uint32_t boxes_levels(const Bvh *bvh)
{
    return bvh->depth > 0 ? bvh->depth - 1 : 0;
}

bool boxes_make(Boxes *boxes, const Bvh *bvh, uint32_t level, Error *error)
{
    const Collection collection = {boxes, bvh, level, error};
    return bvh->node_count == 0 || collect(&collection, 0, 1);
}

void boxes_free(Boxes *boxes)
{
    free(boxes->memory);
    *boxes = (Boxes){0};
}

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

bool normals_make(Boxes *lines, const Model *model, Error *error)
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
