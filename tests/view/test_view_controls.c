// SPDX-License-Identifier: MIT
// Tests the effect of keys and mouse on the view's state, and the state's text.
#include "unit/parsed.h"
#include "view/controls.h"
#include "view/status_text.h"

#include <math.h>
#include <string.h>

typedef struct {
    Scene scene;
    StateScene facts;
    State state;
} Fixture;

static Fixture opened(const char *text)
{
    Fixture fixture = {.scene = parsed(text)};
    fixture.facts = (StateScene){fixture.scene.viewpoints.data, fixture.scene.viewpoints.count,
                                 fixture.scene.has_course_views, 3};
    fixture.state = state_begin(&fixture.facts, (State){.view = 1, .uses_bvh = true});
    return fixture;
}

static void release(Fixture *fixture)
{
    scene_free(&fixture->scene);
}

static unsigned press(Fixture *fixture, const char *keys)
{
    unsigned commands = 0;
    for (; *keys != '\0'; keys++) {
        const Event event = {.kind = EVENT_KEY, .key = *keys};
        commands = state_apply(&fixture->state, &event, &fixture->facts);
    }
    return commands;
}

static void happen(Fixture *fixture, EventKind kind, double right, double down)
{
    const Event event = {.kind = kind, .right = right, .down = down};
    assert_int_equal(state_apply(&fixture->state, &event, &fixture->facts), 0);
}

static bool near(double a, double b)
{
    return fabs(a - b) < 1e-9;
}

static bool same_place(Vec3 a, Vec3 b)
{
    return vec3_extent(vec3_sub(a, b)) < 1e-12;
}

TEST(the_courses_cameras_are_on_the_courses_orbits)
{
    static const double orbits[6][3] = {{-40, 25, 6.5}, {-27.5, -30.5, 2}, {-73.8, 37, 3.8},
                                        {46.2, 0, 6.2}, {-35, 172.8, 2.8}, {-80.3, 27, 1.1}};
    FREED_BY(release) Fixture fixture = opened("");
    for (int view = 0; view < 6; view++) {
        press(&fixture, (char[]){(char)('1' + view), '\0'});
        assert_int_equal(fixture.state.view, view + 1);
        assert_true(near(fixture.state.orbit.azimuth, orbits[view][0]));
        assert_true(near(fixture.state.orbit.rotation, orbits[view][1]));
        assert_true(near(fixture.state.orbit.distance, orbits[view][2]));
    }
}

TEST(a_camera_that_has_not_moved_is_the_scenes_to_the_bit)
{
    FREED_BY(release) Fixture fixture = opened("");
    press(&fixture, "3");
    assert_memory_equal(&fixture.state.camera, &fixture.scene.viewpoints.data[2],
                        sizeof fixture.state.camera);
}

TEST(an_orbit_gives_back_the_camera_it_was_made_of)
{
    FREED_BY(release)
    Fixture fixture =
        opened("up 1 2 -3\ncamera 4 5 6  1 0 2  30\nup 0 -1 0\ncamera 9 1 1 0 0 0 50");
    for (size_t view = 0; view < 2; view++) {
        const Viewpoint *camera = &fixture.scene.viewpoints.data[view];
        const Orbit orbit = orbit_of(camera, false);
        const Viewpoint back = orbit_viewpoint(&orbit);
        assert_true(same_place(back.eye, camera->eye) && same_place(back.up, camera->up));
        assert_true(same_place(back.look_at, camera->look_at));
        assert_true(back.fov_degrees == camera->fov_degrees);
    }
}

TEST(dragging_turns_a_quarter_degree_a_pixel_up_to_the_pole)
{
    FREED_BY(release) Fixture fixture = opened("");
    happen(&fixture, EVENT_TURN, 40, -20);
    assert_true(near(fixture.state.orbit.rotation, 15) && near(fixture.state.orbit.azimuth, -35));
    assert_true(fixture.state.moved);
    happen(&fixture, EVENT_TURN, 0, 1000);
    assert_true(near(fixture.state.orbit.azimuth, -89.99));
    happen(&fixture, EVENT_TURN, 0, -5000);
    assert_true(near(fixture.state.orbit.azimuth, 89.99));
}

