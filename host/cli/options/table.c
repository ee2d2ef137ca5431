// SPDX-License-Identifier: MIT
// The table of options, in the order of --help, and the table of commands. A scene file whose name
// is a command can be written as ./NAME.
#include "cli/options/option.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#define FIELD(kind, field) OPTION_##kind, offsetof(Options, field)
#define FLAG(field)        FIELD(FLAG, field), 0, NULL, NULL
#define ACTION(action)     OPTION_ACTION, 0, action, NULL, NULL
#define COUNT(field, most) FIELD(COUNT, field), most, NULL, NULL
#define AREA(field, most)  FIELD(AREA, field), most, NULL, NULL
#define WORD(field)        FIELD(WORD, field), 0, NULL, NULL
#define TEXT(field)        FIELD(TEXT, field), 0, NULL, NULL
#define ODD(setter)        OPTION_ODD, 0, 0, NULL, setter

const Option option_table[] = {
    {"output", "FILE", 'o', ODD(set_output), GROUP_OUTPUT, CLASS_NONE,
     FOR_FILE | FOR_COMPARE | FOR_MERGE,
     "write the picture; the file's ending sets the format; - is standard output"},
    {"format", "NAME", 0, ODD(set_format), GROUP_OUTPUT, CLASS_NONE,
     FOR_FILE | FOR_COMPARE | FOR_MERGE,
     "write this format regardless of the ending; without this option, standard output gets png"},
    {"encode", "raw|srgb", 0, WORD(encoding), GROUP_OUTPUT, CLASS_NONE,
     FOR_FILE | FOR_WINDOW | FOR_PIXEL, "values of 8-bit files: raw (default) or srgb"},
    {"exposure", "EV", 0, ODD(set_exposure), GROUP_OUTPUT, CLASS_NONE, FOR_FILE | FOR_WINDOW,
     "multiply the colors of 8-bit files by 2^EV; in the window, the keys + and - do this"},
    {"aov", "LIST", 0, ODD(set_aov), GROUP_OUTPUT, CLASS_NONE, FOR_FILE,
     "add channels to an EXR file; the names are below; all means every channel but error"},
    {"no-metadata", NULL, 0, FLAG(no_metadata), GROUP_OUTPUT, CLASS_NONE, FOR_FILE | FOR_MERGE,
     "omit the metadata that records how the picture was made"},
    {"hash", "[=EXPECTED]", 0, ODD(set_hash), GROUP_OUTPUT, CLASS_NONE, FOR_DRAWING | FOR_MERGE,
     "print the pixels' hash, or exit with status 1 unless it is EXPECTED; without -o, write no "
     "picture"},

    {"size", "WxH", 's', AREA(picture.width, PICTURE_SIZE_MAX), GROUP_PICTURE, CLASS_NONE,
     FOR_PICTURE | FOR_PIXEL | FOR_EXPLAIN,
     "size of the picture in pixels (default: the scene's, or 512x512)"},
    {"crop", "X0,Y0,X1,Y1", 0, ODD(set_crop), GROUP_PICTURE, CLASS_NONE, FOR_DRAWING,
     "draw only the pixels from X0,Y0 to X1,Y1 (exclusive); if a number has a dot, all four are "
     "fractions of the sides; an EXR file records the position"},
    {"view", "N", 0, COUNT(picture.view, VIEW_MOST), GROUP_PICTURE, CLASS_NONE,
     FOR_PICTURE | FOR_PIXEL,
     "use the scene's N-th camera (default: 1); a scene without cameras has six default ones"},
    {"up", "auto|x|y|z|-x|-y|-z", 0, WORD(load.up), GROUP_PICTURE, CLASS_NONE,
     FOR_SCENE | FOR_CONVERT,
     "axis that points up in a lone mesh (default: auto); auto chooses by format and shape"},
    {"normals", "flat|smooth", 0, ODD(set_normals), GROUP_PICTURE, CLASS_NONE,
     FOR_PICTURE | FOR_PIXEL | FOR_EXPLAIN | FOR_CONVERT,
     "normals of a lone mesh (default: smooth); flat ignores the file's normals, smooth computes "
     "missing ones; with smooth=DEGREES, edges with larger angles stay sharp (default: 33 or 70, "
     "by shape)"},
    {"studio", "hard|soft", 0, WORD(load.studio), GROUP_PICTURE, CLASS_NONE,
     FOR_SCENE | FOR_CONVERT,
     "shadows of a lone mesh (default: hard); soft ones take several times as long"},
    {"bad-geometry", "drop|fail", 0, WORD(bad_geometry), GROUP_PICTURE, CLASS_NONE,
     FOR_DRAWING | FOR_CONVERT | FOR_PIXEL | FOR_EXPLAIN,
     "drop triangles with equal corners, or fail at one without area; drop is the default"},

    {"aa", "[=N]", 0, FIELD(COUNT, picture.samples), SAMPLES_MAX, "2", NULL, GROUP_QUALITY,
     CLASS_STATISTICAL, FOR_PICTURE | FOR_PIXEL | FOR_EXPLAIN,
     "take N x N samples per pixel (default: 2); without this option, files of scenes get 1 sample "
     "and files of lone meshes 3 x 3; the window takes N x N when the camera rests, unless N is 1"},
    {"aa-adaptive", "[=T]", 0, FIELD(PART, picture.contrast), 0, "0.02", NULL, GROUP_QUALITY,
     CLASS_STATISTICAL, FOR_DRAWING | FOR_GENERAL | FOR_WARM,
     "add samples at thin parts and where neighbors differ (default: T = 0.02); the threshold of "
     "the difference is proportional to T"},
    {"max-level", "N|auto", 0, ODD(set_max_level), GROUP_QUALITY, CLASS_BOUNDED,
     FOR_PICTURE | FOR_PIXEL,
     "rays of level N see the background (default: the scene's max_level); the default of "
     "max_level is 3; "
     "without glass, the error is at most R^N, where R is the highest reflectivity; auto: the "
     "smallest N whose error is below half a step of the file's values, but at most 16 with glass, "
     "and always 16 with glass in float files"},
    {"error", "E", 0, ODD(set_error), GROUP_QUALITY, CLASS_STATISTICAL,
     FOR_DRAWING | FOR_GENERAL | FOR_WARM,
     "reach a root mean square error of E, such as 0.5%; clrt chooses samples, levels and "
     "precision"},
    {"time", "S", 0, ODD(set_time), GROUP_QUALITY, CLASS_STATISTICAL,
     FOR_DRAWING | FOR_GENERAL | FOR_WARM, "take as many samples as fit in S seconds of tracing"},
    {"precision", "fp32|fp64", 0, WORD(renderer.precision), GROUP_QUALITY, CLASS_STATISTICAL,
     FOR_KERNELS,
     "arithmetic: fp32 (default), or fp64 as a reference; fp64 traces single rays through pair "
     "nodes"},

    {"tune", "LIST", 0, ODD(set_tune), GROUP_SPEED, CLASS_EXACT, FOR_KERNELS,
     "settings for experiments, such as kernel=pair,tile=64x64; they change no bit of the picture"},
    {"tune kernel", "auto|pair|wide[:LANES]|packet[:LANES]", 0, ODD(set_kernel), GROUP_SPEED,
     CLASS_EXACT, FOR_KERNELS,
     "single rays through nodes of 2 (pair) or 8 children (wide), or packets of rays through nodes "
     "of 8; auto (default) chooses by the device; LANES is the width of vectors: 4, 8 or 16"},
    {"tune tile", "WxH", 0, AREA(picture.tile_width, PICTURE_SIZE_MAX), GROUP_SPEED, CLASS_EXACT,
     FOR_DRAWING, "size of the picture's tiles (default: 128x128, in parts 64x64)"},
    {"tune group", "WxH", 0, AREA(renderer.group_width, GROUP_SIDE_MOST), GROUP_SPEED, CLASS_EXACT,
     FOR_PICTURE | FOR_GENERAL | FOR_WARM,
     "size of work-groups (default: 8x8, on CPUs with wide nodes 2x2); on GPUs, the kernel may "
     "need another size"},
    {"tune specialize", "auto|always|never", 0, WORD(renderer.specialize), GROUP_SPEED, CLASS_EXACT,
     FOR_PICTURE | FOR_EXPLAIN | FOR_WARM,
     "compile kernels for the scene if it saves time (auto), always or never; auto is the default"},
    {"tune bvh", "auto|sah|midpoint|none", 0, WORD(renderer.tree), GROUP_SPEED, CLASS_EXACT,
     FOR_SCENE | FOR_WARM,
     "build the tree by surface areas, by midpoints or not at all; without a tree, rays test every "
     "triangle; auto (default) is sah, or none for wide nodes and at most 32 triangles"},

    {"turntable", "N", 0, COUNT(frames.turntable, FRAMES_MOST), GROUP_JOB, CLASS_NONE, FOR_FILE,
     "draw N pictures, and turn the camera by an N-th of a circle for each; the camera turns "
     "about its look-at point; numbers replace #### in the file's name or precede its ending; "
     "FILE.gif contains all pictures"},
    {"frames", "A-B[:S][,I/N]", 0, ODD(set_frames), GROUP_JOB, CLASS_NONE, FOR_FILE,
     "draw views A to B, or pictures A to B of the turntable, or the I-th of N equal runs of them; "
     "S: every S-th of them; auto/N: as for --part"},
    {"part", "I/N", 0, ODD(set_part), GROUP_JOB, CLASS_NONE, FOR_FILE,
     "draw only the I-th of N parts, or part auto/N in a job array; each has an N-th of the tiles, "
     "and clrt merge joins the N parts; auto takes I from the task number of Slurm, AWS Batch, "
     "Kubernetes or MPI"},
    {"resume", NULL, 0, FLAG(resume), GROUP_JOB, CLASS_EXACT, FOR_FILE,
     "keep finished tiles in FILE.part, and resume from them; for many pictures, skip those whose "
     "files exist"},

    {"device", "SPEC", 0, TEXT(renderer.device), GROUP_DEVICE, CLASS_EXACT, FOR_KERNELS,
     "OpenCL device: PLATFORM:DEVICE, cpu, gpu or part of a name"},
    {"threads", "N", 'j', COUNT(renderer.threads, THREADS_MOST), GROUP_DEVICE, CLASS_EXACT,
     FOR_KERNELS, "threads of a CPU device (default: all that the process may use)"},

    {"stats", NULL, 0, FLAG(picture.statistics), GROUP_REPORT, CLASS_NONE,
     FOR_PICTURE | FOR_EXPLAIN | FOR_GENERAL | FOR_WARM,
     "print the numbers of rays and tests; in the window, print frame times"},
    {"reference", "[=FILE]", 0, ODD(set_reference), GROUP_REPORT, CLASS_NONE, FOR_DRAWING,
     "measure the picture against a reference in fp64 with many samples; write the reference to "
     "FILE"},
    {"reference-samples", "N", 0, ODD(set_reference_samples), GROUP_REPORT, CLASS_NONE, FOR_DRAWING,
     "samples per pixel of the reference, an even number (default: 256)"},
    {"repeat", "N", 0, COUNT(repeat, REPEAT_MAX), GROUP_REPORT, CLASS_NONE, FOR_DRAWING,
     "draw the picture N times, for timing; -v and --json report each time (default: 1)"},
    {"fail", "LIMITS", 0, ODD(set_fail), GROUP_REPORT, CLASS_NONE, FOR_COMPARE,
     "exit with status 1 if a difference exceeds a limit, such as rmse=1%; LIMITS is a list of "
     "rmse=V, max=V, share1=V, share4=V and hits=V, or psnr=V, which is a lower limit"},
    {"json", "[=FILE]", 0, ODD(set_json), GROUP_REPORT, CLASS_NONE,
     FOR_DRAWING | FOR_CHECK | FOR_COMPARE | FOR_EXPLAIN | FOR_PIXEL | FOR_DEVICES,
     "write the report as JSON, to FILE or standard output; for a picture, it is the statistics"},

    {"keys", "KEYS", 0, TEXT(keys), GROUP_WINDOW, CLASS_NONE, FOR_WINDOW,
     "play these keys in the window, one per displayed frame; q closes it"},

    {"quiet", NULL, 'q', FLAG(quiet), GROUP_TALK, CLASS_NONE,
     FOR_KERNELS | FOR_COMPARE | FOR_MERGE | FOR_CONVERT, "print only errors"},
    {"verbose", NULL, 'v', FLAG(verbose), GROUP_TALK, CLASS_NONE, FOR_PICTURE | FOR_CONVERT,
     "print each step and its settings"},
    {"version", NULL, 0, ACTION(ACTION_VERSION), GROUP_TALK, CLASS_NONE, FOR_PICTURE,
     "print the version"},
    {"help", NULL, 'h', ACTION(ACTION_HELP), GROUP_TALK, CLASS_NONE, FOR_PICTURE,
     "print this help"},
};

