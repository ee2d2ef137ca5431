// SPDX-License-Identifier: MIT
// A CPU device is opened in part where fewer units are asked for than it has.
#include "device/device.h"
#include "unit/cmocka_all.h"

#include <stdlib.h>

static Device open_part(uint32_t units)
{
    Device device;
    Error error = {0};
    if (!device_open_part(&device, getenv("CLRT_DEVICE"), units, &error))
        fail_msg("%s", error.text);
    return device;
}

static void a_cpu_gives_as_many_units_as_are_asked_for(void **state)
{
    (void)state;
    Device whole = open_part(UINT32_MAX);
    if (!whole.is_cpu || whole.compute_units < 2)
        print_message("%s is not divided: it is no CPU of several units\n", whole.name);
    for (uint32_t units = 1; whole.is_cpu && units < whole.compute_units; units++) {
        Device part = open_part(units), next = open_part(units);
        assert_int_equal(part.compute_units, units);
        assert_int_equal(next.compute_units, units);
        assert_string_equal(part.name, whole.name);
        device_close(&next);
        device_close(&part);
    }
    device_close(&whole);
}

static void more_units_than_there_are_is_the_whole_device(void **state)
{
    (void)state;
    Device whole = open_part(UINT32_MAX), more = open_part(whole.compute_units);
    assert_false(more.is_part);
    assert_int_equal(more.compute_units, whole.compute_units);
    device_close(&more);
    device_close(&whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cpu_gives_as_many_units_as_are_asked_for),
        cmocka_unit_test(more_units_than_there_are_is_the_whole_device),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
