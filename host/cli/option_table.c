// SPDX-License-Identifier: MIT
// The table itself, in the order of --help.
#include "cli/option_table.h"

#include "cli/option_choice.h"

#include <assert.h>
#include <string.h>

const Option option_table[] = {
    {"output", 'o', "FILE", read_output, GROUP_OUTPUT, CLASS_NONE,
     "write the picture; its ending tells the format; - is standard output"},
    {"format", 0, "NAME", read_format, GROUP_OUTPUT, CLASS_NONE,
     "write this format, whatever the ending (png for standard output)"},
    {"encode", 0, "raw|srgb", read_encode, GROUP_OUTPUT, CLASS_NONE,
     "8-bit files: raw values (default) or srgb"},
    {"aov", 0, "LIST", read_aov, GROUP_OUTPUT, CLASS_NONE,
     "add channels to an EXR file; the names are below"},
    {"no-metadata", 0, NULL, read_no_metadata, GROUP_OUTPUT, CLASS_NONE,
     "leave out of the file what tells where the picture comes from"},
    {"hash", 0, NULL, read_hash, GROUP_OUTPUT, CLASS_NONE,
     "print a hash of the pixels, as they are traced, on standard output"},
    {"expect-hash", 0, "HASH", read_expect_hash, GROUP_OUTPUT, CLASS_NONE,
     "exit 1 where the pixels have another hash"},

    {"size", 's', "WxH", read_size, GROUP_PICTURE, CLASS_NONE,
     "size of the picture in pixels (the scene's, or 512x512)"},
    {"crop", 0, "X0,Y0,X1,Y1", read_crop, GROUP_PICTURE, CLASS_NONE,
     "draw the pixels from X0,Y0 up to and without X1,Y1 alone; with a dot in a number, all four "
     "are parts of the sides; an EXR file tells where they lie"},
    {"view", 0, "N", read_view, GROUP_PICTURE, CLASS_NONE,
     "look through the scene's N-th camera (1); without any, the course's six"},

    {"aa", 0, "[=N]", read_aa, GROUP_QUALITY, CLASS_STATISTICAL,
     "anti-alias with N x N samples a pixel (2)"},
    {"aa-adaptive", 0, "[=T]", read_aa_adaptive, GROUP_QUALITY, CLASS_STATISTICAL,
     "anti-alias where neighbors differ, down to a contrast of T in a pixel (0.02)"},
    {"max-level", 0, "N", read_max_level, GROUP_QUALITY, CLASS_BOUNDED,
     "rays of level N see the background (the scene's, or 3): off by at most R^N, R being the "
     "scene's highest reflectivity; auto: the least N for which that shows in no file"},
    {"error", 0, "E", read_error, GROUP_QUALITY, CLASS_STATISTICAL,
     "choose samples, levels and precision for a root mean square error of E, as 0.005 or 0.5%"},
    {"time", 0, "S", read_time, GROUP_QUALITY, CLASS_STATISTICAL,
     "choose the samples so that tracing takes S seconds"},
    {"precision", 0, "fp32|fp64", read_precision, GROUP_QUALITY, CLASS_STATISTICAL,
     "arithmetic: fp32 (default), or fp64, the reference, with rays one by one and pairs"},

    {"bvh", 0, "sah|midpoint", read_bvh, GROUP_SPEED, CLASS_EXACT,
     "build the tree by the surface area heuristic (default) or by midpoints; unless one is "
     "named, up to 32 triangles get none"},
    {"no-bvh", 0, NULL, read_no_bvh, GROUP_SPEED, CLASS_EXACT,
     "build no tree, test every triangle instead"},
    {"tile", 0, "WxH", read_tile, GROUP_SPEED, CLASS_EXACT,
     "size of the tiles that the picture is traced in (128x128)"},
    {"work-group", 0, "WxH", read_group, GROUP_SPEED, CLASS_EXACT,
     "size of the device's work-groups (8x8; 2x2 packets)"},
    {"specialize", 0, "auto|always|never", read_specialize, GROUP_SPEED, CLASS_EXACT,
     "compile kernels for the scene: where it pays (default), always or never"},
    {"kernel", 0, "auto|ray|packet", read_kernel, GROUP_SPEED, CLASS_EXACT,
     "trace rays one by one or packets of 4x4 pixels; auto (default) asks the device"},
    {"nodes", 0, "auto|pair|wide", read_nodes, GROUP_SPEED, CLASS_EXACT,
     "nodes of two children or of eight; auto (default) is what suits the kernel"},
    {"lanes", 0, "auto|4|8|16", read_lanes, GROUP_SPEED, CLASS_EXACT,
     "width of the kernels' vectors; auto (default) is the device's"},

    {"turntable", 0, "N", read_turntable, GROUP_JOB, CLASS_NONE,
     "draw N pictures, each with the camera turned by one N-th further about what it looks at; "
     "the file's name is numbered in place of its #### or before its ending"},
    {"frames", 0, "A-B[:S]", read_frames, GROUP_JOB, CLASS_NONE,
     "draw the views A to B, or those pictures of the turntable, or every S-th of them"},
    {"part", 0, "I/N", read_part_of, GROUP_JOB, CLASS_NONE,
     "draw every N-th tile alone, from the I-th on; clrt merge joins the N parts"},
    {"resume", 0, NULL, read_resume, GROUP_JOB, CLASS_EXACT,
     "keep finished tiles in FILE.part until the picture is whole, and go on from there or from an "
     "EXR file that was stopped"},

    {"device", 0, "SPEC", read_device, GROUP_DEVICE, CLASS_EXACT,
     "OpenCL device: PLATFORM:DEVICE, cpu, gpu or part of a name"},
    {"list-devices", 0, "[=text|json]", read_list_devices, GROUP_DEVICE, CLASS_NONE,
     "list the OpenCL devices"},
    {"threads", 'j', "N", read_threads, GROUP_DEVICE, CLASS_EXACT,
     "threads of a CPU device (all that the process may use)"},
    {"warm", 0, NULL, read_warm, GROUP_DEVICE, CLASS_NONE,
     "compile the kernels ahead, and those for SCENE where one is named; draw nothing"},

    {"stats", 0, "[=FILE]", read_stats, GROUP_STATISTICS, CLASS_NONE,
     "count rays and tests; as JSON with a FILE (- is standard output); time the window's frames"},
    {"reference", 0, "[=FILE]", read_reference, GROUP_STATISTICS, CLASS_NONE,
     "measure the picture against one in fp64 with many samples; write that to FILE"},
    {"reference-samples", 0, "N", read_reference_samples, GROUP_STATISTICS, CLASS_NONE,
     "samples a pixel of the reference, an even number (256)"},
    {"repeat", 0, "N", read_repeat, GROUP_STATISTICS, CLASS_NONE,
     "draw the picture N times, for timing: -v and --stats=FILE tell each (1)"},
    {"explain", 0, NULL, read_explain, GROUP_STATISTICS, CLASS_NONE,
     "tell what of the kernels and the scene's arrays is used, what is left out, why and what that "
     "saves, and draw nothing"},
    {"explain-pixel", 0, "X,Y", read_explain_pixel, GROUP_STATISTICS, CLASS_NONE,
     "tell how the color of a pixel comes about, ray by ray, and draw nothing; X counts from the "
     "left and Y from the top, both from 0"},

    {"bad-geometry", 0, "drop|fail", read_bad_geometry, GROUP_GEOMETRY, CLASS_NONE,
     "triangles of no area: drop (default) or fail, naming the first"},

    {"fail", 0, "LIMITS", read_fail, GROUP_REPORT, CLASS_NONE,
     "compare: exit 1 past rmse=V, max=V, share1=V, share4=V, hits=V or below psnr=V"},
    {"json", 0, "[=FILE]", read_json, GROUP_REPORT, CLASS_NONE,
     "write the report of check or compare, or an explanation, as JSON, to FILE or "
     "instead of the text"},

    {"keys", 0, "KEYS", read_keys, GROUP_WINDOW, CLASS_NONE,
     "press these keys in the window, each once the one before is shown"},
    {"quit-after", 0, "N", read_quit_after, GROUP_WINDOW, CLASS_NONE,
     "close the window after N frames, counted once the keys are played"},

    {"quiet", 'q', NULL, read_quiet, GROUP_TALK, CLASS_NONE, "say nothing but errors"},
    {"verbose", 'v', NULL, read_verbose, GROUP_TALK, CLASS_NONE, "say what is done and with what"},
    {"version", 0, NULL, read_version, GROUP_TALK, CLASS_NONE, "print the version"},
    {"help", 'h', NULL, read_help, GROUP_TALK, CLASS_NONE, "print this"},
};

