// SPDX-License-Identifier: MIT
// Checks a request for a picture by the rules of session/request.h, and words the messages about
// broken rules.
#include "library/drawing.h"

#include <stdio.h>
#include <string.h>

uint32_t clrt_channel_count(void)
{
    return (uint32_t)aov_count - 1; // without the last one, which needs a reference
}

bool clrt_channel_get(uint32_t number, ClrtChannelInfo *info, ClrtError *error)
{
    if (number >= clrt_channel_count())
        return library_fail(error, CLRT_ARGUMENT, "channel %u does not exist: there are %u", number,
                            clrt_channel_count());
    const Aov *aov = &aov_table[number];
    ClrtChannelInfo filled = {.components = aov_channel_count(aov), .is_integer = aov->is_integer};
    snprintf(filled.name, sizeof filled.name, "%s", aov->name);
    snprintf(filled.help, sizeof filled.help, "%s", aov->help);
    return argument_fill(error, "the info", info, &filled, sizeof filled);
}

static bool take_channel(AovSet *set, const ClrtChannel *channel, ClrtError *error)
{
    uint32_t row = 0;
    if (!argument_given(error, "a channel's name", channel->name) ||
        !argument_given(error, "a channel's memory", channel->values))
        return false;
    while (row < clrt_channel_count() && strcmp(aov_table[row].name, channel->name) != 0)
        row++;
    if (row == clrt_channel_count())
        return library_fail(error, CLRT_ARGUMENT, "there is no channel '%s'", channel->name);
    if ((*set >> row & 1) != 0)
        return library_fail(error, CLRT_ARGUMENT, "the channel '%s' occurs twice", channel->name);
    *set |= (AovSet)1 << row;
    return true;
}

static bool take_channels(Drawing *drawing, ClrtError *error)
{
    const ClrtPicture *wanted = &drawing->wanted;
    if (wanted->channel_count > 0 && !argument_given(error, "the channels", wanted->channels))
        return false;
    for (uint32_t i = 0; i < wanted->channel_count; i++)
        if (!take_channel(&drawing->channels, &wanted->channels[i], error))
            return false;
    return true;
}

static bool check_request(const Drawing *drawing, ClrtError *error)
{
    RequestFault fault;
    const ClrtPrecision precision = drawing->renderer->session.settings.wanted.precision;
    if (request_check(&drawing->wanted, drawing->channels, precision, &fault))
        return true;
    switch (fault.rule) {
    case REQUEST_NUMBER:
        return argument_number(error, fault.setting, fault.value, fault.low, fault.high);
    case REQUEST_EVEN:
        return library_fail(error, CLRT_ARGUMENT, "%s is odd", fault.setting);
    case REQUEST_FP64:
        return library_fail(error, CLRT_ARGUMENT, "%s is %g, and below %g needs the precision fp64",
                            fault.setting, fault.value, fault.low);
    default:
        return library_fail(error, CLRT_ARGUMENT, "%s and %s exclude each other", fault.setting,
                            fault.other);
    }
}

static bool resolve(Drawing *drawing, ClrtError *error)
{
    Viewpoint camera;
    const ClrtPicture *wanted = &drawing->wanted;
    const bool has_camera = wanted->camera != NULL;
    if (has_camera
            ? !scene_handle_take_camera(&camera, wanted->camera, error)
            : !scene_handle_check_view(drawing->handle, wanted->view > 0 ? wanted->view : 1, error))
        return false;
    const bool is_inside =
        request_resolve(wanted, drawing->scene, has_camera ? &camera : NULL, &drawing->request);
    drawing->request.channels = drawing->channels;
    return is_inside || library_fail(error, CLRT_ARGUMENT, "the crop is not inside the picture");
}

static bool take_request(Drawing *drawing, const ClrtPicture *picture, ClrtError *error)
{
    ClrtResult unused;
    ClrtPicture *wanted = &drawing->wanted;
    drawing->scene = &drawing->handle->scene;
    return argument_struct(error, "the picture", picture, wanted, sizeof *wanted) &&
           (wanted->result == NULL ||
            argument_struct(error, "the result", wanted->result, &unused, sizeof unused)) &&
           take_channels(drawing, error) && check_request(drawing, error) &&
           resolve(drawing, error);
}

bool drawing_begin(Drawing *drawing, const ClrtPicture *picture, ClrtError *error)
{
    if (!renderer_handle_begin(drawing->renderer, drawing->handle, error))
        return false;
    if (take_request(drawing, picture, error))
        return true;
    drawing_end(drawing);
    return false;
}

void drawing_end(Drawing *drawing)
{
    renderer_handle_end(drawing->renderer);
}

// Fails if the caller's camera is too far from the scene. session_scene_take has checked the
// scene's own cameras.
static bool check_distance(Drawing *drawing, ClrtError *error)
{
    Error cause = {0};
    const Scene alone = {.viewpoints = {.data = &drawing->request.viewpoint, .count = 1}};
    return normalization_check(&drawing->renderer->session.scene.normalization, &alone, &cause) ||
           library_fail_for(error, CLRT_ARGUMENT, &cause);
}

bool drawing_take_scene(Drawing *drawing, ClrtError *error)
{
    return renderer_handle_take(drawing->renderer, drawing->handle, error) &&
           check_distance(drawing, error);
}

// A picture without a goal is complete after its last tile, so the result of the last call of
// `progress` has no effect.
bool drawing_continues(void *context, const RenderProgress *progress)
{
    Drawing *drawing = context;
    const ClrtPicture *wanted = &drawing->wanted;
    if (drawing->is_stopped) // this tile was in progress when the caller stopped the picture
        return false;
    const bool continues = wanted->progress == NULL ||
                           wanted->progress(wanted->user, progress->tiles_done, progress->tiles);
    drawing->tiles_done = progress->tiles_done;
    drawing->tiles = progress->tiles;
    drawing->is_stopped =
        !continues && (progress->tiles_done < progress->tiles || goal_is_given(wanted));
    return !drawing->is_stopped;
}
