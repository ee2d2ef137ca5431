// SPDX-License-Identifier: MIT
// Lists the OpenCL devices.
#include "cli/commands.h"

#include "device/cache.h"
#include "device/device.h"
#include "image/json_file.h"

#include <stdio.h>

#define SCHEMA_VERSION 1

static json_t *entry_json(const DeviceEntry *entry)
{
    char specification[32];
    const Device *device = &entry->device;
    snprintf(specification, sizeof specification, "%u:%u", entry->platform, entry->number);
    return json_pack("{s:s, s:o, s:o, s:o, s:s, s:i, s:I, s:b, s:b}", "device", specification,
                     "platform", json_file_path(device->platform), "name",
                     json_file_path(device->name), "driver", json_file_path(device->version),
                     "type", entry->type, "compute_units", (int)device->compute_units,
                     "largest_allocation", (json_int_t)device->largest_allocation, "fp64",
                     device->has_fp64, "correctly_rounded", device->correct_division);
}

static ExitCode write_json(Error *error)
{
    DeviceEntry entries[DEVICES_MOST];
    const unsigned count = device_entries(entries, error);
    if (count == 0)
        return EXIT_DEVICE;
    json_t *list = json_array();
    for (unsigned i = 0; i < count; i++)
        json_array_append_new(list, entry_json(&entries[i]));
    json_t *root = json_pack("{s:i, s:s, s:o}", "schema", SCHEMA_VERSION, "version", CLRT_VERSION,
                             "devices", list);
    return json_file_write(root, "-", error) ? EXIT_DONE : EXIT_OUTPUT;
}

static ExitCode write_text(Error *error)
{
    char list[8192];
    if (!device_list(list, sizeof list, error))
        return EXIT_DEVICE;
    fputs(list, stdout);
    return EXIT_DONE;
}

ExitCode device_report_write(bool as_json, Error *error)
{
    Cache cache;
    cache_open(&cache);
    const ExitCode code = as_json ? write_json(error) : write_text(error);
    cache_close(&cache);
    return code;
}
