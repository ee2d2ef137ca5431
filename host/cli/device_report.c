// SPDX-License-Identifier: MIT
// Lists the OpenCL devices.
#include "cli/commands.h"

#include "image/json_file.h"
#include "session/session.h"

#include <stdio.h>

#define SCHEMA_VERSION 1

static json_t *device_json(const Device *device)
{
    char specification[32];
    snprintf(specification, sizeof specification, "%u:%u", device->platform_number, device->number);
    return json_pack("{s:s, s:o, s:o, s:o, s:s, s:i, s:I, s:b, s:b}", "device", specification,
                     "platform", json_file_path(device->platform), "name",
                     json_file_path(device->name), "driver", json_file_path(device->version),
                     "type", device_type_name(device), "compute_units", (int)device->compute_units,
                     "largest_allocation", (json_int_t)device->largest_allocation, "fp64",
                     device->has_fp64, "correctly_rounded", device->correct_division);
}

static json_t *list_json(const DeviceList *list)
{
    json_t *devices = json_array();
    for (unsigned i = 0; i < list->count; i++)
        json_array_append_new(devices, device_json(&list->devices[i]));
    return json_pack("{s:i, s:s, s:o}", "schema", SCHEMA_VERSION, "version", CLRT_VERSION,
                     "devices", devices);
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
