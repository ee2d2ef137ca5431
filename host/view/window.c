// SPDX-License-Identifier: MIT
// Opens a window by GLFW, and converts GLFW's callbacks to events. Letters arrive as characters
// instead of keys, so every keyboard layout works. The callbacks find the Window by GLFW's user
// pointer.
#include "view/window.h"

#include <epoxy/gl.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

// The pointer's largest motion during a click, in screen coordinates.
#define CLICK_DISTANCE 3

typedef struct {
    int major, minor, profile;
} Version;

static bool fail(const char *failure, Error *error)
{
    const char *reason = NULL;
    glfwGetError(&reason);
    return error_set(error, "%s can be opened (%s): write the picture with -o FILE", failure,
                     reason != NULL ? reason : "GLFW does not say why");
}

bool window_connect(Error *error)
{
#ifdef GLFW_PLATFORM
    // Selects X11, because libwayland prints its own message if there is no Wayland display.
    if (getenv("WAYLAND_DISPLAY") == NULL)
        glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    return glfwInit() || fail("no window", error);
}

static void add_event(GLFWwindow *handle, Event event)
{
    Window *window = glfwGetWindowUserPointer(handle);
    window->is_touched = true;
    if (window->event_count < WINDOW_EVENTS)
        window->events[window->event_count++] = event;
}

// Adds the event of a typed character. Keys that change a value step by step repeat while they are
// held. Other keys do not repeat.
static void take_character(GLFWwindow *handle, unsigned character)
{
    const Window *window = glfwGetWindowUserPointer(handle);
    if (character < 128 && (!window->is_repeating || strchr("+=-[]", (int)character) != NULL))
        add_event(handle, (Event){.kind = EVENT_KEY, .key = (int)character});
}

// Converts GLFW's key to a key of controls.h, or to 0. Ctrl with a letter yields no character, so
// find_key uses the letter's name.
static int find_key(int key, int code, int modifiers)
{
    static const int keys[][2] = {{GLFW_KEY_ESCAPE, KEY_ESCAPE},   {GLFW_KEY_LEFT, KEY_LEFT},
                                  {GLFW_KEY_RIGHT, KEY_RIGHT},     {GLFW_KEY_UP, KEY_UP},
                                  {GLFW_KEY_DOWN, KEY_DOWN},       {GLFW_KEY_F1, 'h'},
                                  {GLFW_KEY_F11, KEY_FULL_SCREEN}, {GLFW_KEY_F12, 's'}};
    const char *name = modifiers & GLFW_MOD_CONTROL ? glfwGetKeyName(key, code) : NULL;
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++)
        if (keys[i][0] == key)
            return keys[i][1];
    return name != NULL && (name[0] == 's' || name[0] == 'q') ? name[0] : 0;
}

// Adds the event of a key without a character. The only such keys that repeat while they are held
// are the arrows.
static void take_key(GLFWwindow *handle, int key, int code, int action, int modifiers)
{
    Window *window = glfwGetWindowUserPointer(handle);
    const int found = find_key(key, code, modifiers);
    const bool is_arrow = found >= KEY_LEFT && found <= KEY_DOWN;
    window->is_repeating = action == GLFW_REPEAT;
    if (found != 0 && (action == GLFW_PRESS || (action == GLFW_REPEAT && is_arrow)))
        add_event(handle, (Event){.kind = EVENT_KEY, .key = found});
}

