/* tests/panorama_file.c -- see panorama_file.h. */
#include "tests/panorama_file.h"

#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>

file_box file_box_new(void)
{
    file_box b = { .folder = folder_new() };
    snprintf(b.path, sizeof b.path, "%s/panorama.exr", b.folder);
    for (int c = 0; c < 3; c++) {
        b.rgb[c] = arena_array(&b.a, float, BOX_PIXELS, NULL);
        assert_non_null(b.rgb[c]);
    }
    return b;
}

void file_box_free(file_box *b)
{
    arena_clear(&b->a);
    folder_free(b->folder);
}

void file_box_fill(file_box *b, int width, int height, float red, float green, float blue)
{
    const float rgb[3] = { red, green, blue };
    assert_true(width * height <= BOX_PIXELS);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < width * height; i++)
            b->rgb[c][i] = rgb[c];
}

void file_box_store(file_box *b, int width, int height)
{
    image_channel c[3] = { { "B", b->rgb[2] }, { "G", b->rgb[1] }, { "R", b->rgb[0] } };
    image im           = { .width = width, .height = height, .channel_count = 3, .channels = c };
    lux_error err      = { 0 };
    if (!image_write_exr(b->path, &im, false, NULL, &err))
        fail_msg("%s", err.text);
}

const char *file_box_write(file_box *b, const char *ending, const char *bytes, size_t size)
{
    static char path[240];
    snprintf(path, sizeof path, "%s/bytes.%s", b->folder, ending);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    assert_int_equal(fwrite(bytes, 1, size, f), size);
    assert_int_equal(fclose(f), 0);
    return path;
}

static const sky *panorama_at(file_box *b, panorama_desc d, panorama_sun *sun, notices *n)
{
    lux_error err = { 0 };
    panorama_sun own;
    const sky *s = sky_panorama(&b->a, &d, sun ? sun : &own, n, &err);
    if (!s)
        fail_msg("%s", err.text);
    if (!sun && own.found)
        fail_msg("a sun was found, where there is none");
    return s;
}

const sky *panorama_of_file(file_box *b, int width, int height, panorama_desc d, panorama_sun *sun,
                            notices *n)
{
    file_box_store(b, width, height);
    d.path = b->path;
    return panorama_at(b, d, sun, n);
}

const sky *panorama_of_box(file_box *b, int width, int height, panorama_desc d, panorama_sun *sun)
{
    return panorama_of_file(b, width, height, d, sun, NULL);
}

const sky *panorama_of_bytes(file_box *b, const char *ending, const char *bytes, size_t size)
{
    panorama_desc d = { .scale = (double)NAN, .horizontal = (double)NAN };
    d.path          = file_box_write(b, ending, bytes, size);
    return panorama_at(b, d, NULL, NULL);
}
