// SPDX-License-Identifier: MIT
// The caller's structs and numbers -> a scene's materials, spheres, lights and cameras.
#include "base/limits.h"
#include "library/handles.h"

static bool check_material(const ClrtMaterial *material, ClrtError *error)
{
    return argument_number(error, "the shading", (double)material->shading, CLRT_SHADING_SILHOUETTE,
                           CLRT_SHADING_GLASS) &&
           argument_color(error, "the diffuse color", material->diffuse) &&
           argument_color(error, "the specular color", material->specular) &&
           argument_number(error, "kd", material->kd, 0, FACTOR_MOST) &&
           argument_number(error, "ks", material->ks, 0, FACTOR_MOST) &&
           argument_number(error, "the shininess", material->shininess, 0, SHININESS_MOST) &&
           argument_number(error, "the reflectivity", material->reflectivity, 0, 1) &&
           (material->check_size == 0 ||
            argument_number(error, "the size of checks", material->check_size, RADIUS_LEAST,
                            RADIUS_MOST)) &&
           argument_color(error, "the color of even cubes", material->even) &&
           argument_color(error, "the color of odd cubes", material->odd) &&
           (material->shading != CLRT_SHADING_GLASS ||
            argument_number(error, "the index of refraction", material->ior, IOR_LEAST, IOR_MOST));
}

bool clrt_scene_add_material(ClrtScene *scene, const ClrtMaterial *material, uint32_t *number,
                             ClrtError *error)
{
    ClrtMaterial given;
    Error cause = {0};
    if (!argument_given(error, "the scene", scene) ||
        !argument_given(error, "the number", number) ||
        !argument_struct(error, "the material", material, &given, sizeof given) ||
        !check_material(&given, error))
        return false;
    const bool is_glass = given.shading == CLRT_SHADING_GLASS;
    Material made = {.kd = (float)given.kd,
                     .ks = (float)given.ks,
                     .shader = (Shader)given.shading,
                     .reflectivity = is_glass ? 1 : (float)given.reflectivity,
                     .check_size = is_glass ? 0 : (float)given.check_size,
                     .ior = (float)given.ior};
    for (int channel = 0; channel < 3; channel++) {
        made.diffuse[channel] = (float)given.diffuse[channel];
        made.specular[channel] = (float)given.specular[channel];
        made.checks[0][channel] = (float)given.even[channel];
        made.checks[1][channel] = (float)given.odd[channel];
    }
    material_set_shininess(&made, (float)given.shininess);
    const size_t place = scene->scene.materials.count;
    const bool ok = array_push(&scene->scene.materials, made, &cause);
    if (ok)
        *number = (uint32_t)place;
    return scene_handle_changed(scene, ok, &cause, error);
}

bool clrt_scene_add_sphere(ClrtScene *scene, const double center[3], double radius,
                           uint32_t material, ClrtError *error)
{
    Error cause = {0};
    if (!argument_given(error, "the scene", scene) ||
        !argument_vector(error, "the center", center, COORDINATE_MOST) ||
        !argument_number(error, "the radius", radius, RADIUS_LEAST, RADIUS_MOST) ||
        !scene_handle_check_material(scene, material, error))
        return false;
    const Sphere sphere = {vec3_of_doubles(center), radius, material};
    const bool ok = array_push(&scene->scene.spheres, sphere, &cause);
    return scene_handle_changed(scene, ok, &cause, error);
}

bool clrt_scene_add_light(ClrtScene *scene, const double position[3], double intensity,
                          ClrtError *error)
{
    const double white[3] = {1, 1, 1};
    return clrt_scene_add_colored_light(scene, position, intensity, white, error);
}

static bool add_light(ClrtScene *scene, const Light *light, ClrtError *error)
{
    Error cause = {0};
    const bool ok = array_push(&scene->scene.lights, *light, &cause);
    return scene_handle_changed(scene, ok, &cause, error);
}

bool clrt_scene_add_colored_light(ClrtScene *scene, const double position[3], double intensity,
                                  const double color[3], ClrtError *error)
{
    return argument_given(error, "the scene", scene) &&
           argument_vector(error, "the position", position, COORDINATE_MOST) &&
           argument_number(error, "the intensity", intensity, 0, INTENSITY_MOST) &&
           argument_color(error, "the light's color", color) &&
           add_light(scene,
                     &(Light){vec3_of_doubles(position), intensity, vec3_of_doubles(color), false},
                     error);
}

bool clrt_scene_add_sun(ClrtScene *scene, const double direction[3], double intensity,
                        const double color[3], ClrtError *error)
{
    if (!argument_given(error, "the scene", scene) ||
        !argument_vector(error, "the direction", direction, COORDINATE_MOST) ||
        !argument_number(error, "the intensity", intensity, 0, INTENSITY_MOST) ||
        !argument_color(error, "the sun's color", color))
        return false;
    const Light sun = {vec3_of_doubles(direction), intensity, vec3_of_doubles(color), true};
    if (vec3_extent(sun.position) == 0)
        return library_fail(error, CLRT_ARGUMENT, "the direction of a sun must not be zero");
    return add_light(scene, &sun, error);
}

