// SPDX-License-Identifier: MIT
// Builds a small studio around the meshes of a lone mesh file: six cameras that frame the meshes
// tightly, three lights and a floor. If the file's format does not define which axis points up, the
// mesh's shape decides.
#include "scene/mesh_scene.h"

#include "base/clock.h"
#include "base/limits.h"

#include <stdlib.h>
#include <string.h>

// The following functions find the axis that points up. A mesh stands on a table without falling
// over if the points that touch the table lie on all four sides of the mesh's center.

// Fractions of the bounding box's longest side.
#define TOUCH  0.01 // points touch the table up to this height
#define MARGIN 0.03 // least distance of the outermost touching points from the center, on each side

// Returns the bounding box of the corners whose coordinate on the axis is at most `most`. Ignores
// triangles with fewer than `least` such corners.
static BoundingBox box_below(const Scene *scene, int axis, double most, int least)
{
    BoundingBox box = bounding_box_empty();
    for (size_t i = 0; i < scene->objects.count; i++) {
        const Mesh *mesh = &scene->objects.data[i].mesh;
        for (size_t triangle = 0; triangle < mesh->triangle_count; triangle++) {
            const uint32_t *corners = mesh->triangles[triangle];
            int below = 0;
            for (int corner = 0; corner < 3; corner++)
                below += mesh->positions[corners[corner]][axis] <= most;
            for (int corner = 0; below >= least && corner < 3; corner++)
                if (mesh->positions[corners[corner]][axis] <= most)
                    bounding_box_add(&box, mesh_corner(mesh, triangle, corner));
        }
    }
    return box;
}

static bool stands(const Scene *scene, const BoundingBox *body, int up, int least)
{
    double bottom[3], low[3], high[3], center[3];
    const double extent = vec3_extent(bounding_box_sides(body));
    vec3_store_doubles(bottom, body->low);
    const BoundingBox base = box_below(scene, up, bottom[up] + TOUCH * extent, least);
    vec3_store_doubles(low, base.low);
    vec3_store_doubles(high, base.high);
    vec3_store_doubles(center, bounding_box_center(body));
    for (int axis = 0; axis < 3; axis++)
        if (axis != up &&
            fmin(center[axis] - low[axis], high[axis] - center[axis]) < MARGIN * extent)
            return false;
    return true;
}

// Returns `usual`, which is UP_Y or UP_Z, unless the meshes stand only with the other axis up. If z
// is usual, meshes count as standing with y up only if whole triangles are on the table, because
// meshes may by chance stand on a few points.
static UpAxis up_axis_of_shape(const Scene *scene, UpAxis usual)
{
    const BoundingBox body = box_below(scene, 0, INFINITY, 0);
    const bool stands_on_y = stands(scene, &body, 1, usual == UP_Y ? 1 : 3);
    const bool stands_on_z = stands(scene, &body, 2, 1);
    if (usual == UP_Y)
        return stands_on_z && !stands_on_y ? UP_Z : UP_Y;
    return stands_on_y && !stands_on_z ? UP_Y : UP_Z;
}

// The following functions frame the meshes. The eye has a fixed distance from its look-at point,
// and planes through the eye bound the picture. For each axis of the picture, touch() finds two
// planes that touch the meshes and have opposite slopes relative to the view direction.

#define VIEWS         6
#define DISTANCE      4.0 // of the eye from the look-at point, divided by the meshes' radius
#define FILLED        0.8 // fraction of the picture's width or height that the meshes span
#define RUN_TRIANGLES 64
#define MOST_STEPS    32

#define DEGREES_PER_RADIAN 57.295779513082320877

// A short run of a mesh's triangles. Neighbors in a file are usually neighbors in space, so a run's
// bounding box lets farthest() skip most runs.
typedef struct {
    Mesh mesh; // borrowed
    BoundingBox box;
} TriangleRun;

typedef struct {
    ARRAY(TriangleRun) runs;
    Vec3 center;
    double distance;
} Framing;

