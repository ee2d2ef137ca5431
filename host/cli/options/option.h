// SPDX-License-Identifier: MIT
// The tables of options, of commands and of options that exclude each other, and the setters of
// options. The parser, --help, the man page and the completions all use these tables.
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
    OPTION_ACTION, // no argument; stores Option::limit in Options::action
    OPTION_COUNT,  // an integer from 1 to limit; stores a uint32_t
    OPTION_PART,   // a number above 0 and up to 1; stores a double
    OPTION_AREA,   // "WxH", each from 1 to limit; stores two uint32_t
    OPTION_WORD,   // one of the words in Option::argument; stores its index as an int
    OPTION_TEXT,   // any text; stores the pointer to it
    OPTION_ODD     // calls Option::set
} OptionKind;

// The commands that accept an option; one bit for each row of command_table.
enum {
    FOR_WINDOW = 1,
    FOR_FILE = 2,
    FOR_HASH = 4, // a picture is hashed, but not written
    FOR_CHECK = 8,
    FOR_COMPARE = 16,
    FOR_MERGE = 32,
    FOR_CONVERT = 64,
    FOR_EXPLAIN = 128,
    FOR_PIXEL = 256,
    FOR_GENERAL = 512, // clrt warm without a scene
    FOR_WARM = 1024,
    FOR_DEVICES = 2048,
    FOR_DRAWING = FOR_HASH | FOR_FILE,
    FOR_PICTURE = FOR_DRAWING | FOR_WINDOW,
    FOR_SCENE = FOR_PICTURE | FOR_CHECK | FOR_EXPLAIN | FOR_PIXEL, // traces a scene
    FOR_KERNELS = FOR_SCENE | FOR_GENERAL | FOR_WARM               // compiles kernels
};

// Parses `text` and stores the value in *options. `text` is NULL if the argument was omitted.
typedef bool SetOption(Options *options, const char *text, Error *error);

typedef struct {
    const char *name;
    const char *argument; // for --help; "a|b" for OPTION_WORD; "[=X]" if optional; NULL: none
    char letter;          // the short form; 0: none
    OptionKind kind;
    size_t offset;        // of the field in Options
    int64_t limit;        // for OPTION_COUNT, OPTION_AREA and OPTION_ACTION
    const char *fallback; // used if the command line omits the argument
    SetOption *set;       // for OPTION_ODD
    OptionGroup group;
    OptionClass class;
    unsigned uses;
    const char *help;
} Option;

bool option_argument_is_optional(const Option *option);

// Returns the key of --tune if the row's name is "tune KEY". Otherwise, returns NULL.
const char *option_key(const Option *option);

// Returns whether the option's argument is a file name.
bool option_names_file(const Option *option);

// Returns whether the command line contains the option. `name` must be in option_table.
bool option_is_given(const Options *options, const char *name);

// Parses `text` and stores the value. On failure, the message names the option or, for auto/N, the
// environment variable.
bool option_store(const Option *option, Options *options, const char *text, Error *error);

// A way to run clrt. A command with several uses, such as explain, has one row for each use.
typedef struct {
    const char *name;     // "": clrt shows or renders a scene
    const char *operands; // the words after the name, for --help
    int least, most;      // the number of operands
    Action action;
    unsigned use; // one FOR_... bit
    const char *help;
} Command;

#define COMMANDS_MOST 16

// Rows with the same name are adjacent.
extern const Command command_table[];
extern const size_t command_count; // at most COMMANDS_MOST

// Returns whether this is the first row with its name.
bool command_is_first(const Command *command);

// Returns whether any row with this name accepts the option.
bool command_takes(const char *name, const Option *option);

#define COMMAND_TEXT_SIZE 64

// Writes the command and its operands as a user types them.
void command_write(const Command *command, char text[COMMAND_TEXT_SIZE]);

// A rule on options that exclude each other, regardless of their values. Each of `names` excludes
// each of `others`. If `others` is empty, any two of `names` exclude each other.
#define EXCLUSION_NAMES 4
typedef struct {
    const char *names[EXCLUSION_NAMES], *others[EXCLUSION_NAMES]; // NULL: the rest is unused
} Exclusion;

extern const Exclusion exclusion_table[];
extern const size_t exclusion_count;

#define EXCLUSION_TEXT_SIZE 160

// Writes the options of a row in the syntax of a command line. "[--a | --b]" means that at most one
// of the options may be given. "[--a, --b | --c, --d]" means that no option on the left may be
// given together with one on the right.
void exclusion_write(const Exclusion *exclusion, char text[EXCLUSION_TEXT_SIZE]);

// Checks the options of a command and the combination of the options. Sets options that depend on
// others, such as the picture's format.
bool options_check(Options *options, const Command *command, Error *error);

// The setters of the options of kind OPTION_ODD. set_pixel parses an operand instead of an option.
SetOption set_output, set_format, set_exposure, set_aov, set_hash, set_crop, set_max_level,
    set_error, set_time, set_tune, set_kernel, set_frames, set_part, set_reference,
    set_reference_samples, set_normals, set_pixel, set_fail, set_json;

// The table of all options and of the keys of --tune.

#define OPTIONS_MOST 64

// Sorted by group.
extern const Option option_table[];
extern const size_t option_count; // at most OPTIONS_MOST

// The headings of the groups.
extern const char *const option_group_names[OPTION_GROUPS];

// The name and the meaning of each OptionClass. Both are "" for CLASS_NONE.
extern const char *const option_class_names[OPTION_CLASSES];
extern const char *const option_class_meanings[OPTION_CLASSES];