bool clrt_scene_add_area_light(ClrtScene *scene, const ClrtAreaLight *light, ClrtError *error)
{
    ClrtAreaLight given;
    Error cause = {0};
    if (!argument_given(error, "the scene", scene) ||
        !argument_struct(error, "the light", light, &given, sizeof given) ||
        !argument_vector(error, "the position", given.position, COORDINATE_MOST) ||
        !argument_vector(error, "side_u", given.side_u, COORDINATE_MOST) ||
        !argument_vector(error, "side_v", given.side_v, COORDINATE_MOST) ||
        !argument_number(error, "the number of cells", given.cells, 1, AREA_CELLS_MOST) ||
        !argument_number(error, "the intensity", given.intensity, 0, INTENSITY_MOST) ||
        !argument_color(error, "the light's color", given.color))
        return false;
    const Light center = {vec3_of_doubles(given.position), given.intensity,
                          vec3_of_doubles(given.color), false};
    const LightArea area = {{vec3_of_doubles(given.side_u), vec3_of_doubles(given.side_v)},
                            given.cells};
    const bool ok = scene_add_area_light(&scene->scene, &center, &area, &cause);
    return scene_handle_changed(scene, ok, &cause, error);
}

// Fails if an angle of a perspective camera, or a side of an orthographic camera, is invalid.
static bool check_extent(const ClrtCamera *camera, ClrtError *error)
{
    if (camera->height != 0)
        return argument_number(error, "the height", camera->height, HEIGHT_LEAST, HEIGHT_MOST) &&
               argument_number(error, "the width", camera->width, 0, HEIGHT_MOST);
    return argument_number(error, "the field of view", camera->fov_degrees, FOV_LEAST, FOV_MOST) &&
           argument_number(error, "the horizontal field of view", camera->width_degrees, 0,
                           FOV_MOST);
}

bool scene_handle_take_camera(Viewpoint *viewpoint, const ClrtCamera *camera, ClrtError *error)
{
    ClrtCamera given;
    if (!argument_struct(error, "the camera", camera, &given, sizeof given) ||
        !argument_vector(error, "the eye", given.eye, COORDINATE_MOST) ||
        !argument_vector(error, "the point looked at", given.look_at, COORDINATE_MOST) ||
        !argument_vector(error, "the camera's 'up'", given.up, COORDINATE_MOST) ||
        !check_extent(&given, error))
        return false;
    *viewpoint = (Viewpoint){.eye = vec3_of_doubles(given.eye),
                             .look_at = vec3_of_doubles(given.look_at),
                             .up = vec3_of_doubles(given.up),
                             .fov_degrees = given.fov_degrees,
                             .width_degrees = given.width_degrees,
                             .height = given.height,
                             .width = given.width};
    if (!(vec3_extent(viewpoint->up) > 0))
        viewpoint->up = vec3(0, 0, 1);
    const char *fault = viewpoint_fault(viewpoint);
    return fault == NULL || library_fail(error, CLRT_ARGUMENT, "%s", fault);
}

bool scene_handle_check_view(const ClrtScene *scene, uint32_t view, ClrtError *error)
{
    const size_t count = scene->scene.viewpoints.count;
    if (count == 0)
        return library_fail(error, CLRT_ARGUMENT,
                            "the scene has no camera: add one, or request the picture with one");
    return (view >= 1 && view <= count) ||
           library_fail(error, CLRT_ARGUMENT, "view %u does not exist: the scene has %zu", view,
                        count);
}

bool clrt_scene_add_camera(ClrtScene *scene, const ClrtCamera *camera, ClrtError *error)
{
    Viewpoint viewpoint;
    Error cause = {0};
    if (!argument_given(error, "the scene", scene) ||
        !scene_handle_take_camera(&viewpoint, camera, error))
        return false;
    const bool ok = array_push(&scene->scene.viewpoints, viewpoint, &cause);
    return scene_handle_changed(scene, ok, &cause, error);
}

bool clrt_scene_get_camera(const ClrtScene *scene, uint32_t view, ClrtCamera *camera,
                           ClrtError *error)
{
    if (!argument_given(error, "the scene", scene) || !scene_handle_check_view(scene, view, error))
        return false;
    const Viewpoint *viewpoint = &scene->scene.viewpoints.data[view - 1];
    ClrtCamera filled = {.fov_degrees = viewpoint->fov_degrees,
                         .width_degrees = viewpoint->width_degrees,
                         .height = viewpoint->height,
                         .width = viewpoint->width};
    vec3_store_doubles(filled.eye, viewpoint->eye);
    vec3_store_doubles(filled.look_at, viewpoint->look_at);
    vec3_store_doubles(filled.up, viewpoint->up);
    return argument_fill(error, "the camera", camera, &filled, sizeof filled);
}

bool clrt_scene_set_background(ClrtScene *scene, const double color[3], ClrtError *error)
{
    if (!argument_given(error, "the scene", scene) ||
        !argument_color(error, "the background", color))
        return false;
    scene->scene.background = vec3_of_doubles(color);
    return scene_handle_changed(scene, true, NULL, NULL);
}

bool clrt_scene_set_ambient(ClrtScene *scene, double intensity, ClrtError *error)
{
    if (!argument_given(error, "the scene", scene) ||
        !argument_number(error, "the ambient light", intensity, 0, 1))
        return false;
    scene->scene.ambient = intensity;
    return scene_handle_changed(scene, true, NULL, NULL);
}
