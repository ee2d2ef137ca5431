// SPDX-License-Identifier: MIT
// Lists the OpenCL devices.
#include "cli/commands.h"

#include "image/json_file.h"
#include "session/session.h"

#include <stdio.h>

static json_t *device_json(const ClrtDevice *facts)
{
    return JSON(FIELD("device", facts->device), FIELD("platform", facts->platform),
                FIELD("name", facts->name), FIELD("driver", facts->driver),
                FIELD("type", facts->type), FIELD("compute_units", facts->compute_units),
                FIELD("largest_allocation", facts->largest_allocation), FIELD("fp64", facts->fp64),
                FIELD("correctly_rounded", facts->correctly_rounded),
                FIELD("denormals", facts->denormals), FIELD("fma", facts->fma));
}

static json_t *list_json(const DeviceList *list)
{
    json_t *devices = json_array();
    for (unsigned i = 0; i < list->count; i++)
        json_array_append_new(devices, device_json(&list->devices[i].facts));
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

ExitCode devices_print(const Options *options, Error *error)
{
    Cache cache;
    DeviceList list;
    cache_private_open(&cache);
    const ExitCode code = device_list(&list, error) ? write(&list, options, error) : EXIT_DEVICE;
    cache_private_close(&cache);
    return code;
}