static bool add_runs(Framing *framing, const Mesh *mesh, Error *error)
{
    for (size_t first = 0; first < mesh->triangle_count; first += RUN_TRIANGLES) {
        const size_t rest = mesh->triangle_count - first;
        TriangleRun run = {.mesh = *mesh};
        run.mesh.triangles += first;
        run.mesh.triangle_count = rest < RUN_TRIANGLES ? rest : RUN_TRIANGLES;
        run.box = mesh_bounds(&run.mesh);
        if (!array_push(&framing->runs, run, error))
            return false;
    }
    return true;
}

static Vec3 farthest(const Framing *framing, Vec3 d)
{
    Vec3 found = framing->center;
    double most = -INFINITY;
    for (size_t i = 0; i < framing->runs.count; i++) {
        const TriangleRun *run = &framing->runs.data[i];
        const Vec3 low = run->box.low, high = run->box.high;
        if (fmax(d.x * low.x, d.x * high.x) + fmax(d.y * low.y, d.y * high.y) +
                fmax(d.z * low.z, d.z * high.z) <=
            most)
            continue;
        for (size_t corner = 0; corner < 3 * run->mesh.triangle_count; corner++) {
            const Vec3 point = mesh_corner(&run->mesh, corner / 3, (int)(corner % 3));
            if (vec3_dot(point, d) > most) {
                most = vec3_dot(point, d);
                found = point;
            }
        }
    }
    return vec3_sub(found, framing->center);
}

// Two planes through the eye enclose the meshes along `axis`. Their slopes to the view direction
// are s and -s. Returns s, and stores the eye's coordinate on the axis in *middle. Newton's method
// ends after few steps, because the gap between the planes and the meshes is a convex, piecewise
// linear function of the slope.
static double touch(const Framing *framing, Vec3 axis, Vec3 back, double *middle)
{
    double slope = -1, next = 0;
    for (int step = 0; step < MOST_STEPS && next != slope; step++) {
        slope = next;
        const Vec3 inward = vec3_scale(back, slope);
        const Vec3 high = farthest(framing, vec3_add(inward, axis));
        const Vec3 low = farthest(framing, vec3_sub(inward, axis));
        const double above = framing->distance - vec3_dot(high, back);
        const double below = framing->distance - vec3_dot(low, back);
        next = (vec3_dot(high, axis) - vec3_dot(low, axis)) / (above + below);
        *middle = vec3_dot(high, axis) - next * above;
    }
    return next;
}

// Returns the field of view, in degrees, at which planes of slope `slope` span the fraction FILLED
// of the picture. Newton's method starts above the result and stays above it, because tan is convex
// there.
static double field_of_view(double slope)
{
    double half = 45;
    for (int step = 0; step < MOST_STEPS; step++) {
        const double sine = sine_of_degrees(half), cosine = cosine_of_degrees(half);
        half -= (sine - slope / FILLED * cosine) * cosine * DEGREES_PER_RADIAN;
    }
    return fmax(2 * half, FOV_LEAST);
}

// Returns the viewpoint whose eye is in direction `back`, seen from the meshes.
static Viewpoint view_from(const Framing *framing, Vec3 back, Vec3 up)
{
    double right, top;
    const Vec3 x = vec3_normalize(vec3_cross(up, back)), y = vec3_cross(back, x);
    const double width = touch(framing, x, back, &right), height = touch(framing, y, back, &top);
    const Vec3 aside = vec3_add(vec3_scale(x, right), vec3_scale(y, top));
    const Vec3 look_at = vec3_add(framing->center, aside);
    return (Viewpoint){.eye = vec3_add(look_at, vec3_scale(back, framing->distance)),
                       .look_at = look_at,
                       .up = up,
                       .fov_degrees = field_of_view(height),
                       .width_degrees = field_of_view(width)};
}

