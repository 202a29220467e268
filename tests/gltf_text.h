/* tests/gltf_text.h -- scenes written on the spot, for the tests of the glTF reader. */
#ifndef TESTS_GLTF_TEXT_H
#define TESTS_GLTF_TEXT_H

#include "sim/gltf.h"

/* A temporary folder of its own, and its removal with the files written there. */
const char *scratch_folder(void);
void scratch_remove(void);

/* Writes a file into that folder; the path is good until the next call. */
const char *scratch_write(const char *name, const void *bytes, size_t size);

/* Reads bytes as the file NAME in that folder. */
const gltf *read_bytes(arena *a, const char *name, const void *bytes, size_t size, notices *n,
                       lux_error *err);

/* "data:application/octet-stream;base64,..." of the bytes, in a. */
const char *data_uri(arena *a, const void *bytes, size_t size);

/* A .glb of this JSON and binary chunk (NULL: none), in a; *total is its size. */
uint8_t *make_glb(arena *a, const char *json, const void *chunk, size_t size, size_t *total);

/* Text by printf, in a. */
char *text_of(arena *a, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Whether some notice holds the text. */
bool noticed(const notices *n, const char *text);

#endif
