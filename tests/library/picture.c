// SPDX-License-Identifier: MIT
// Draws a ball on a mirror as PFM: cc picture.c -o picture $(pkg-config --cflags --libs clrt)
#include <clrt.h>
#include <stdio.h>

enum { WIDTH = 320, HEIGHT = 240 };

static float rgb[HEIGHT][WIDTH][3], depth[HEIGHT][WIDTH];

static void list_devices(void)
{
    uint32_t count = 0;
    ClrtDevice device = {.size = sizeof device};
    clrt_device_count(&count, NULL);
    for (uint32_t i = 0; i < count && clrt_device_get(i, &device, NULL); i++)
        fprintf(stderr, "device %s: %s\n", device.device, device.name);
}

static ClrtScene *make_scene(ClrtError *error)
{
    static const double corners[][3] = {{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}};
    static const uint32_t halves[][3] = {{0, 1, 2}, {0, 2, 3}};
    static const double ball[] = {0, 0, 1}, lamp[] = {4, -2, 6};
    const ClrtMesh ground = {.size = sizeof ground,
                             .positions = corners[0],
                             .triangles = halves[0],
                             .vertex_count = 4,
                             .triangle_count = 2,
                             .material = CLRT_MATERIAL_MIRROR};
    const ClrtCamera camera = {.size = sizeof camera, .eye = {3, -5, 3}, .fov_degrees = 45};
    ClrtScene *scene = clrt_scene_create(error); // or clrt_scene_load(path, NULL, error)
    if (scene != NULL && clrt_scene_add_sphere(scene, ball, 1, CLRT_MATERIAL_BLINN_PHONG, error) &&
        clrt_scene_add_mesh(scene, &ground, error) &&
        clrt_scene_add_light(scene, lamp, 0.9, error) &&
        clrt_scene_add_camera(scene, &camera, error))
        return scene;
    clrt_scene_free(scene);
    return NULL;
}

// Draws the picture with an error of at most 1 %, and stores the depth of each pixel.
static bool draw(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    const ClrtChannel channel = {"depth", depth};
    ClrtResult result = {.size = sizeof result};
    const ClrtPicture picture = {.size = sizeof picture,
                                 .width = WIDTH,
                                 .height = HEIGHT,
                                 .error = 0.01,
                                 .channels = &channel,
                                 .channel_count = 1,
                                 .result = &result};
    if (!clrt_render(renderer, scene, &picture, rgb[0][0], error))
        return false;
    fprintf(stderr, "error at most %.2g after %.1f samples per pixel; center at depth %g\n",
            result.error_bound, (double)result.sample_count / (WIDTH * HEIGHT),
            (double)depth[HEIGHT / 2][WIDTH / 2]);
    return true;
}

// Follows the ray through the center of the picture.
static bool explain(ClrtRenderer *renderer, const ClrtScene *scene, ClrtError *error)
{
    const uint32_t center[] = {WIDTH / 2, HEIGHT / 2};
    const ClrtPicture picture = {.size = sizeof picture, .width = WIDTH, .height = HEIGHT};
    ClrtExplainedRay ray = {.size = sizeof ray};
    ClrtExplanation *explanation = clrt_explain(renderer, scene, &picture, center, error);
    for (uint32_t place[2] = {0, 0}; clrt_explanation_get_ray(explanation, place, &ray, NULL);
         place[1]++)
        fprintf(stderr, "ray %u: primitive %u at %g %g %g, weight %g\n", place[1], ray.primitive,
                ray.point[0], ray.point[1], ray.point[2], ray.weight);
    clrt_explanation_free(explanation);
    return explanation != NULL;
}

int main(void)
{
    ClrtError error = {0};
    ClrtScene *scene = make_scene(&error);
    ClrtRenderer *renderer = scene != NULL ? clrt_renderer_create(NULL, &error) : NULL;
    list_devices();
    const bool ok =
        renderer != NULL && draw(renderer, scene, &error) && explain(renderer, scene, &error);
    if (ok)
        printf("PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    else
        fprintf(stderr, "%s\n", error.text);
    for (int row = HEIGHT; ok && row-- > 0;)
        fwrite(rgb[row], sizeof rgb[row], 1, stdout);
    clrt_renderer_free(renderer);
    clrt_scene_free(scene);
    return ok ? 0 : 1;
}
