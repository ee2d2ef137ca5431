// SPDX-License-Identifier: MIT
// The journal is not synced to disk. Written records survive the end of the process. Checksums
// detect records that a power failure left incomplete.
#include "jobs/journal.h"

#include <errno.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#define MAGIC "clrtjob1"

typedef struct {
    char magic[8];
    uint64_t key[2];
} Head;

typedef struct {
    uint64_t number, size, checksum;
} RecordHead;

bool journal_exists(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode) &&
           status.st_size >= (off_t)sizeof(Head);
}

static bool cannot(const Journal *journal, const char *what, Error *error)
{
    return error_set(error, "%s: cannot be %s: %s", journal->path, what, strerror(errno));
}

// A process killed at its start leaves a file shorter than a head, which gets a new head.
static bool check_head(const Journal *journal, const uint64_t key[2], Error *error)
{
    Head head;
    if (fread(&head, sizeof head, 1, journal->stream) != 1) {
        Head new = {.key = {key[0], key[1]}};
        memcpy(new.magic, MAGIC, sizeof new.magic);
        rewind(journal->stream);
        return (ftruncate(fileno(journal->stream), 0) == 0 &&
                fwrite(&new, sizeof new, 1, journal->stream) == 1 &&
                fflush(journal->stream) == 0) ||
               cannot(journal, "written", error);
    }
    if (memcmp(head.magic, MAGIC, sizeof head.magic) != 0)
        return error_set(error, "%s: is no journal of clrt", journal->path);
    return memcmp(head.key, key, sizeof head.key) == 0 ||
           error_set(error,
                     "%s: is of another scene, other settings or another version of clrt: remove "
                     "it to begin again",
                     journal->path);
}

// Returns whether the journal is a regular file. Reading from a pipe would block instead of
// failing.
static bool is_regular(const Journal *journal)
{
    struct stat status;
    return fstat(fileno(journal->stream), &status) == 0 && S_ISREG(status.st_mode);
}

bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error)
{
    *journal = (Journal){.path = path, .stream = fopen(path, "ab+e")};
    if (journal->stream == NULL)
        return cannot(journal, "opened", error);
    bool ok = is_regular(journal) || error_set(error, "%s: is no journal of clrt", path);
    ok = ok && (flock(fileno(journal->stream), LOCK_EX | LOCK_NB) == 0 ||
                error_set(error, "%s: another process draws this picture", path));
    rewind(journal->stream);
    ok = ok && check_head(journal, key, error);
    if (!ok)
        journal_close(journal, false);
    return ok;
}

static RecordHead head_of(const Journal *journal, const void *bytes, size_t size)
{
    return (RecordHead){journal->records, size,
                        XXH3_64bits_withSeed(bytes, size, journal->records)};
}

bool journal_read(Journal *journal, void *bytes, size_t size)
{
    RecordHead head;
    const long start = ftell(journal->stream);
    if (fread(&head, sizeof head, 1, journal->stream) == 1 && head.size == size &&
        fread(bytes, size, 1, journal->stream) == 1) {
        const RecordHead right = head_of(journal, bytes, size);
        if (memcmp(&head, &right, sizeof head) == 0) {
            journal->records++;
            return true;
        }
    }
    fseek(journal->stream, start, SEEK_SET);
    return false;
}

bool journal_cut(Journal *journal, Error *error)
{
    const long end = ftell(journal->stream);
    return (end >= 0 && ftruncate(fileno(journal->stream), end) == 0 &&
            fseek(journal->stream, end, SEEK_SET) == 0) ||
           cannot(journal, "written", error);
}

bool journal_add(Journal *journal, const void *bytes, size_t size, Error *error)
{
    const RecordHead head = head_of(journal, bytes, size);
    journal->records++;
    return (fwrite(&head, sizeof head, 1, journal->stream) == 1 &&
            fwrite(bytes, size, 1, journal->stream) == 1 && fflush(journal->stream) == 0) ||
           cannot(journal, "written", error);
}

void journal_close(Journal *journal, bool is_done)
{
    if (journal->stream == NULL)
        return;
    if (is_done)
        unlink(journal->path);
    fclose(journal->stream);
    *journal = (Journal){0};
}