const size_t option_count = sizeof option_table / sizeof option_table[0];
_Static_assert(sizeof option_table / sizeof option_table[0] <= OPTIONS_MOST,
               "who walks the table keeps room for OPTIONS_MOST");

const char *const option_group_names[OPTION_GROUPS] = {
    [GROUP_OUTPUT] = "Output",
    [GROUP_PICTURE] = "Picture",
    [GROUP_QUALITY] = "Quality",
    [GROUP_SPEED] = "Speed",
    [GROUP_JOB] = "Long jobs",
    [GROUP_DEVICE] = "Device",
    [GROUP_STATISTICS] = "Statistics",
    [GROUP_GEOMETRY] = "Geometry",
    [GROUP_REPORT] = "Reports of check and compare",
    [GROUP_WINDOW] = "Window",
    [GROUP_TALK] = "Talk",
};

const char *const option_class_names[OPTION_CLASSES] = {
    [CLASS_NONE] = "",
    [CLASS_EXACT] = "exact",
    [CLASS_BOUNDED] = "bounded",
    [CLASS_STATISTICAL] = "statistical",
};

const char *const option_class_meanings[OPTION_CLASSES] = {
    [CLASS_NONE] = "",
    [CLASS_EXACT] = "the same bits, whatever it is set to",
    [CLASS_BOUNDED] = "the picture is off by no more than the bound that is stated",
    [CLASS_STATISTICAL] = "how far off the picture is can be measured, not promised",
};

bool option_argument_is_optional(const Option *option)
{
    return option->argument != NULL && option->argument[0] == '[';
}

bool option_names_file(const Option *option)
{
    return option->argument != NULL && strstr(option->argument, "FILE") != NULL;
}

bool option_is_given(const Options *options, const char *name)
{
    size_t row = 0;
    while (row < option_count && strcmp(option_table[row].name, name) != 0)
        row++;
    assert(row < option_count);
    return (options->given >> row & 1) != 0;
}
