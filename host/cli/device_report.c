// SPDX-License-Identifier: MIT
// Lists the OpenCL devices.
#include "cli/commands.h"

#include "image/json_file.h"
#include "session/session.h"

#include <stdio.h>

static json_t *device_json(const Device *device)
{
    char specification[32];
    snprintf(specification, sizeof specification, "%u:%u", device->platform_number, device->number);
    return JSON(
        FIELD("device", specification), FIELD("platform", device->platform),
        FIELD("name", device->name), FIELD("driver", device->version),
        FIELD("type", device_type_name(device)), FIELD("compute_units", device->compute_units),
        FIELD("largest_allocation", device->largest_allocation), FIELD("fp64", device->has_fp64),
        FIELD("correctly_rounded", device->correct_division),
        FIELD("denormals", device->has_denormals), FIELD("fma", device->has_fma));
}

static json_t *list_json(const DeviceList *list)
{
    json_t *devices = json_array();
    for (unsigned i = 0; i < list->count; i++)
        json_array_append_new(devices, device_json(&list->devices[i]));
    return REPORT(1, FIELD("devices", devices));
}

static ExitCode write(const DeviceList *list, const Options *options, Error *error)
{
    char text[DEVICE_TEXT_SIZE];
    device_list_text(list, text);
    if (!options_print_json(options))
        fputs(text, stdout);
    return options->json_path == NULL || json_file_write(list_json(list), options->json_path, error)
               ? EXIT_DONE
               : EXIT_OUTPUT;
}

ExitCode device_report_write(const Options *options, Error *error)
{
    Cache cache;
    DeviceList list;
    cache_open(&cache);
    const ExitCode code = device_list(&list, error) ? write(&list, options, error) : EXIT_DEVICE;
    cache_close(&cache);
    return code;
}
