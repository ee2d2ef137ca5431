// SPDX-License-Identifier: MIT
// Makes it safe to read the environment while another thread changes it. PoCL sets a variable in
// the thread that opens the device, while OpenGL's libraries call getenv in the window's thread.
// The C library's setenv frees or overwrites the array to which environ points.
//
// The executable therefore overrides setenv, unsetenv and putenv. Each change replaces environ by a
// new array. Old arrays are never freed, because other threads may read them. Changes are rare, so
// the arrays take little memory.
#include <errno.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool is_named(const char *entry, const char *name, size_t length)
{
    return strncmp(entry, name, length) == 0 && entry[length] == '=';
}

// Removes the variable whose name is the first `length` bytes of `name`, and adds `entry` unless it
// is NULL. Before its variables, each array has a pointer to the previous array, so that leak
// checkers can reach all arrays.
static int replace(const char *name, size_t length, char *entry)
{
    static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    static char **latest;
    size_t count = 0, kept = 1;
    pthread_mutex_lock(&lock);
    while (environ != NULL && environ[count] != NULL)
        count++;
    char **list = malloc((count + 3) * sizeof *list);
    for (size_t i = 0; list != NULL && i < count; i++)
        if (!is_named(environ[i], name, length))
            list[kept++] = environ[i];
    if (list != NULL) {
        list[0] = (char *)latest;
        list[kept++] = entry;
        list[kept] = NULL;
        latest = list;
        __atomic_store_n(&environ, list + 1, __ATOMIC_RELEASE);
    }
    pthread_mutex_unlock(&lock);
    return list != NULL ? 0 : -1; // malloc has set errno
}

static bool is_valid(const char *name)
{
    const bool ok = name != NULL && name[0] != '\0' && strchr(name, '=') == NULL;
    errno = ok ? errno : EINVAL;
    return ok;
}

#define OVERRIDES __attribute__((visibility("default")))

OVERRIDES int setenv(const char *name, const char *value, int overwrite)
{
    if (!is_valid(name))
        return -1;
    if (overwrite == 0 && getenv(name) != NULL)
        return 0;
    const size_t length = strlen(name);
    char *entry = malloc(length + strlen(value) + 2);
    if (entry == NULL)
        return -1;
    stpcpy(stpcpy(stpcpy(entry, name), "="), value);
    return replace(name, length, entry);
}

OVERRIDES int unsetenv(const char *name)
{
    return is_valid(name) ? replace(name, strlen(name), NULL) : -1;
}

OVERRIDES int putenv(char *entry)
{
    const size_t length = strcspn(entry, "=");
    return replace(entry, length, entry[length] == '=' ? entry : NULL);
}
