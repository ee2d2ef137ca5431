// SPDX-License-Identifier: MIT
// Compares the renderer's counters with the counters of the course's tracer. Rays along an edge may
// fall on either side.
#include "image/course.h"
#include "image/picture.h"
#include "unit/cmocka_all.h"

#include <math.h>

#define CAMERA_RAYS (512 * 512)

// Counts may be off by 0.02 %.
static bool is_near(uint64_t count, uint64_t expected)
{
    return fabs((double)count - (double)expected) <= ceil(2e-4 * (double)expected);
}

typedef struct {
    const char *scene;
    uint64_t camera_hits, shaded_points, reflected_rays;
    uint64_t shadow_rays; // by the course's tracer, which also casts rays that cannot reach the
    // light
} Counts;

static void check(Counts expected)
{
    char path[COURSE_PATH_SIZE];
    uint64_t tallies[TALLY_KINDS];
    Error error = {0};
    FREED_BY(framebuffer_free) Framebuffer picture = {0};
    course_path(path, "scenes", expected.scene);
    if (!course_has(path))
        return;
    PictureRequest request = picture_request(path, 1);
    request.tallies = tallies;
    if (!picture_render(&picture, &request, &error))
        fail_msg("%s", error.text);
    print_message("%s: %llu camera rays hit of %llu, %llu points shaded, %llu rays reflected\n",
                  expected.scene, (unsigned long long)tallies[TALLY_CAMERA_HITS],
                  (unsigned long long)expected.camera_hits,
                  (unsigned long long)tallies[TALLY_SHADED_POINTS],
                  (unsigned long long)tallies[TALLY_REFLECTED_RAYS]);
    assert_int_equal(tallies[TALLY_CAMERA_RAYS], CAMERA_RAYS);
    assert_true(is_near(tallies[TALLY_CAMERA_HITS], expected.camera_hits));
    assert_true(is_near(tallies[TALLY_SHADED_POINTS], expected.shaded_points));
    assert_true(is_near(tallies[TALLY_REFLECTED_RAYS], expected.reflected_rays));
    assert_true(tallies[TALLY_SHADOW_RAYS] <= expected.shadow_rays);
}

TEST(unshaded_and_shaded_scenes_hit_as_often_as_the_courses)
{
    check((Counts){"silhouette.scn", 95935, 95935, 0, 0});
    check((Counts){"matte.scn", 95935, 95935, 0, 191870});
    check((Counts){"blinn_phong.scn", 95935, 95935, 0, 191870});
    check((Counts){"simple.scn", 98036, 98036, 0, 196072});
}

TEST(reflections_are_followed_as_often_as_the_courses)
{
    check((Counts){"reflections.scn", 95935, 118573, 114328, 237146});
}

TEST(large_meshes_are_hit_as_often_as_the_courses)
{
    check((Counts){"cow.scn", 95935, 95935, 0, 191870});
    check((Counts){"buddha.scn", 95935, 95935, 0, 191870});
}
