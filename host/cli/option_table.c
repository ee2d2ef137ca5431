// SPDX-License-Identifier: MIT
// The table itself, in the order of --help.
#include "cli/option_table.h"

#include "cli/option_choice.h"

const Option option_table[] = {
    {"output", 'o', "FILE", read_output,
     "write the picture; its ending tells the format; - is standard output"},
    {"format", 0, "NAME", read_format,
     "write this format, whatever the ending (png for standard output)"},
    {"size", 's', "WxH", read_size, "size of the picture in pixels (the scene's, or 512x512)"},
    {"view", 0, "N", read_view,
     "look through the scene's N-th camera (1); without any, the course's six"},
    {"aa", 0, "[=N]", read_aa, "anti-alias with N x N samples a pixel (2)"},
    {"aov", 0, "LIST", read_aov, "add channels to an EXR file; the names are below"},
    {"max-level", 0, "N", read_max_level, "rays of level N see the background (the scene's, or 3)"},
    {"bvh", 0, "KIND", read_bvh, "build the tree by sah (default) or midpoint"},
    {"no-bvh", 0, NULL, read_no_bvh, "test every triangle instead"},
    {"device", 0, "SPEC", read_device,
     "OpenCL device: PLATFORM:DEVICE, cpu, gpu or part of a name"},
    {"list-devices", 0, NULL, read_list_devices, "list the OpenCL devices"},
    {"threads", 'j', "N", read_threads, "threads of a CPU device (all that the process may use)"},
    {"tile", 0, "WxH", read_tile, "size of the tiles that the picture is traced in (128x128)"},
    {"work-group", 0, "WxH", read_group, "size of the device's work-groups (8x8; 2x2 packets)"},
    {"specialize", 0, "WHEN", read_specialize,
     "compile kernels for the scene: auto (default), always or never"},
    {"kernel", 0, "KIND", read_kernel,
     "trace rays one by one or packets of 4x4 pixels: auto (default), ray or packet"},
    {"nodes", 0, "KIND", read_nodes,
     "nodes of two children or of eight: auto (default), pair or wide"},
    {"lanes", 0, "N", read_lanes, "width of the kernels' vectors: auto (default), 4, 8 or 16"},
    {"precision", 0, "KIND", read_precision,
     "arithmetic: fp32 (default), or fp64, the reference, with rays one by one and pairs"},
    {"frames", 0, "N", read_frames,
     "draw the picture N times, for timing: -v and --stats=FILE tell each (1)"},
    {"warm", 0, NULL, read_warm,
     "compile the kernels ahead, and those for SCENE where one is named; draw nothing"},
    {"stats", 0, "[=FILE]", read_stats,
     "count rays and tests; as JSON with a FILE (- is standard output); time the window's frames"},
    {"encode", 0, "KIND", read_encode, "8-bit files: raw values (default) or srgb"},
    {"keys", 0, "KEYS", read_keys,
     "press these keys in the window, each once the one before is shown"},
    {"quit-after", 0, "N", read_quit_after,
     "close the window after N frames, counted once the keys are played"},
    {"bad-geometry", 0, "WHAT", read_bad_geometry,
     "triangles of no area: drop (default) or fail, naming the first"},
    {"json", 0, "[=FILE]", read_json, "clrt check: write the report as JSON, to FILE or instead"},
    {"quiet", 'q', NULL, read_quiet, "say nothing but errors"},
    {"verbose", 'v', NULL, read_verbose, "say what is done and with what"},
    {"version", 0, NULL, read_version, "print the version"},
    {"help", 'h', NULL, read_help, "print this"},
};

const size_t option_count = sizeof option_table / sizeof option_table[0];
_Static_assert(sizeof option_table / sizeof option_table[0] <= OPTIONS_MOST,
               "who walks the table keeps room for OPTIONS_MOST");

bool option_argument_is_optional(const Option *option)
{
    return option->argument != NULL && option->argument[0] == '[';
}
