// SPDX-License-Identifier: MIT
// Writes records, but does not sync them to disk. Written records survive if the process is killed.
// After a power failure, records may be incomplete. Their checksums detect this.
#include "jobs/journal.h"

#include "base/output_file.h"

#include <errno.h>
#include <fcntl.h>
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

static bool cannot(Journal *journal, const char *what, Error *error)
{
    journal->is_broken = true;
    return error_set(error, "%s: cannot be %s: %s", journal->path, what, strerror(errno));
}

// Compares the key in the file's head with `key`. A process that was killed at its start may have
// left an incomplete head, which is replaced.
static bool check_head(Journal *journal, const uint64_t key[2], Error *error)
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
        return error_set(error, "%s: is not a journal of clrt", journal->path);
    return memcmp(head.key, key, sizeof head.key) == 0 ||
           error_set(
               error,
               "%s: belongs to another scene, other settings or another version of clrt: remove "
               "it to begin again",
               journal->path);
}

// Returns whether the journal is a regular file. Reading from a pipe would block.
static bool is_regular(const Journal *journal)
{
    struct stat status;
    return fstat(fileno(journal->stream), &status) == 0 && S_ISREG(status.st_mode);
}

// Locks the journal. On file systems without locks, flock fails with an error other than
// EWOULDBLOCK. take_lock ignores these errors, because journal_claim also prevents concurrent
// appends.
static bool take_lock(Journal *journal, Error *error)
{
    journal->is_busy =
        flock(fileno(journal->stream), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    return !journal->is_busy ||
           error_set(error, "%s: another process draws this picture: try again later",
                     journal->path);
}

// Returns whether the journal's path still names the open file.
static bool is_current(const Journal *journal)
{
    struct stat named, opened;
    return stat(journal->path, &named) == 0 && fstat(fileno(journal->stream), &opened) == 0 &&
           named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
}

static void close_stream(Journal *journal)
{
    if (journal->stream != NULL)
        fclose(journal->stream);
    journal->stream = NULL;
}

bool journal_open(Journal *journal, const char *path, const uint64_t key[2], Error *error)
{
    *journal = (Journal){.path = path, .stream = fopen(path, "ab+e")};
    if (journal->stream == NULL)
        return cannot(journal, "opened", error);
    bool ok = is_regular(journal) || error_set(error, "%s: is not a journal of clrt", path);
    ok = ok && take_lock(journal, error);
    rewind(journal->stream);
    ok = ok && check_head(journal, key, error);
    if (!ok)
        close_stream(journal);
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

// Copies the records read so far into `stream`, a locked file that does not have the journal's name
// yet. Fails if another process has claimed the journal.
static bool fill_file(Journal *journal, FILE *stream, Error *error)
{
    const long end = ftell(journal->stream);
    rewind(journal->stream);
    if (stream == NULL || end < 0 || !output_file_copy(journal->stream, stream) ||
        ftruncate(fileno(stream), end) != 0)
        return cannot(journal, "written", error);
    journal->is_busy = !is_current(journal);
    return !journal->is_busy ||
           error_set(error, "%s: another process draws this picture: try again later",
                     journal->path);
}

bool journal_claim(Journal *journal, Error *error)
{
    OutputFile file;
    Error cause = {0};
    journal->is_broken = !output_file_begin(&file, journal->path, error);
    if (journal->is_broken)
        return false;
    // output_file_end closes file.lock. The stream owns a duplicate, which keeps the lock.
    const int copy = fcntl(file.lock, F_DUPFD_CLOEXEC, 0);
    FILE *stream = copy < 0 ? NULL : fdopen(copy, "ab+");
    const bool filled = fill_file(journal, stream, error);
    if (!output_file_end(&file, filled, &cause)) {
        if (stream != NULL)
            fclose(stream);
        journal->is_broken = true;
        return error_set(error, "%s: cannot be written: %s", journal->path, cause.text);
    }
    close_stream(journal);
    journal->stream = stream;
    return true;
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
    if (journal->stream != NULL && is_done && is_current(journal))
        unlink(journal->path);
    close_stream(journal);
    *journal = (Journal){0};
}