// Computes the position of a point in a window of 512 x 512 pixels, relative to the center.
static void see(const Viewpoint *camera, Vec3 point, double place[2])
{
    const Vec3 ahead = vec3_normalize(vec3_sub(camera->look_at, camera->eye));
    const Vec3 across = vec3_normalize(vec3_cross(ahead, camera->up));
    const Vec3 arm = vec3_sub(point, camera->eye);
    const double pixel = vec3_dot(arm, ahead) * tan(camera->fov_degrees / 360 * M_PI) / 256;
    place[0] = vec3_dot(arm, across) / pixel;
    place[1] = vec3_dot(arm, vec3_cross(ahead, across)) / pixel;
}

// Returns the height that a camera shows at its look-at point.
static double shown_height(const Viewpoint *camera)
{
    const Vec3 arm = vec3_sub(camera->look_at, camera->eye);
    return camera->height > 0
               ? camera->height
               : 2 * sqrt(vec3_dot(arm, arm)) * tan(camera->fov_degrees / 360 * M_PI);
}

TEST(p_switches_perspective_and_keeps_the_size_of_the_target)
{
    static const char *const cameras[] = {"camera 5 4 3  1 0 2  30 40",
                                          "camera 50 40 30  1 0 2  orthographic 3"};
    for (int i = 0; i < 2; i++) {
        FREED_BY(release) Fixture fixture = opened(cameras[i]);
        const Viewpoint before = fixture.state.camera;
        press(&fixture, "p");
        assert_true(fixture.state.moved);
        assert_int_equal(fixture.state.camera.height > 0, i == 0);
        assert_true(near(shown_height(&fixture.state.camera), shown_height(&before)));
        happen(&fixture, EVENT_WHEEL, 0, 2);
        assert_true(near(shown_height(&fixture.state.camera), 0.81 * shown_height(&before)));
        press(&fixture, "p");
        assert_int_equal(fixture.state.camera.height > 0, i == 1);
        assert_true(near(shown_height(&fixture.state.camera), 0.81 * shown_height(&before)));
        press(&fixture, "1");
        assert_memory_equal(&fixture.state.camera, &before, sizeof before);
    }
}

TEST(an_orthographic_camera_zooms_in_its_place)
{
    FREED_BY(release) Fixture fixture = opened("camera 5 4 3  1 0 2  orthographic 4 6");
    const Viewpoint before = fixture.state.camera;
    happen(&fixture, EVENT_WHEEL, 0, -1);
    assert_true(same_place(fixture.state.camera.eye, before.eye));
    assert_true(near(fixture.state.camera.height, 4 / 0.9));
    assert_true(near(fixture.state.camera.width, 6 / 0.9));
    happen(&fixture, EVENT_TURN, 30, 10);
    assert_true(near(fixture.state.camera.height, 4 / 0.9));
}

TEST(the_target_follows_a_drag_sideways)
{
    double place[2];
    FREED_BY(release) Fixture fixture = opened("camera 5 4 3  1 0 2  30");
    const Viewpoint before = fixture.state.camera;
    happen(&fixture, EVENT_PAN, 40, -25);
    const Viewpoint *after = &fixture.state.camera;
    see(after, before.look_at, place);
    assert_true(near(place[0], 40) && near(place[1], -25) && fixture.state.moved);
    assert_true(
        same_place(vec3_sub(after->look_at, after->eye), vec3_sub(before.look_at, before.eye)));
    happen(&fixture, EVENT_PAN, -40, 25);
    assert_true(same_place(fixture.state.camera.eye, before.eye));
}

TEST(zooming_has_the_speed_and_the_limits_of_the_course)
{
    FREED_BY(release) Fixture fixture = opened("");
    happen(&fixture, EVENT_ZOOM, 0, 0.01);
    assert_true(fabs(fixture.state.orbit.distance - 6.5015) < 1e-5);
    happen(&fixture, EVENT_ZOOM, 0, -1000);
    assert_true(near(fixture.state.orbit.distance, 0.5));
    happen(&fixture, EVENT_ZOOM, 0, 10000);
    assert_true(near(fixture.state.orbit.distance, 100));
    happen(&fixture, EVENT_WHEEL, 0, 1);
    assert_true(near(fixture.state.orbit.distance, 90));
}

TEST(equal_drags_scale_the_distance_equally)
{
    FREED_BY(release) Fixture fixture = opened("");
    happen(&fixture, EVENT_ZOOM, 0, -30);
    const double once = fixture.state.orbit.distance;
    happen(&fixture, EVENT_ZOOM, 0, -30);
    assert_true(near(fixture.state.orbit.distance, once * once / 6.5));
    happen(&fixture, EVENT_ZOOM, 0, 60);
    assert_true(near(fixture.state.orbit.distance, 6.5));
}

