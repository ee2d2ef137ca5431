// SPDX-License-Identifier: MIT
// The kernels that the process loads during a build show which of PoCL's files belong to the
// program. Other drivers' files stay unknown and unchecked, so their programs have empty manifests.
#include "device/cache_check.h"

#include "device/manifest.h"

#include <dirent.h>
#include <fts.h>
#include <link.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char prefix[] = "built-";

static void manifest_path(const Cache *cache, const char *key, char path[MANIFEST_PATH_SIZE])
{
    snprintf(path, MANIFEST_PATH_SIZE, "%s/%s%s", cache->folder, prefix, key);
}

bool cache_has_program(const Cache *cache, const char *key)
{
    char path[MANIFEST_PATH_SIZE];
    manifest_path(cache, key, path);
    char *manifest = cache->folder[0] != '\0' ? manifest_read(path) : NULL;
    free(manifest);
    return manifest != NULL;
}

// Appends the lines of all intact manifests in the folder.
static bool append_manifests(const Cache *cache, Lines *lines)
{
    char path[MANIFEST_PATH_SIZE];
    DIR *folder = opendir(cache->folder);
    bool ok = folder != NULL && lines_append(lines, "");
    for (const struct dirent *entry; ok && (entry = readdir(folder)) != NULL;) {
        if (strncmp(entry->d_name, prefix, strlen(prefix)) != 0)
            continue;
        manifest_path(cache, entry->d_name + strlen(prefix), path);
        char *manifest = manifest_read(path);
        ok = manifest == NULL || lines_append(lines, manifest);
        free(manifest);
    }
    if (folder != NULL)
        closedir(folder);
    return ok;
}

static void remove_unlisted(const Cache *cache, const char *listed)
{
    char *const paths[] = {(char *)cache->kernels, NULL};
    const size_t head = strlen(cache->kernels) + 1;
    FTS *tree = fts_open(paths, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    if (tree == NULL)
        return;
    for (FTSENT *entry = fts_read(tree); entry != NULL; entry = fts_read(tree)) {
        if (entry->fts_info != FTS_D || entry->fts_level != PROGRAM_LEVEL)
            continue;
        if (strstr(listed, entry->fts_path + head) == NULL)
            cache_remove(entry->fts_path);
        fts_set(tree, entry, FTS_SKIP);
    }
    fts_close(tree);
}

// Removes the programs that no manifest lists, because they may be damaged.
static void sweep(const Cache *cache)
{
    Lines listed = {0};
    if (append_manifests(cache, &listed))
        remove_unlisted(cache, listed.data);
    free(listed.data);
}

// Removes the program's folder. Every line of the manifest names a file in it.
static void remove_program(const Cache *cache, const char *manifest)
{
    char path[2 * MANIFEST_PATH_SIZE];
    const char *file = strchr(manifest, ' ') + 1;
    const size_t first = strcspn(file, "/") + 1;
    const size_t length = first + strcspn(file + first, "/");
    snprintf(path, sizeof path, "%s/%.*s", cache->kernels, (int)length, file);
    cache_remove(path);
}

// The kernels that this process has loaded from PoCL's folder.
typedef struct {
    const char *folder;
    unsigned count;
    char newest[MANIFEST_PATH_SIZE]; // path of the latest one, relative to folder
} LoadedKernels;

static int count_loaded(struct dl_phdr_info *object, size_t size, void *context)
{
    LoadedKernels *kernels = context;
    const size_t length = strlen(kernels->folder);
    const char *name = object->dlpi_name;
    (void)size;
    if (length > 0 && strncmp(name, kernels->folder, length) == 0 && name[length] == '/') {
        kernels->count++;
        snprintf(kernels->newest, sizeof kernels->newest, "%s", name + length + 1);
    }
    return 0;
}

static LoadedKernels find_loaded(const Cache *cache)
{
    LoadedKernels kernels = {.folder = cache->kernels};
    dl_iterate_phdr(count_loaded, &kernels);
    return kernels;
}

static void drop_manifest(CacheCheck *build, const char *path)
{
    remove_program(build->cache, build->manifest);
    remove(path);
    free(build->manifest);
    build->manifest = NULL;
}

void cache_check_begin(CacheCheck *build, const Cache *cache, const char *key)
{
    char path[MANIFEST_PATH_SIZE];
    *build = (CacheCheck){.cache = cache, .key = key};
    build->is_announced = cache->announce != NULL && !cache_has_program(cache, key);
    if (build->is_announced)
        cache->announce(true);
    build->lock = cache_lock(cache);
    if (cache->folder[0] == '\0')
        return;
    build->loaded_count = find_loaded(cache).count;
    manifest_path(cache, key, path);
    build->manifest = manifest_read(path);
    if (build->manifest != NULL && !manifest_holds(build->manifest, cache->kernels))
        drop_manifest(build, path);
    if (build->manifest == NULL && cache->owns_kernels && build->lock >= 0)
        sweep(cache);
}

// Writes the program's manifest. It is empty if the process loaded no new kernel from PoCL's folder
// during the build, because the program's files are then unknown.
static void write_manifest(const CacheCheck *build, LoadedKernels *kernels)
{
    char path[MANIFEST_PATH_SIZE];
    Lines lines = {0};
    char *program = kernels->newest;
    for (int level = 0; level < KERNEL_LEVEL && strrchr(program, '/') != NULL; level++)
        *strrchr(program, '/') = '\0';
    manifest_path(build->cache, build->key, path);
    if (lines_append(&lines, "") && (kernels->count == build->loaded_count ||
                                     manifest_list(&lines, build->cache->kernels, program)))
        manifest_write(path, lines.data);
    free(lines.data);
}

void cache_check_end(CacheCheck *build, bool works)
{
    if (works && build->cache->folder[0] != '\0') {
        LoadedKernels kernels = find_loaded(build->cache);
        const bool has_more = kernels.count > build->loaded_count;
        if (build->manifest == NULL ||
            (has_more && strstr(build->manifest, kernels.newest) == NULL))
            write_manifest(build, &kernels);
    }
    cache_unlock(build->lock);
    if (build->is_announced)
        build->cache->announce(false);
    free(build->manifest);
    *build = (CacheCheck){.lock = -1};
}
