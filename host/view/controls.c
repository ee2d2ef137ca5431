// SPDX-License-Identifier: MIT
// Applies keys and mouse actions to the state. A table lists the actions for users.
#include "view/controls.h"

#include <stddef.h>

// All of these constants except DEGREES_PER_RADIAN come from the viewer of the UvA course
// (scene/scene.c).

#define DEGREES_PER_PIXEL  0.25
#define LENGTH_PER_PIXEL   0.15
#define WHEEL_FACTOR       0.9
#define COURSE_HEIGHT      512.0
#define AZIMUTH_LIMIT      89.99
#define NEAREST            0.5
#define FARTHEST           100.0
#define COURSE_DISTANCE    6.5
#define COURSE_FOV         45.0
#define DEGREES_PER_RADIAN 57.295779513082320877

// Computes three perpendicular axes. The last axis is `up`. If `up` is z, the first two axes are x
// and y, as the angles of the UvA course require.
static void make_axes(Vec3 axes[3], Vec3 up)
{
    const Vec3 z = vec3_normalize(up);
    const double x = fabs(z.x), y = fabs(z.y);
    const Vec3 other = x <= fabs(z.z) || x <= y ? vec3(1, 0, 0) : vec3(0, 1, 0);
    axes[0] = vec3_normalize(vec3_sub(other, vec3_scale(z, vec3_dot(other, z))));
    axes[1] = vec3_cross(z, axes[0]);
    axes[2] = z;
}

// Returns the height of a perspective picture at distance 1.
static double unit_height(const Orbit *orbit)
{
    const double half = orbit->camera.fov_degrees / 2;
    return 2 * sine_of_degrees(half) / cosine_of_degrees(half);
}

// Returns the distance from which a perspective picture shows objects at the pivot in their current
// size.
static double shown_distance(const Orbit *orbit)
{
    return orbit->camera.height > 0 ? orbit->camera.height / unit_height(orbit) : orbit->distance;
}

Orbit orbit_of(const Viewpoint *viewpoint, bool is_course)
{
    Orbit orbit = {.camera = *viewpoint, .pivot = is_course ? vec3(0, 0, 0) : viewpoint->look_at};
    if (!(viewpoint->fov_degrees > 0))
        orbit.camera.fov_degrees = COURSE_FOV;
    make_axes(orbit.axes, viewpoint->up);
    const Vec3 arm = vec3_sub(viewpoint->eye, orbit.pivot);
    const double x = vec3_dot(arm, orbit.axes[0]), y = vec3_dot(arm, orbit.axes[1]);
    const double z = vec3_dot(arm, orbit.axes[2]);
    orbit.distance = sqrt(x * x + y * y + z * z);
    orbit.azimuth = -atan2(z, sqrt(x * x + y * y)) * DEGREES_PER_RADIAN;
    orbit.rotation = atan2(y, x) * DEGREES_PER_RADIAN;
    orbit.unit = is_course ? 1 : shown_distance(&orbit) / COURSE_DISTANCE;
    return orbit;
}

Viewpoint orbit_viewpoint(const Orbit *orbit)
{
    const double radius = orbit->distance * cosine_of_degrees(orbit->azimuth);
    const double x = radius * cosine_of_degrees(orbit->rotation);
    const double y = radius * sine_of_degrees(orbit->rotation);
    const double z = -orbit->distance * sine_of_degrees(orbit->azimuth);
    const Vec3 across = vec3_add(vec3_scale(orbit->axes[0], x), vec3_scale(orbit->axes[1], y));
    const Vec3 arm = vec3_add(across, vec3_scale(orbit->axes[2], z));
    Viewpoint viewpoint = orbit->camera;
    viewpoint.eye = vec3_add(orbit->pivot, arm);
    return viewpoint;
}