// Adds the six viewpoints. In each view, the meshes span 80 % of the picture's width or height, and
// at most 80 % of the other side. The sphere with `center` and `radius` must contain all meshes.
static bool mesh_frame_add_views(Scene *scene, Vec3 center, double radius, Error *error)
{
    static const Vec3 directions[VIEWS] = {{3, -4.5, 2}, {0, -1, 0}, {1, 0, 0},
                                           {0, 1, 0},    {-1, 0, 0}, {0, 0, 1}};
    Framing framing = {.center = center, .distance = DISTANCE * radius};
    bool ok = true;
    for (size_t i = 0; ok && i < scene->objects.count; i++)
        ok = add_runs(&framing, &scene->objects.data[i].mesh, error);
    for (int view = 0; ok && view < VIEWS; view++) {
        const Vec3 up = view == VIEWS - 1 ? vec3(0, 1, 0) : vec3(0, 0, 1);
        const Viewpoint viewpoint = view_from(&framing, vec3_normalize(directions[view]), up);
        ok = array_push(&scene->viewpoints, viewpoint, error);
    }
    free(framing.runs.memory);
    return ok;
}

const char mesh_scene_studio[] =
    "background 0.8 0.84 0.88\n"
    "ambient 0.3\n"
    "define clay blinn_phong diffuse 0.93 0.85 0.76 kd 1 ks 0.25 shininess 40\n"
    "define floor matte diffuse 0.8815 0.9314 0.9899\n";

// A key light from the left, a fill light from the right and a light from behind, as seen by the
// first camera. The positions are relative to the meshes' center, in units of LIGHT_DISTANCE.
static const Light lights[3] = {{{-12, -26, 30}, 0.50, {1, 0.97, 0.92}, false},
                                {{26, -14, 18}, 0.20, {0.9, 0.95, 1}, false},
                                {{-8, 26, 16}, 0.30, {1, 1, 1}, false}};

// The unit of both constants is half the diagonal of the meshes' bounding box. The floor is the top
// of a sphere that is too large to look curved. The lights are so distant that the floor has the
// even color of the background, and no horizon is visible.
#define FLOOR_RADIUS   1e4
#define LIGHT_DISTANCE 1e4

// Soft lights are squares that face the meshes. LIGHT_SIDE is a square's side divided by its
// distance.
#define LIGHT_SIDE  0.09
#define LIGHT_CELLS 4

bool mesh_scene_is_mesh(const char *bytes, size_t size)
{
    return size >= 4 && memcmp(bytes, "ply", 3) == 0 && (bytes[3] == '\n' || bytes[3] == '\r');
}

// Returns the area of a light at `offset` from the meshes' center.
static LightArea light_area(Vec3 offset, StudioLights studio)
{
    const Vec3 side = vec3_normalize(vec3_cross(vec3(0, 0, 1), offset));
    const Vec3 other = vec3_normalize(vec3_cross(offset, side));
    const double length = LIGHT_SIDE * vec3_length(offset);
    return (LightArea){{vec3_scale(side, length), vec3_scale(other, length)},
                       studio == STUDIO_SOFT ? LIGHT_CELLS : 1};
}

static bool add_lights(Scene *scene, StudioLights studio, Vec3 center, double radius, Error *error)
{
    bool ok = true;
    for (int i = 0; ok && i < 3; i++) {
        Light light = lights[i];
        const Vec3 offset = vec3_scale(light.position, LIGHT_DISTANCE * radius);
        const LightArea area = light_area(offset, studio);
        light.position = vec3_add(center, offset);
        ok = scene_add_area_light(scene, &light, &area, error);
    }
    return ok;
}

static bool add_studio(Scene *scene, StudioLights studio, Error *error)
{
    BoundingBox box = bounding_box_empty();
    for (size_t object = 0; object < scene->objects.count; object++)
        mesh_add_bounds(&scene->objects.data[object].mesh, &box);
    const bool is_empty = scene_triangle_count(scene) == 0;
    if (is_empty)
        box = (BoundingBox){{-1, -1, -1}, {1, 1, 1}};
    const Vec3 half = vec3_scale(bounding_box_sides(&box), 0.5);
    const Vec3 center = vec3_add(box.low, half);
    const double radius = vec3_length(half), depth = FLOOR_RADIUS * radius;
    const Sphere floor = {vec3(center.x, center.y, box.low.z - depth), depth, MESH_FLOOR};
    scene->viewpoints.count = scene->spheres.count = 0;
    scene->lights.count = scene->area_lights.count = 0;
    scene->has_course_views = false;
    return mesh_frame_add_views(scene, center, radius, error) &&
           (is_empty || array_push(&scene->spheres, floor, error)) &&
           add_lights(scene, studio, center, radius, error);
}