// Stores the kind of a drag. As in F3D, the left button turns, the middle button pans, Shift with
// the left button pans, and the right button zooms. As in Blender, Ctrl with the middle button
// zooms. Shift and Ctrl must be pressed at the start of the drag. Returns false if no button is
// pressed.
static bool find_drag(GLFWwindow *handle, EventKind *kind)
{
    const bool left = glfwGetMouseButton(handle, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
    const bool middle = glfwGetMouseButton(handle, GLFW_MOUSE_BUTTON_MIDDLE) == GLFW_PRESS;
    const bool right = glfwGetMouseButton(handle, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    const Window *window = glfwGetWindowUserPointer(handle);
    const bool shift = window->modifiers & GLFW_MOD_SHIFT;
    const bool control = window->modifiers & GLFW_MOD_CONTROL;
    *kind = middle && control           ? EVENT_ZOOM
            : middle || (left && shift) ? EVENT_PAN
            : left                      ? EVENT_TURN
                                        : EVENT_ZOOM;
    return left || middle || right;
}

// Adds the event of a click, at the pointer's pixel.
static void add_click(GLFWwindow *handle)
{
    const Window *window = glfwGetWindowUserPointer(handle);
    int width, height, pixel_width, pixel_height;
    glfwGetWindowSize(handle, &width, &height);
    glfwGetFramebufferSize(handle, &pixel_width, &pixel_height);
    add_event(handle, (Event){.kind = EVENT_CLICK,
                              .right = floor(window->mouse_x * pixel_width / fmax(width, 1)),
                              .down = floor(window->mouse_y * pixel_height / fmax(height, 1))});
}

// A click uses the recorded position, because GLFW's own position may be newer than the click.
static void take_button(GLFWwindow *handle, int button, int action, int modifiers)
{
    Window *window = glfwGetWindowUserPointer(handle);
    if (action == GLFW_RELEASE && window->may_click)
        add_click(handle);
    window->modifiers = modifiers;
    window->may_click = action == GLFW_PRESS && button == GLFW_MOUSE_BUTTON_LEFT && modifiers == 0;
}

static void take_motion(GLFWwindow *handle, double x, double y)
{
    EventKind kind;
    Window *window = glfwGetWindowUserPointer(handle);
    const double right = x - window->mouse_x, down = y - window->mouse_y;
    if (window->may_click && fmax(fabs(right), fabs(down)) <= CLICK_DISTANCE)
        return;
    window->may_click = false;
    window->mouse_x = x;
    window->mouse_y = y;
    if (find_drag(handle, &kind))
        add_event(handle, (Event){.kind = kind, .right = right, .down = down});
}

static void take_scroll(GLFWwindow *handle, double right, double down)
{
    add_event(handle, (Event){.kind = EVENT_WHEEL, .right = right, .down = down});
}

// Keeps only the first of several dropped files, because the window shows one scene.
static void take_drop(GLFWwindow *handle, int count, const char **paths)
{
    Window *window = glfwGetWindowUserPointer(handle);
    if (count < 1)
        return;
    free(window->dropped);
    window->dropped = strdup(paths[0]);
    window->is_touched = true;
}

static void take_touch(GLFWwindow *handle)
{
    Window *window = glfwGetWindowUserPointer(handle);
    window->is_touched = true;
}

static void take_size(GLFWwindow *handle, int width, int height)
{
    (void)width, (void)height;
    take_touch(handle);
}

static void listen(Window *window)
{
    glfwSetWindowUserPointer(window->handle, window);
    glfwSetCharCallback(window->handle, take_character);
    glfwSetKeyCallback(window->handle, take_key);
    glfwSetMouseButtonCallback(window->handle, take_button);
    glfwSetCursorPosCallback(window->handle, take_motion);
    glfwSetScrollCallback(window->handle, take_scroll);
    glfwSetDropCallback(window->handle, take_drop);
    glfwSetWindowRefreshCallback(window->handle, take_touch);
    glfwSetWindowCloseCallback(window->handle, take_touch);
    glfwSetFramebufferSizeCallback(window->handle, take_size);
    glfwGetCursorPos(window->handle, &window->mouse_x, &window->mouse_y);
}

// If the size exceeds the screen, shrinks the size and keeps the aspect ratio.
static void fit_screen(uint32_t *width, uint32_t *height)
{
    int x, y, room_x = 0, room_y = 0;
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    if (monitor != NULL)
        glfwGetMonitorWorkarea(monitor, &x, &y, &room_x, &room_y);
    if (room_x <= 0 || room_y <= 0)
        return;
    const double wide = (double)room_x / *width, high = (double)room_y / *height;
    const double scale = wide < high ? wide : high;
    if (scale < 1) {
        *width = *width * scale > 1 ? (uint32_t)(*width * scale) : 1;
        *height = *height * scale > 1 ? (uint32_t)(*height * scale) : 1;
    }
}

static GLFWwindow *create(const Version *version, const char *title, uint32_t width,
                          uint32_t height)
{
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, version->major);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, version->minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, version->profile);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, version->profile == GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_CONTEXT_ROBUSTNESS, GLFW_LOSE_CONTEXT_ON_RESET);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
    return glfwCreateWindow((int)width, (int)height, title, NULL, NULL);
}

bool window_open(Window *window, const char *title, uint32_t width, uint32_t height, Error *error)
{
    static const Version versions[] = {{3, 3, GLFW_OPENGL_CORE_PROFILE},
                                       {3, 1, GLFW_OPENGL_ANY_PROFILE}};
    *window = (Window){.is_touched = true};
    fit_screen(&width, &height);
    for (size_t i = 0; i < sizeof versions / sizeof versions[0] && window->handle == NULL; i++)
        window->handle = create(&versions[i], title, width, height);
    if (window->handle == NULL)
        return fail("no window with OpenGL 3.1", error);
    glfwMakeContextCurrent(window->handle);
    glfwSwapInterval(1);
    listen(window);
    return true;
}

void window_close(Window *window)
{
    if (window->handle != NULL)
        glfwDestroyWindow(window->handle);
    free(window->dropped);
    *window = (Window){0};
}

void window_measure(const Window *window, uint32_t *width, uint32_t *height)
{
    int pixels[2] = {0, 0};
    glfwGetFramebufferSize(window->handle, &pixels[0], &pixels[1]);
    const bool is_minimized = glfwGetWindowAttrib(window->handle, GLFW_ICONIFIED) == GLFW_TRUE;
    *width = is_minimized ? 0 : (uint32_t)pixels[0];
    *height = is_minimized ? 0 : (uint32_t)pixels[1];
}

float window_density(const Window *window)
{
    float across, down;
    glfwGetWindowContentScale(window->handle, &across, &down);
    return fmaxf(across, 1);
}

void window_set_full_screen(Window *window, bool is_full_screen)
{
    GLFWmonitor *monitor = glfwGetPrimaryMonitor();
    int *place = window->place;
    if (window->is_full_screen == is_full_screen || monitor == NULL)
        return;
    window->is_full_screen = is_full_screen;
    if (is_full_screen) {
        const GLFWvidmode *mode = glfwGetVideoMode(monitor);
        glfwGetWindowPos(window->handle, &place[0], &place[1]);
        glfwGetWindowSize(window->handle, &place[2], &place[3]);
        glfwSetWindowMonitor(window->handle, monitor, 0, 0, mode->width, mode->height,
                             mode->refreshRate);
    } else {
        glfwSetWindowMonitor(window->handle, NULL, place[0], place[1], place[2], place[3], 0);
    }
}

bool window_is_lost(const Window *window)
{
    (void)window;
    return epoxy_has_gl_extension("GL_ARB_robustness") &&
           glGetGraphicsResetStatusARB() != GL_NO_ERROR;
}
