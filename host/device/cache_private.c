// SPDX-License-Identifier: MIT
// Makes PoCL's private folder. The folder is named clrt-HOST-XXXXXX and contains a file that the
// process keeps locked. If the file is not locked, the process was killed. The next process that
// makes a private folder in the same place then removes the folder. The folder's name contains the
// host's name, because a network file system can hide the locks of other hosts. The library does
// not link this file, because the library never changes the environment.
#include "device/cache_private.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <fts.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

// The least free space, in bytes, of a private folder. PoCL unpacks binaries and preprocesses
// sources in the folder, and LLVM ends the process if the disk is full.
#define ROOM_LEAST ((unsigned long long)16 << 20)

#define LOCK_NAME    "/lock"
#define ATTEMPTS     10
#define PREFIX_SIZE  (HOST_NAME_MAX + 8)
#define PRIVATE_SIZE (CACHE_PATH_SIZE + sizeof LOCK_NAME)

// Returns whether the folder suits PoCL, which writes libraries there and loads them: the file
// system has enough free space and allows execution. Returns true if the file system does not
// report it.
static bool suits_pocl(const char *folder)
{
    struct statvfs disk;
    if (statvfs(folder, &disk) != 0)
        return true;
    const bool has_files = disk.f_files == 0 || disk.f_favail > 0;
    const bool has_bytes = (unsigned long long)disk.f_bavail * disk.f_frsize >= ROOM_LEAST;
    const bool has_room = disk.f_blocks == 0 || (has_files && has_bytes);
    return has_room && (disk.f_flag & ST_NOEXEC) == 0;
}

static void remove_tree(const char *path)
{
    char *const paths[] = {(char *)path, NULL};
    FTS *tree = fts_open(paths, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    if (tree == NULL)
        return;
    for (FTSENT *entry = fts_read(tree); entry != NULL; entry = fts_read(tree))
        if (entry->fts_info != FTS_D)
            remove(entry->fts_path);
    fts_close(tree);
}

static void lock_path(char path[PRIVATE_SIZE], const char *folder)
{
    snprintf(path, PRIVATE_SIZE, "%s" LOCK_NAME, folder);
}

// Returns whether no other process has removed the lock file. The file's link count would not show
// a removal, because network file systems rename open files instead of removing them.
static bool has_lock(const char *folder)
{
    char path[PRIVATE_SIZE];
    lock_path(path, folder);
    return access(path, F_OK) == 0;
}

// Opens and locks the lock file of a private folder. Returns -1 and sets errno on failure.
static int open_lock(const char *folder, int flags)
{
    char path[PRIVATE_SIZE];
    lock_path(path, folder);
    const int lock = open(path, O_RDWR | O_CLOEXEC | O_NOFOLLOW | flags, 0600);
    if (lock < 0 || flock(lock, LOCK_EX | LOCK_NB) == 0)
        return lock;
    close(lock);
    return -1;
}

static void write_prefix(char prefix[PREFIX_SIZE])
{
    char host[HOST_NAME_MAX + 1] = "";
    gethostname(host, sizeof host - 1);
    snprintf(prefix, PREFIX_SIZE, "clrt-%s-", host);
}

// Removes the private folder at `path` if its process has ended. rmdir may also remove the empty
// folder of a process that has not locked it yet. That process then makes another folder
// (make_private). A process creates the lock before all other files. If a folder has files but no
// lock, its process has therefore ended. Network file systems can leave such a folder, because they
// rename open files instead of removing them.
static void remove_abandoned(const char *path)
{
    struct stat status;
    if (lstat(path, &status) != 0 || !S_ISDIR(status.st_mode) || status.st_uid != geteuid() ||
        rmdir(path) == 0)
        return;
    const int lock = open_lock(path, 0);
    if (lock < 0 && errno != ENOENT)
        return;
    remove_tree(path);
    if (lock >= 0)
        close(lock);
}

static void remove_all_abandoned(const char *base)
{
    char prefix[PREFIX_SIZE], path[CACHE_PATH_SIZE];
    DIR *folder = opendir(base);
    write_prefix(prefix);
    for (const struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;)
        if (strncmp(entry->d_name, prefix, strlen(prefix)) == 0 &&
            snprintf(path, sizeof path, "%s/%s", base, entry->d_name) < CACHE_PATH_SIZE)
            remove_abandoned(path);
    if (folder != NULL)
        closedir(folder);
}

// Makes a folder and locks it. If another process removes the folder before it is locked, tries
// again.
static bool make_private(Cache *cache, const char *base)
{
    char prefix[PREFIX_SIZE];
    write_prefix(prefix);
    for (int attempt = 0; attempt < ATTEMPTS; attempt++) {
        const int length =
            snprintf(cache->private_folder, CACHE_PATH_SIZE, "%s/%sXXXXXX", base, prefix);
        if (length >= CACHE_PATH_SIZE || mkdtemp(cache->private_folder) == NULL)
            break;
        cache->private_lock = open_lock(cache->private_folder, O_CREAT);
        if (cache->private_lock >= 0 && has_lock(cache->private_folder))
            return true;
        cache_private_close(cache);
    }
    cache->private_folder[0] = '\0';
    return false;
}

static bool open_private(Cache *cache, const char *base)
{
    if (base == NULL || base[0] != '/')
        return false;
    remove_all_abandoned(base);
    return access(base, W_OK | X_OK) == 0 && suits_pocl(base) && make_private(cache, base);
}

void cache_private_open(Cache *cache)
{
    // By default, PoCL compiles a kernel twice: for the size of its first work-groups, and for all
    // sizes when its binary is stored. This setting omits the first compilation. Pictures take no
    // longer, and a start with an empty cache takes 0.70 to 0.77 times the processor time of PoCL's
    // default.
    setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
    cache_open(cache);
    const char *temporary = getenv("TMPDIR");
    const bool ok = open_private(cache, cache->folder) ||
                    open_private(cache, temporary != NULL ? temporary : "/tmp");
    // PoCL cannot create /dev/null/clrt. Without a usable folder, PoCL therefore lists no device.
    setenv("POCL_CACHE_DIR", ok ? cache->private_folder : "/dev/null/clrt", 1);
}

void cache_private_close(Cache *cache)
{
    if (cache->private_folder[0] == '\0')
        return;
    remove_tree(cache->private_folder);
    close(cache->private_lock);
    cache->private_folder[0] = '\0';
}