TEST(scenes_of_any_size_zoom_alike)
{
    FREED_BY(release) Fixture fixture = opened("camera 6500 0 0  0 0 0  45");
    happen(&fixture, EVENT_ZOOM, 0, 0.01);
    assert_true(fabs(fixture.state.orbit.distance - 6501.5) < 1e-2);
    happen(&fixture, EVENT_ZOOM, 0, -1000);
    assert_true(near(fixture.state.orbit.distance, 500));
}

TEST(every_switch_has_a_key_that_turns_it_back)
{
    FREED_BY(release) Fixture fixture = opened("");
    press(&fixture, "rabBn?o");
    const State on = fixture.state;
    assert_true(on.traced && on.smooth && !on.uses_bvh && on.boxes && on.normals && on.help);
    assert_true(on.turning && on.text);
    press(&fixture, "rabBnhot");
    const State off = fixture.state;
    assert_false(off.traced || off.smooth || !off.uses_bvh || off.boxes || off.normals);
    assert_false(off.help || off.turning || off.text);
}

TEST(levels_go_from_the_leaves_to_the_deepest_inner_nodes)
{
    FREED_BY(release) Fixture fixture = opened("");
    press(&fixture, "[");
    assert_false(fixture.state.boxes);
    press(&fixture, "]]");
    assert_true(fixture.state.boxes);
    assert_int_equal(fixture.state.box_depth, 2);
    press(&fixture, "]]]]");
    assert_int_equal(fixture.state.box_depth, 3);
    press(&fixture, "[");
    assert_int_equal(fixture.state.box_depth, 2);
    press(&fixture, "[[[[");
    assert_int_equal(fixture.state.box_depth, 0);
    press(&fixture, "]BB");
    assert_int_equal(fixture.state.box_depth, 0); // hiding and showing boxes selects the leaves
}

TEST(exposure_goes_by_half_stops)
{
    FREED_BY(release) Fixture fixture = opened("");
    assert_true(state_gain(&fixture.state) == 1);
    press(&fixture, "++");
    assert_true(state_gain(&fixture.state) == 2);
    press(&fixture, "------");
    assert_true(state_gain(&fixture.state) == 0.25);
    press(&fixture, "====");
    assert_true(state_gain(&fixture.state) == 1);
}

TEST(commands_are_given_and_change_nothing)
{
    FREED_BY(release) Fixture fixture = opened("");
    const State before = fixture.state;
    assert_int_equal(press(&fixture, "c"), COMMAND_CAMERA);
    assert_int_equal(press(&fixture, "s"), COMMAND_SAVE);
    assert_int_equal(press(&fixture, "R"), COMMAND_RELOAD);
    assert_int_equal(press(&fixture, "q"), COMMAND_QUIT);
    assert_int_equal(press(&fixture, "\033"), COMMAND_QUIT);
    assert_int_equal(press(&fixture, "zZ7"), 0);
    const Event click = {.kind = EVENT_CLICK, .right = 3, .down = 4};
    assert_int_equal(state_apply(&fixture.state, &click, &fixture.facts), COMMAND_EXPLAIN);
    assert_memory_equal(&before, &fixture.state, sizeof before);
}

TEST(escape_leaves_full_screen_before_the_window)
{
    FREED_BY(release) Fixture fixture = opened("");
    const Event full = {.kind = EVENT_KEY, .key = KEY_FULL_SCREEN};
    assert_int_equal(state_apply(&fixture.state, &full, &fixture.facts), 0);
    assert_true(fixture.state.full_screen);
    assert_int_equal(press(&fixture, "\033"), 0);
    assert_false(fixture.state.full_screen);
    assert_int_equal(press(&fixture, "\033"), COMMAND_QUIT);
}

TEST(turning_moves_the_camera_with_time_alone)
{
    FREED_BY(release) Fixture fixture = opened("");
    state_advance(&fixture.state, 1);
    assert_false(fixture.state.moved);
    press(&fixture, "o");
    state_advance(&fixture.state, 1);
    assert_true(near(fixture.state.orbit.rotation, 45));
}