static double limited(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

// Turns the camera by a mouse drag, and limits the azimuth (controls.h).
static void orbit_turn(Orbit *orbit, double right, double down)
{
    orbit->rotation = fmod(orbit->rotation - DEGREES_PER_PIXEL * right, 360);
    orbit->azimuth =
        limited(orbit->azimuth - DEGREES_PER_PIXEL * down, -AZIMUTH_LIMIT, AZIMUTH_LIMIT);
}

// Shows objects at the pivot in the size that they have in a perspective picture from `distance`.
// An orthographic camera does not move, but the height of its picture changes.
static void set_shown_distance(Orbit *orbit, double distance)
{
    const double shown = limited(distance, NEAREST * orbit->unit, FARTHEST * orbit->unit);
    const double factor = shown / shown_distance(orbit);
    if (orbit->camera.height > 0) {
        orbit->camera.height *= factor;
        orbit->camera.width *= factor;
    } else {
        orbit->distance = shown;
    }
}

// Switches between perspective and orthographic pictures. The scale at the pivot stays the same.
static void orbit_switch_perspective(Orbit *orbit)
{
    const double distance = shown_distance(orbit), height = distance * unit_height(orbit);
    const double half = orbit->camera.width_degrees / 2;
    const double width = 2 * distance * sine_of_degrees(half) / cosine_of_degrees(half);
    const bool becomes_orthographic = orbit->camera.height == 0;
    orbit->distance = distance;
    orbit->camera.height = becomes_orthographic ? height : 0;
    orbit->camera.width = becomes_orthographic ? width : 0;
}

// Scales the distance by a mouse drag. At the course's distance, the speed is the course's.
static void orbit_zoom(Orbit *orbit, double down)
{
    set_shown_distance(orbit,
                       shown_distance(orbit) * exp(LENGTH_PER_PIXEL / COURSE_DISTANCE * down));
}

// Moves camera and pivot parallel to the picture by a mouse drag. In a window that is COURSE_HEIGHT
// pixels high, the pivot moves exactly as far as the pointer.
static void orbit_pan(Orbit *orbit, double right, double down)
{
    const Viewpoint view = orbit_viewpoint(orbit);
    const Vec3 ahead = vec3_normalize(vec3_sub(view.look_at, view.eye));
    const Vec3 across = vec3_normalize(vec3_cross(ahead, view.up));
    const double height = shown_distance(orbit) * unit_height(orbit) / COURSE_HEIGHT;
    const Vec3 step = vec3_add(vec3_scale(across, -height * right),
                               vec3_scale(vec3_cross(across, ahead), height * down));
    orbit->pivot = vec3_add(orbit->pivot, step);
    orbit->camera.look_at = vec3_add(orbit->camera.look_at, step);
}

// Zooms by notches of the mouse wheel. Positive notches, away from the user, zoom in.
static void orbit_wheel(Orbit *orbit, double notches)
{
    set_shown_distance(orbit, shown_distance(orbit) * pow(WHEEL_FACTOR, notches));
}

#define ARROW_PIXELS      20
#define DEGREES_A_SECOND  20.0
#define PIXELS_PER_DEGREE 4.0
#define EXPOSURE_LIMIT    16

static void choose_view(State *state, const StateScene *scene, uint32_t view)
{
    if (view < 1 || view > scene->viewpoint_count)
        return;
    state->view = view;
    state->moved = false;
    state->camera = scene->viewpoints[view - 1];
    state->orbit = orbit_of(&state->camera, scene->is_course);
}

State state_begin(const StateScene *scene, State state)
{
    state.text = true;
    choose_view(&state, scene, state.view);
    return state;
}

static void move(State *state)
{
    state->camera = orbit_viewpoint(&state->orbit);
    state->moved = true;
}

static void turn(State *state, double right, double down)
{
    orbit_turn(&state->orbit, right, down);
    move(state);
}

static void change_depth(State *state, const StateScene *scene, int step)
{
    state->boxes = state->boxes || step > 0;
    if (state->boxes)
        state->box_depth = (uint32_t)limited((int)state->box_depth + step, 0, (int)scene->deepest);
}

// The user's actions, in the order of the help. A row with keys toggles a setting or has a command.
// apply_key, state_apply and the window handle the actions of the other rows.
static const struct {
    const char *name, *help;
    int keys[2];    // 0 if unused
    size_t toggled; // offset of a bool in State
    unsigned command;
} actions[] = {
#define NO_KEY        {0}, 0, 0
#define TOGGLE(field) offsetof(State, field), 0
#define RUN(command)  0, command
    {"left drag, arrows", "turn the camera", NO_KEY},
    {"middle or Shift drag", "move the camera sideways", NO_KEY},
    {"right drag, wheel", "move closer or away", NO_KEY},
    {"click", "explain the pixel", NO_KEY},
    {"1-9", "the scene's cameras", NO_KEY},
    {"r", "rays or OpenGL, which draws glass as a grid", {'r'}, TOGGLE(traced)},
    {"a", "anti-alias the resting picture or not", {'a'}, TOGGLE(smooth)},
    {"+ -", "exposure", NO_KEY},
    {"o", "turn continuously", {'o'}, TOGGLE(turning)},
    {"p", "perspective or orthographic", NO_KEY},
    {"u", "another up axis of a mesh without a scene", {'u'}, RUN(COMMAND_UP)},
    {"n", "normals", {'n'}, TOGGLE(normals)},
    {"] [", "boxes of the tree, a level deeper or back", NO_KEY},
    {"B", "boxes of the tree's leaves", {'B'}, TOGGLE(boxes)},
    {"b", "trace with or without the tree", {'b'}, TOGGLE(uses_bvh)},
    {"c", "print the camera", {'c'}, RUN(COMMAND_CAMERA)},
    {"s, F12, Ctrl-S", "save the picture", {'s'}, RUN(COMMAND_SAVE)},
    {"R", "reload the scene and the kernels", {'R'}, RUN(COMMAND_RELOAD)},
    {"drop a file", "show that scene", NO_KEY},
    {"t", "show or hide the line at the top", {'t'}, TOGGLE(text)},
    {"h, ?, F1", "show or hide this help", {'h', '?'}, TOGGLE(help)},
    {"F11", "full screen", {KEY_FULL_SCREEN}, TOGGLE(full_screen)},
    {"Esc", "leave full screen, or quit", NO_KEY},
    {"q, Ctrl-Q", "quit", {'q'}, RUN(COMMAND_QUIT)},
};
#define ACTION_COUNT (sizeof actions / sizeof actions[0])

void controls_write_help(FILE *stream)
{
    for (size_t i = 0; i < ACTION_COUNT; i++)
        fprintf(stream, "%s  %s\n", actions[i].name, actions[i].help);
}

// If a row of the table has the key, toggles the row's setting and returns the row's command.
// Otherwise, returns 0.
static unsigned apply_action(State *state, int key)
{
    size_t i = 0;
    while (i < ACTION_COUNT && actions[i].keys[0] != key && actions[i].keys[1] != key)
        i++;
    if (i == ACTION_COUNT || key == 0)
        return 0;
    bool *toggled = (bool *)(void *)((char *)state + actions[i].toggled);
    if (actions[i].command == 0)
        *toggled = !*toggled;
    return actions[i].command;
}

static void change_exposure(State *state, int step)
{
    state->exposure = (int)limited(state->exposure + step, -EXPOSURE_LIMIT, EXPOSURE_LIMIT);
}

static void apply_arrow(State *state, int key)
{
    const int right = (key == KEY_RIGHT) - (key == KEY_LEFT);
    const int down = (key == KEY_DOWN) - (key == KEY_UP);
    if (right != 0 || down != 0)
        turn(state, ARROW_PIXELS * right, ARROW_PIXELS * down);
}

static unsigned apply_key(State *state, const StateScene *scene, int key)
{
    if (key == 'B')
        state->box_depth = 0;
    if (key == ']' || key == '[')
        change_depth(state, scene, key == ']' ? 1 : -1);
    if (key == '+' || key == '=' || key == '-')
        change_exposure(state, key == '-' ? -1 : 1);
    if (key == 'p') {
        orbit_switch_perspective(&state->orbit);
        move(state);
    }
    if (key >= '1' && key <= '9')
        choose_view(state, scene, (uint32_t)(key - '0'));
    apply_arrow(state, key);
    return apply_action(state, key);
}

unsigned state_apply(State *state, const Event *event, const StateScene *scene)
{
    int key = event->key;
    if (key == KEY_ESCAPE)
        key = state->full_screen ? KEY_FULL_SCREEN : 'q';
    switch (event->kind) {
    case EVENT_KEY:
        return apply_key(state, scene, key);
    case EVENT_CLICK:
        return COMMAND_EXPLAIN;
    case EVENT_TURN:
        turn(state, event->right, event->down);
        return 0;
    case EVENT_ZOOM:
        orbit_zoom(&state->orbit, event->down);
        break;
    case EVENT_PAN:
        orbit_pan(&state->orbit, event->right, event->down);
        break;
    case EVENT_WHEEL:
        orbit_wheel(&state->orbit, event->down);
        break;
    }
    move(state);
    return 0;
}

void state_advance(State *state, double seconds)
{
    if (state->turning)
        turn(state, -DEGREES_A_SECOND * PIXELS_PER_DEGREE * seconds, 0);
}

void state_adopt(State *state, const StateScene *scene)
{
    state->box_depth = (uint32_t)limited((int)state->box_depth, 0, (int)scene->deepest);
    if (!state->moved || state->view > scene->viewpoint_count)
        choose_view(state, scene, state->view <= scene->viewpoint_count ? state->view : 1);
}

void state_open(State *state, const StateScene *scene)
{
    state->view = 1;
    state->moved = false;
    state_adopt(state, scene);
}

double state_gain(const State *state)
{
    return exp2(state->exposure / 2.0);
}
