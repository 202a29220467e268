/* core/file.h -- whole files in and out: bounded when read, whole or absent when written. */
#ifndef CORE_FILE_H
#define CORE_FILE_H

#include "core/arena.h"
#include "core/error.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The bytes of the file at path, followed by a NUL that *size does not count, in a. NULL, with
 * *err naming the file, if it cannot be read, is no regular file, or is larger than `most`. */
char *file_read(arena *a, const char *path, size_t most, size_t *size, lux_error *err);

/* Writing: the bytes go to a temporary name beside the final one; file_commit() makes them reach
 * the disk and takes the final name in one step, so that a reader sees the old file, or none,
 * or the new one whole. */
typedef struct output_file {
    char *path, *temporary;
    FILE *stream; /* NULL if the caller writes to `temporary` by other means */
} output_file;

/* Opens an output. False, with *err, if the place cannot be written. */
bool file_create(output_file *f, const char *path, lux_error *err);

/* The same without a stream, for libraries that open files by name: `temporary` is then a name
 * in the same folder at which nothing stands. */
bool file_reserve(output_file *f, const char *path, lux_error *err);

/* Closes, syncs and renames; false, with *err and nothing left behind, if any byte was lost. */
bool file_commit(output_file *f, lux_error *err);

/* Closes and removes. */
void file_discard(output_file *f);

/* Makes the folder and those above it where they are missing. */
bool folder_make(const char *path, lux_error *err);

#ifdef __cplusplus
}
#endif

#endif
