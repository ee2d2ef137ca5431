// SPDX-License-Identifier: MIT
// The effect of each key; view/status_text.c lists the keys.
#include "view/state.h"

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

static int limited(int value, int low, int high)
{
    return value < low ? low : value > high ? high : value;
}

static void change_level(State *state, const StateScene *scene, int step)
{
    state->boxes = state->boxes || step > 0;
    if (state->boxes)
        state->level = (uint32_t)limited((int)state->level + step, 0, (int)scene->levels);
}

// Returns the setting that a key toggles, or NULL.
static bool *switch_of(State *state, int key)
{
    switch (key) {
    case 'r':
        return &state->traced;
    case 'a':
        return &state->smooth;
    case 'b':
        return &state->uses_bvh;
    case 'B':
        return &state->boxes;
    case 'n':
        return &state->normals;
    case 'h':
    case '?':
        return &state->help;
    case 't':
        return &state->text;
    case 'o':
        return &state->turning;
    case KEY_FULL_SCREEN:
        return &state->full_screen;
    default:
        return NULL;
    }
}

static void change_exposure(State *state, int step)
{
    state->exposure = limited(state->exposure + step, -EXPOSURE_LIMIT, EXPOSURE_LIMIT);
}

static void apply_arrow(State *state, int key)
{
    const int right = (key == KEY_RIGHT) - (key == KEY_LEFT);
    const int down = (key == KEY_DOWN) - (key == KEY_UP);
    if (right != 0 || down != 0)
        turn(state, ARROW_PIXELS * right, ARROW_PIXELS * down);
}

static void apply_key(State *state, const StateScene *scene, int key)
{
    bool *turned = switch_of(state, key);
    if (turned != NULL)
        *turned = !*turned;
    if (key == 'B')
        state->level = 0;
    if (key == ']' || key == '[')
        change_level(state, scene, key == ']' ? 1 : -1);
    if (key == '+' || key == '=' || key == '-')
        change_exposure(state, key == '-' ? -1 : 1);
    if (key >= '1' && key <= '9')
        choose_view(state, scene, (uint32_t)(key - '0'));
    apply_arrow(state, key);
}

static unsigned command_of(int key)
{
    switch (key) {
    case 'c':
        return COMMAND_CAMERA;
    case 's':
        return COMMAND_SAVE;
    case 'u':
        return COMMAND_UP;
    case 'R':
        return COMMAND_RELOAD;
    case 'q':
        return COMMAND_QUIT;
    default:
        return 0;
    }
}

unsigned state_apply(State *state, const Event *event, const StateScene *scene)
{
    int key = event->key;
    if (key == KEY_ESCAPE)
        key = state->full_screen ? KEY_FULL_SCREEN : 'q';
    switch (event->kind) {
    case EVENT_KEY:
        apply_key(state, scene, key);
        return command_of(key);
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
    state->level = (uint32_t)limited((int)state->level, 0, (int)scene->levels);
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
