/* tests/panorama_file.h -- panoramas that tests make: files in a folder of their own. */
#ifndef TESTS_PANORAMA_FILE_H
#define TESTS_PANORAMA_FILE_H

#include "core/image.h"
#include "sky/panorama.h"

enum { BOX_PIXELS = 1 << 17 };

typedef struct file_box {
    arena a; /* of skies, too */
    char *folder;
    char path[200]; /* of the EXR */
    float *rgb[3];  /* of BOX_PIXELS */
} file_box;

file_box file_box_new(void);
void file_box_free(file_box *b);

void file_box_fill(file_box *b, int width, int height, float red, float green, float blue);

/* Writes rgb as an EXR; or bytes as a file of that ending, whose path is returned. */
void file_box_store(file_box *b, int width, int height);
const char *file_box_write(file_box *b, const char *ending, const char *bytes, size_t size);

/* The panorama of what is in rgb, or in bytes; the path of d is set. Fails the test if it is
 * refused. sun: NULL: there must be none. */
const sky *panorama_of_box(file_box *b, int width, int height, panorama_desc d, panorama_sun *sun);
const sky *panorama_of_file(file_box *b, int width, int height, panorama_desc d, panorama_sun *sun,
                            notices *n);
const sky *panorama_of_bytes(file_box *b, const char *ending, const char *bytes, size_t size);

#endif
