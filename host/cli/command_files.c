// SPDX-License-Identifier: MIT
// Lists all files that the command line names, with their use as input or output. Every option that
// names a file must appear here.
#include "cli/commands.h"

#include "jobs/resume.h"

#include <stdlib.h>

static bool add_operands(FilePlan *plan, const Options *options, Error *error)
{
    const bool compares = options->action == ACTION_COMPARE,
               converts = options->action == ACTION_CONVERT;
    const char *one = options->scene_path, *other = options->other_path;
    for (int i = 0; i < options->part_count; i++)
        if (!file_plan_add(plan, FILE_INPUT, "the part ", options->part_paths[i], error))
            return false;
    return (one == NULL || file_plan_add(plan, FILE_INPUT, compares ? "the picture " : "the scene ",
                                         one, error)) &&
           (other == NULL ||
            file_plan_add(plan, converts ? FILE_OUTPUT : FILE_INPUT,
                          converts ? "the output " : "the picture ", other, error));
}

static bool add_frames(FilePlan *plan, const Options *options, Error *error)
{
    const Frames *frames = &options->frames;
    bool ok = true;
    for (uint32_t place = 0; ok && place < frames_count(frames); place++) {
        char *name = frames_name(options->output_path, frames_at(frames, place), error);
        ok = name != NULL && file_plan_add(plan, FILE_OUTPUT, "-o ", name, error);
        free(name);
    }
    return ok;
}

static bool add_journal(FilePlan *plan, const Options *options, Error *error)
{
    char *name = resume_journal_name(options->output_path, error);
    const bool ok = name != NULL && file_plan_add(plan, FILE_OUTPUT, "the journal ", name, error);
    free(name);
    return ok;
}

static bool add_outputs(FilePlan *plan, const Options *options, Error *error)
{
    const bool are_many = options->output_path != NULL && !options->frames.is_film &&
                          frames_are_many(&options->frames);
    const struct {
        const char *role, *path;
    } outputs[] = {
        {"-o ", are_many ? NULL : options->output_path},
        {"--reference=", options->reference_path},
        {"--json=", options->json_path},
    };
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++)
        if (outputs[i].path != NULL &&
            !file_plan_add(plan, FILE_OUTPUT, outputs[i].role, outputs[i].path, error))
            return false;
    return (!are_many || add_frames(plan, options, error)) &&
           (!options->resume || add_journal(plan, options, error));
}

bool command_files_add(FilePlan *plan, const Options *options, const Scene *scene, Error *error)
{
    for (size_t i = 0; scene != NULL && i < scene->inputs.count; i++)
        if (!file_plan_add(plan, FILE_INPUT, "the scene's file ", scene->inputs.data[i], error))
            return false;
    return add_operands(plan, options, error) && add_outputs(plan, options, error);
}

bool command_files_check(const Options *options, const Scene *scene, Error *error)
{
    FilePlan plan = {0};
    const bool ok =
        command_files_add(&plan, options, scene, error) && file_plan_check(&plan, error);
    file_plan_free(&plan);
    return ok;
}
