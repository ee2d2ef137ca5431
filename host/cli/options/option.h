// SPDX-License-Identifier: MIT
// A row of the table of options, the setters that rows name, and rules about combinations of
// options.
#pragma once

#include "cli/options/options.h"

#include <stddef.h>

// --help lists the groups in this order.
typedef enum {
    GROUP_OUTPUT,
    GROUP_PICTURE,
    GROUP_QUALITY,
    GROUP_SPEED,
    GROUP_JOB,
    GROUP_DEVICE,
    GROUP_STATISTICS,
    GROUP_GEOMETRY,
    GROUP_REPORT,
    GROUP_WINDOW,
    GROUP_TALK,
    OPTION_GROUPS
} OptionGroup;

// The possible effect of a setting on the pixels.
typedef enum {
    CLASS_NONE,        // selects a different picture, or has no effect on pixels
    CLASS_EXACT,       // all values produce the same bits
    CLASS_BOUNDED,     // the error stays within a stated bound
    CLASS_STATISTICAL, // the error has no bound, but can be measured
    OPTION_CLASSES
} OptionClass;

typedef enum {
    OPTION_FLAG,   // no argument; stores true in a bool
    OPTION_ACTION, // no argument; stores limit in Options::action
    OPTION_COUNT,  // an integer from 1 to limit; stores a uint32_t
    OPTION_PART,   // a number above 0 and up to 1; stores a double
    OPTION_AREA,   // "WxH", each from 1 to limit; stores two uint32_t
    OPTION_WORD,   // one of the words in Option::argument; stores its index as an int
    OPTION_TEXT,   // any text; stores the pointer to it
    OPTION_ODD     // calls Option::set
} OptionKind;

// The commands and modes that accept an option.
enum {
    FOR_FILE = 1,      // writing a picture to a file
    FOR_WINDOW = 2,    // the window
    FOR_CHECK = 4,     // clrt check
    FOR_COMPARE = 8,   // clrt compare
    FOR_MERGE = 16,    // clrt merge
    FOR_CONVERT = 32,  // clrt convert
    FOR_PIXEL = 64,    // --explain-pixel
    FOR_EXPLAIN = 128, // --explain
    FOR_WARM = 256,    // --warm
    FOR_LIST = 512,    // --list-devices
    FOR_PICTURE = FOR_FILE | FOR_WINDOW,
    FOR_TRACING = FOR_PICTURE | FOR_CHECK | FOR_PIXEL | FOR_EXPLAIN, // uses that trace a scene
    FOR_KERNELS = FOR_TRACING | FOR_WARM                             // uses that compile kernels
};

// Parses text and stores the value in options. text is NULL if the argument was omitted.
typedef bool SetOption(Options *options, const char *text, Error *error);

typedef struct {
    const char *name;
    const char *argument; // for --help; "a|b" for OPTION_WORD; "[=X]" if optional; NULL: none
    char letter;          // the short form; 0: none
    OptionKind kind;
    size_t offset;        // of the field in Options
    int64_t limit;        // for OPTION_COUNT, OPTION_AREA and OPTION_ACTION
    const char *fallback; // the text if the command line omits the argument
    SetOption *set;       // for OPTION_ODD
    OptionGroup group;
    OptionClass class;
    unsigned uses;
    const char *help;
} Option;

bool option_argument_is_optional(const Option *option);

// Returns whether the option's argument is a file name.
bool option_names_file(const Option *option);

// Parses text and stores the value. On failure, the message names the option, or auto/N's variable.
bool option_store(const Option *option, Options *options, const char *text, Error *error);

// Rejects options that exclude each other, for any command.
bool options_check_conflicts(const Options *options, Error *error);

// Determines whether the picture goes to a file, to the window, or nowhere because only its hash is
// requested, and the file's format. Rejects options that do not apply there.
bool options_check_purpose(Options *options, Error *error);

// Rejects options without effect on the kernels of --warm without a scene.
bool options_check_general_kernels(const Options *options, Error *error);

// Checks the outputs of clrt compare, and determines the format of its picture if -o is given.
bool options_check_compare(Options *options, Error *error);

// Checks the outputs of clrt merge, which requires -o, and determines the format of its picture.
bool options_check_merge(Options *options, Error *error);

// Setters of options whose values fit none of the kinds.
SetOption set_output, set_format, set_exposure, set_aov, set_expect_hash, set_crop, set_max_level,
    set_error, set_time, set_frames, set_part, set_list_devices, set_stats, set_reference,
    set_reference_samples, set_normals, set_explain_pixel, set_fail, set_json;

// The table of all options. The parser, --help, the man page and the completions iterate over it.

#define OPTIONS_MOST 64

// Sorted by group.
extern const Option option_table[];
extern const size_t option_count; // at most OPTIONS_MOST

// The heading of a group.
extern const char *const option_group_names[OPTION_GROUPS];

// The name of a class and its meaning; both are "" for CLASS_NONE.
extern const char *const option_class_names[OPTION_CLASSES];
extern const char *const option_class_meanings[OPTION_CLASSES];

// Returns whether the command line contains the option. name must be in option_table.
bool option_is_given(const Options *options, const char *name);

// The commands. If the first operand names no command, clrt renders a scene.
typedef struct {
    const char *name;
    Action action;
    unsigned use;         // one FOR_... bit; the command accepts the options with this bit
    const char *operands; // the arguments after the name, for --help
    const char *help;
    const char *two_operands; // describes two file operands in messages; NULL: one scene, or parts
} Command;

extern const Command command_table[];
extern const size_t command_count; // excludes the commands that an option selects

// Returns the command called word, or NULL.
const Command *command_named(const char *word);

// Returns the command that an option such as --explain selects, or NULL.
const Command *command_of_action(Action action);

// Returns whether the command accepts the option. NULL stands for rendering.
bool command_takes(const Command *command, const Option *option);

// Writes the commands that accept the option, for example "clrt check or clrt compare".
void command_list_takers(const Option *option, char *text, size_t size);
