/* core/file.c -- see file.h. */
#define _GNU_SOURCE
#include "core/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    ATTEMPTS  = 16,  /* at a temporary name that is free */
    NAME_KEPT = 200, /* bytes of the final name within the temporary one: NAME_MAX is 255 */
};

/* ---- reading ---------------------------------------------------------------------------- */

static void *cannot_read(lux_error *err, const char *path, int code)
{
    char text[128];
    if (code == ENOENT || code == ENOTDIR)
        return failed(err, ERR_IO, "%s: no such file", path);
    return failed(err, ERR_IO, "%s: cannot read: %s", path, strerror_r(code, text, sizeof text));
}

/* The size of an open file that may be read whole. */
static bool readable_size(int fd, const char *path, size_t most, size_t *size, lux_error *err)
{
    struct stat s;
    if (fstat(fd, &s))
        return cannot_read(err, path, errno);
    if (S_ISDIR(s.st_mode))
        return failed(err, ERR_IO, "%s: is a folder, a file was expected", path);
    if (!S_ISREG(s.st_mode))
        return failed(err, ERR_IO, "%s: is not a regular file", path);
    if ((uintmax_t)s.st_size > most || (uintmax_t)s.st_size >= SIZE_MAX)
        return failed(err, ERR_IO, "%s: has %jd bytes, at most %zu were expected", path,
                      (intmax_t)s.st_size, most);
    *size = (size_t)s.st_size;
    return true;
}

/* Fills bytes, which has room for one more than `size`, to see a file that grows. */
static bool read_all(int fd, const char *path, char *bytes, size_t size, lux_error *err)
{
    size_t done = 0;
    while (done <= size) {
        ssize_t got = read(fd, bytes + done, size + 1 - done);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return cannot_read(err, path, errno);
        if (got == 0)
            break;
        done += (size_t)got;
    }
    if (done != size)
        return failed(err, ERR_IO, "%s: changes while it is read", path);
    bytes[size] = '\0';
    return true;
}