TEST(a_scene_read_again_moves_only_a_camera_at_its_place)
{
    FREED_BY(release) Fixture fixture = opened("camera 5 0 0 0 0 0 45");
    FREED_BY(release) Fixture changed = opened("camera 7 0 0 0 0 0 45");
    state_adopt(&fixture.state, &changed.facts);
    assert_true(fixture.state.camera.eye.x == 7);
    happen(&fixture, EVENT_TURN, 4, 0);
    const Viewpoint moved = fixture.state.camera;
    FREED_BY(release) Fixture again = opened("camera 9 0 0 0 0 0 45");
    again.facts.deepest = 1;
    press(&fixture, "B]]]");
    state_adopt(&fixture.state, &again.facts);
    assert_memory_equal(&moved, &fixture.state.camera, sizeof moved);
    assert_int_equal(fixture.state.box_depth, 1);
}

TEST(another_scene_is_seen_through_its_first_camera)
{
    FREED_BY(release) Fixture fixture = opened("camera 5 0 0 0 0 0 45\ncamera 6 0 0 0 0 0 45");
    FREED_BY(release) Fixture other = opened("camera 7 0 0 0 0 0 45\ncamera 8 0 0 0 0 0 45");
    press(&fixture, "2rn");
    happen(&fixture, EVENT_TURN, 4, 0);
    state_open(&fixture.state, &other.facts);
    assert_true(fixture.state.camera.eye.x == 7 && fixture.state.view == 1);
    assert_true(!fixture.state.moved && fixture.state.traced && fixture.state.normals);
}

TEST(the_printed_camera_is_read_back_to_the_bit)
{
    char text[STATUS_TEXT_SIZE] = "";
    FILE *stream = fmemopen(text, sizeof text, "w");
    FREED_BY(release) Fixture fixture = opened("up 0.1 0.2 0.9\ncamera 1 2 3  0.3 0.1 0  33.3");
    happen(&fixture, EVENT_TURN, 17, 31);
    assert_non_null(stream);
    status_text_camera(&fixture.state, stream);
    fclose(stream);
    assert_memory_equal(text, "azimuth ", 8);
    FREED_BY(release) Fixture back = opened(strchr(text, '\n'));
    assert_memory_equal(&back.state.camera, &fixture.state.camera, sizeof back.state.camera);
}

TEST(the_title_shows_view_and_progress)
{
    char text[256];
    FREED_BY(release) Fixture fixture = opened("");
    const WorkerRequest request = {.is_traced = true};
    WorkerStatus status = {.busy = "", .progress = 0.375};
    const Figures figures = {&fixture.state, &request, &status, .scene_name = "a.scn"};
    status_text_store(status_text_title, &figures, text, sizeof text);
    assert_string_equal(text, "a.scn - OpenGL - clrt");
    press(&fixture, "r");
    status_text_store(status_text_title, &figures, text, sizeof text);
    assert_string_equal(text, "a.scn - ray traced - clrt - 38 %");
    status.reached.divisor = 1;
    status_text_store(status_text_title, &figures, text, sizeof text);
    assert_string_equal(text, "a.scn - ray traced - clrt");
}

TEST(the_line_starts_with_messages_and_the_panel_shows_failures_and_help)
{
    char text[STATUS_TEXT_SIZE];
    FREED_BY(release) Fixture fixture = opened("");
    const WorkerStatus status = {
        .busy = "",
        .reached = {.divisor = 2, .is_counted = true},
        .frame_seconds = 0.0123,
        .tallies = {[TALLY_CAMERA_RAYS] = 1000, [TALLY_TRIANGLE_TESTS] = 2500}};
    Figures figures = {.state = &fixture.state,
                       .status = &status,
                       .samples = 2,
                       .notice = "saved",
                       .missing = "no lights",
                       .hint = "h for help",
                       .failure = "a.scn:1: bad",
                       .explanation = "pixel 1,2\n"};
    press(&fixture, "ra");
    status_text_store(status_text_line, &figures, text, sizeof text);
    assert_string_equal(text, "saved, h for help, no lights, ray traced, view 1, AA 2x2, BVH on, "
                              "12.3 ms at 1/2, 1000 rays, 2.50 triangle tests per ray, "
                              "azimuth -40.00, rotation 25.00, distance 6.5");
    char small[16];
    status_text_store(status_text_line, &figures, small, sizeof small);
    assert_string_equal(small, "saved, h for he"); // long text is truncated
    status_text_store(status_text_panel, &figures, text, sizeof text);
    assert_string_equal(text, "a.scn:1: bad\npixel 1,2\n");
    press(&fixture, "th");
    status_text_store(status_text_panel, &figures, text, sizeof text);
    assert_non_null(strstr(text, "pixel 1,2\nleft drag, arrows  turn the camera\n"));
    assert_non_null(strstr(text, "\nq, Ctrl-Q  quit\n"));
}