const size_t option_count = sizeof option_table / sizeof option_table[0];
_Static_assert(sizeof option_table / sizeof option_table[0] <= OPTIONS_MOST,
               "arrays of OPTIONS_MOST hold the table");

const char *const option_group_names[OPTION_GROUPS] = {
    [GROUP_OUTPUT] = "Output",  [GROUP_PICTURE] = "Picture", [GROUP_QUALITY] = "Quality",
    [GROUP_SPEED] = "Speed",    [GROUP_JOB] = "Long jobs",   [GROUP_DEVICE] = "Device",
    [GROUP_REPORT] = "Reports", [GROUP_WINDOW] = "Window",   [GROUP_TALK] = "Messages",
};

const char *const option_class_names[OPTION_CLASSES] = {
    [CLASS_NONE] = "",
    [CLASS_EXACT] = "exact",
    [CLASS_BOUNDED] = "bounded",
    [CLASS_STATISTICAL] = "statistical",
};

const char *const option_class_meanings[OPTION_CLASSES] = {
    [CLASS_NONE] = "",
    [CLASS_EXACT] = "all values give the same bits",
    [CLASS_BOUNDED] = "the error is at most the stated bound",
    [CLASS_STATISTICAL] = "the error can be measured, but has no bound",
};

const Command command_table[] = {
    {"", "SCENE", 1, 1, ACTION_VIEW, FOR_WINDOW,
     "show a scene or a mesh in a window, where h lists the keys"},
    {"", "SCENE -o FILE", 1, 1, ACTION_RENDER, FOR_FILE, "draw the scene to a file"},
    {"", "SCENE --hash", 1, 1, ACTION_RENDER, FOR_HASH, "print the hash of the picture's pixels"},
    {"check", "SCENE", 1, 1, ACTION_CHECK, FOR_CHECK, "report faults in the scene's geometry"},
    {"compare", "PICTURE PICTURE", 2, 2, ACTION_COMPARE, FOR_COMPARE,
     "report how much two pictures differ; -o draws a map of the differences"},
    {"merge", "PART... -o FILE", 1, INT_MAX, ACTION_MERGE, FOR_MERGE,
     "join the EXR files of all parts (--part)"},
    {"convert", "SCENE FILE", 2, 2, ACTION_CONVERT, FOR_CONVERT,
     "write a scene or mesh as FILE; FILE is a .scn with a binary .ply per mesh beside it, or one "
     ".ply with all meshes"},
    {"explain", "SCENE", 1, 1, ACTION_EXPLAIN_SCENE, FOR_EXPLAIN,
     "explain which kernel features and buffers the scene uses; the others are listed with the "
     "reasons why they are left out"},
    {"explain", "SCENE X,Y", 2, 2, ACTION_EXPLAIN, FOR_PIXEL,
     "explain the color of a pixel, ray by ray; X counts from the left and Y from the top, both "
     "from 0"},
    {"warm", "", 0, 0, ACTION_WARM, FOR_GENERAL, "compile the kernels in advance"},
    {"warm", "SCENE", 1, 1, ACTION_WARM, FOR_WARM, "compile the kernels for the scene too"},
    {"devices", "", 0, 0, ACTION_DEVICES, FOR_DEVICES, "list the OpenCL devices"},
};

const size_t command_count = sizeof command_table / sizeof command_table[0];
_Static_assert(sizeof command_table / sizeof command_table[0] <= COMMANDS_MOST,
               "arrays of COMMANDS_MOST hold the table");

bool command_is_first(const Command *command)
{
    return command == command_table || strcmp(command[-1].name, command->name) != 0;
}

bool command_takes(const char *name, const Option *option)
{
    unsigned uses = 0;
    for (size_t i = 0; i < command_count; i++)
        if (strcmp(command_table[i].name, name) == 0)
            uses |= command_table[i].use;
    return (option->uses & uses) != 0;
}

void command_write(const Command *command, char text[COMMAND_TEXT_SIZE])
{
    const char *name = command->name, *operands = command->operands;
    snprintf(text, COMMAND_TEXT_SIZE, "clrt%s%s%s%s", name[0] != '\0' ? " " : "", name,
             operands[0] != '\0' ? " " : "", operands);
}