char *file_read(arena *a, const char *path, size_t most, size_t *size, lux_error *err)
{
    /* Nobody may ever write to a pipe, or answer at a terminal: open() must not wait for it. */
    int fd = open(path, O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (fd < 0)
        return cannot_read(err, path, errno);
    size_t length = 0;
    char *bytes   = NULL;
    if (readable_size(fd, path, most, &length, err))
        bytes = arena_array(a, char, length + 1, err);
    if (bytes && !read_all(fd, path, bytes, length, err))
        bytes = NULL;
    close(fd);
    if (bytes)
        *size = length;
    return bytes;
}

/* ---- writing ---------------------------------------------------------------------------- */

static void *cannot_write(lux_error *err, const char *path, int code)
{
    char text[128];
    if (code == ENOENT || code == ENOTDIR)
        return failed(err, ERR_IO, "%s: cannot write: no such folder", path);
    return failed(err, ERR_IO, "%s: cannot write: %s", path, strerror_r(code, text, sizeof text));
}

/* Where the last name in a path begins. */
static size_t name_start(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

static void forget(output_file *f)
{
    free(f->path);
    free(f->temporary);
    *f = (output_file){ 0 };
}

/* A rename puts the new file in place of whatever stands there, /dev/null too. */
static bool replaceable(const char *path, lux_error *err)
{
    struct stat s;
    if (path[name_start(path)] == '\0')
        return failed(err, ERR_IO, "%s: is not the name of a file", path);
    if (stat(path, &s))
        return true;
    if (S_ISDIR(s.st_mode))
        return failed(err, ERR_IO, "%s: cannot write: is a folder", path);
    if (!S_ISREG(s.st_mode))
        return failed(err, ERR_IO, "%s: cannot write: is not a regular file", path);
    return true;
}

/* Creates FOLDER/.NAME.PID-RANDOM.tmp, which nobody else has; its descriptor, or -1 with errno.
 * The process alone would not do: two machines may write to one folder. */
static int create_temporary(const char *path, char *temporary, size_t size)
{
    size_t start = name_start(path);
    for (int i = 0; i < ATTEMPTS; i++) {
        uint32_t random = (uint32_t)i;
        if (getrandom(&random, sizeof random, GRND_NONBLOCK) < 0)
            random = (uint32_t)i;
        snprintf(temporary, size, "%.*s.%.*s.%ld-%08x.tmp", (int)start, path, NAME_KEPT,
                 path + start, (long)getpid(), (unsigned)random);
        int fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST)
            return fd;
    }
    return -1;
}

/* Fills path and temporary; an open descriptor, or -1 with *err and nothing to forget. */
static int begin(output_file *f, const char *path, lux_error *err)
{
    *f = (output_file){ 0 };
    if (!replaceable(path, err))
        return -1;
    size_t size  = strlen(path) + 64; /* the dots, a process, a random number */
    f->path      = strdup(path);
    f->temporary = malloc(size);
    int fd       = f->path && f->temporary ? create_temporary(path, f->temporary, size) : -1;
    if (fd < 0) {
        cannot_write(err, path, errno);
        forget(f);
    }
    return fd;
}

bool file_create(output_file *f, const char *path, lux_error *err)
{
    int fd = begin(f, path, err);
    if (fd < 0)
        return false;
    f->stream = fdopen(fd, "wb");
    if (f->stream)
        return true;
    cannot_write(err, path, errno);
    close(fd);
    file_discard(f);
    return false;
}

bool file_reserve(output_file *f, const char *path, lux_error *err)
{
    /* To have created a file there is the one way to know that it can be done. */
    int fd = begin(f, path, err);
    if (fd < 0)
        return false;
    close(fd);
    unlink(f->temporary);
    return true;
}

/* Closes the stream when its bytes have reached the disk; 0, or why they have not. */
static int finish_stream(FILE *stream)
{
    int code = fflush(stream) ? errno : 0;
    if (!code && ferror(stream))
        code = EIO; /* a write failed earlier, and its reason is gone */
    if (!code && fsync(fileno(stream)))
        code = errno;
    if (fclose(stream) && !code)
        code = errno;
    return code;
}

/* The same for a file that was written, and closed, by others. */
static int finish_name(const char *name)
{
    int fd = open(name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0)
        return errno;
    int code = fsync(fd) ? errno : 0;
    close(fd);
    return code;
}

/* Makes the rename itself last. Not every file system can, and no byte is lost without: at worst
 * a power cut brings the old file back. */
static void sync_folder(char *path)
{
    size_t start = name_start(path);
    path[start]  = '\0';
    int fd       = open(start ? path : ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return;
    fsync(fd);
    close(fd);
}

bool file_commit(output_file *f, lux_error *err)
{
    int code  = f->stream ? finish_stream(f->stream) : finish_name(f->temporary);
    f->stream = NULL;
    if (!code && rename(f->temporary, f->path))
        code = errno;
    if (code) {
        cannot_write(err, f->path, code);
        file_discard(f);
        return false;
    }
    sync_folder(f->path);
    forget(f);
    return true;
}

void file_discard(output_file *f)
{
    if (f->stream)
        fclose(f->stream);
    if (f->temporary)
        unlink(f->temporary);
    forget(f);
}

/* ---- folders ---------------------------------------------------------------------------- */

static bool make_one(const char *path, lux_error *err)
{
    char text[128];
    struct stat s;
    if (mkdir(path, 0777) == 0)
        return true;
    int code = errno;
    if (stat(path, &s) == 0) {
        if (S_ISDIR(s.st_mode))
            return true;
        return failed(err, ERR_IO, "%s: is a file, a folder was expected", path);
    }
    return failed(err, ERR_IO, "%s: cannot make this folder: %s", path,
                  strerror_r(code, text, sizeof text));
}

bool folder_make(const char *path, lux_error *err)
{
    char *part = strdup(*path ? path : ".");
    if (!part)
        return failed(err, ERR_MEMORY, "out of memory: %zu bytes", strlen(path) + 1);
    bool made = true;
    for (char *c = part + 1; made && *c; c++) {
        if (*c != '/')
            continue;
        *c   = '\0';
        made = make_one(part, err);
        *c   = '/';
    }
    made = made && make_one(part, err);
    free(part);
    return made;
}
