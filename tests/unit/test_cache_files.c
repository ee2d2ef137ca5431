// SPDX-License-Identifier: MIT
// Damaged files of the kernel cache, and files of other programs, are never read. test_cache.py
// tests that clrt then compiles and stores the program again.
#include "device/cache.h"
#include "unit/cmocka_all.h"
#include "unit/random.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SIZE 1000

static const char *const keys[] = {"0123456789abcdef0123456789abcdef",
                                   "0123456789abcdef0123456789abcdee"};
static Cache cache;
static char paths[2][CACHE_PATH_SIZE + 64];
static char binaries[2][SIZE];

static bool is_read(int program)
{
    CachedBinary binary;
    const bool ok = cache_read(&cache, keys[program], &binary);
    if (ok) {
        assert_int_equal(binary.size, SIZE);
        assert_memory_equal(binary.bytes, binaries[program], SIZE);
        file_free(&binary.file);
    }
    return ok;
}

static void store_both(void)
{
    for (int i = 0; i < 2; i++) {
        cache_write(&cache, keys[i], binaries[i], SIZE);
        assert_true(is_read(i));
    }
}

static void write_bytes(const char *path, const char *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

TEST(shorter_and_longer_files_are_not_read)
{
    static const size_t sizes[] = {0, 7, 8, 9, (8 + SIZE) / 2, 8 + SIZE - 1, 8 + SIZE + 1};
    char bytes[8 + SIZE + 1] = "";
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        store_both();
        FILE *file = fopen(paths[0], "rb");
        assert_int_equal(fread(bytes, 1, sizeof bytes, file), 8 + SIZE);
        fclose(file);
        write_bytes(paths[0], bytes, sizes[i]);
        assert_true(cache_has(&cache, keys[0]));
        assert_false(is_read(0));
        assert_true(is_read(1));
    }
}

TEST(files_with_a_flipped_bit_are_not_read)
{
    char bytes[8 + SIZE];
    uint64_t random = 1;
    store_both();
    FILE *file = fopen(paths[0], "rb");
    assert_int_equal(fread(bytes, 1, sizeof bytes, file), sizeof bytes);
    fclose(file);
    for (uint32_t i = 0; i < 300; i++) {
        const uint32_t bit = i < 64 ? i : random_below(&random, 8 * sizeof bytes);
        bytes[bit / 8] ^= (char)(1 << bit % 8);
        write_bytes(paths[0], bytes, sizeof bytes);
        assert_false(is_read(0));
        bytes[bit / 8] ^= (char)(1 << bit % 8);
    }
    write_bytes(paths[0], bytes, sizeof bytes);
    assert_true(is_read(0));
}

TEST(files_of_other_programs_are_not_read)
{
    char other[sizeof paths[0] + 8];
    store_both();
    snprintf(other, sizeof other, "%s.other", paths[0]);
    assert_int_equal(rename(paths[0], other), 0);
    assert_false(is_read(0));
    assert_int_equal(rename(paths[1], paths[0]), 0);
    assert_int_equal(rename(other, paths[1]), 0);
    assert_false(is_read(0) || is_read(1));
    store_both();
}

SET_UP(make_folder)
{
    strcpy(cache.folder, "/tmp/clrt-cache-XXXXXX");
    for (int i = 0; i < SIZE; i++) {
        binaries[0][i] = (char)(7 * i);
        binaries[1][i] = (char)(5 * i);
    }
    const bool ok = mkdtemp(cache.folder) != NULL;
    for (int i = 0; i < 2; i++)
        snprintf(paths[i], sizeof paths[i], "%s/%s.bin", cache.folder, keys[i]);
    return !ok;
}

TEAR_DOWN(remove_folder)
{
    return unlink(paths[0]) + unlink(paths[1]) + rmdir(cache.folder);
}