// Adds the up axis, the choice of normals and the studio to scene->hash, because all parts of a
// picture must agree on them.
static void hash_choices(Scene *scene, const SceneLoadOptions *options)
{
    const char *up = up_axis_names[scene->mesh_up];
    const double normals[2] = {options->normals, options->crease_degrees};
    scene_hash_input(scene, up, strlen(up));
    if (options->normals != NORMALS_AUTO)
        scene_hash_input(scene, normals, sizeof normals);
    if (options->studio != STUDIO_HARD)
        scene_hash_input(scene, &options->studio, sizeof options->studio);
}

static bool turn_and_frame(Scene *scene, UpAxis up, StudioLights studio, Error *error)
{
    for (size_t object = 0; object < scene->objects.count; object++)
        mesh_turn_up(&scene->objects.data[object].mesh, up);
    scene->mesh_up = up;
    return add_studio(scene, studio, error);
}

// Returns the up axis that a Collada file names. Assimp would turn the meshes of such files itself,
// but clrt-foreign prevents this.
static UpAxis up_axis_of_collada(const char *path)
{
    File file;
    Error error = {0};
    if (!file_read(&file, path, &error))
        return UP_Y;
    const bool is_z = memmem(file.bytes, file.size, ">Z_UP<", 6) != NULL;
    const bool is_x = memmem(file.bytes, file.size, ">X_UP<", 6) != NULL;
    file_free(&file);
    return is_z ? UP_Z : is_x ? UP_X : UP_Y;
}

// Returns the up axis of a mesh file.
// - PLY, STL and OFF define no axis, but usually z is up. OBJ defines none either, but usually y is
// up. The mesh's shape can overrule the usual axis.
// - A Collada file names its axis.
// - 3MF and AMF define z. glTF defines y, and Assimp turns several other formats to y.
static UpAxis up_axis_of_file(const Scene *scene, const char *path, bool is_ply)
{
    if (is_ply || file_has_ending(path, ".stl") || file_has_ending(path, ".off"))
        return up_axis_of_shape(scene, UP_Z);
    if (file_has_ending(path, ".obj"))
        return up_axis_of_shape(scene, UP_Y);
    if (file_has_ending(path, ".dae"))
        return up_axis_of_collada(path);
    return file_has_ending(path, ".3mf") || file_has_ending(path, ".amf") ? UP_Z : UP_Y;
}

static MeshLoadOptions mesh_options_of(const SceneLoadOptions *options)
{
    const bool is_chosen = options->normals == NORMALS_SMOOTH;
    return (MeshLoadOptions){.object = {.material = MESH_CLAY, .two_sided = true},
                             .colored_material = MESH_CLAY,
                             .is_flat = options->normals == NORMALS_FLAT,
                             .crease_degrees =
                                 is_chosen ? options->crease_degrees : CREASE_BY_SHAPE,
                             .takes_own_materials = true,
                             .is_tolerant = options->is_tolerant};
}

bool mesh_scene_fill(Scene *scene, const File *ply, const char *path,
                     const SceneLoadOptions *options, Error *error)
{
    const MeshLoadOptions mesh = mesh_options_of(options);
    const double start = clock_seconds();
    bool ok = (ply != NULL ? mesh_load_ply(scene, ply, path, &mesh, error)
                           : mesh_load_foreign(scene, path, &mesh, error)) &&
              mesh_load_normals(scene, 0, &mesh, error);
    scene->mesh_seconds = clock_seconds() - start;
    const bool is_auto = options->up == UP_AUTO;
    if (ok) {
        const UpAxis up = is_auto ? up_axis_of_file(scene, path, ply != NULL) : options->up;
        ok = turn_and_frame(scene, up, options->studio, error);
    }
    if (ok)
        hash_choices(scene, options);
    return ok;
}
