/* tests/folder.c -- a folder for a test's files, that goes again; studies from a text. */
#define _GNU_SOURCE
#include "tests/folder.h"

#include "tests/test.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static int remove_one(const char *path, const struct stat *st, int kind, struct FTW *ftw)
{
    (void)st, (void)kind, (void)ftw;
    return remove(path);
}

char *folder_new(void)
{
    /* In memory where that can be: there the fsync of each result takes no time. */
    char *path =
        strdup(access("/dev/shm", W_OK) ? "/tmp/lux4-test-XXXXXX" : "/dev/shm/lux4-test-XXXXXX");
    assert_non_null(mkdtemp(path));
    return path;
}

void folder_free(char *path)
{
    nftw(path, remove_one, 16, FTW_DEPTH | FTW_PHYS);
    free(path);
}

void folder_write(const char *folder, const char *name, const char *text)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *f = fopen(path, "wb");
    assert_non_null(f);
    fputs(text, f);
    assert_int_equal(fclose(f), 0);
}

const scene *scene_of_text(arena *a, const char *yaml)
{
    char *folder = folder_new(), path[4096];
    folder_write(folder, "study.yaml", yaml);
    snprintf(path, sizeof path, "%s/study.yaml", folder);
    lux_error err  = { 0 };
    const study *s = study_read(a, path, NULL, NULL, &err);
    if (!s)
        fail_msg("%s", err.text);
    const scene *made = scene_new(a, s, &(scene_options){ .threads = 1 }, NULL, &err);
    if (!made)
        fail_msg("%s", err.text);
    folder_free(folder);
    return made;
}

void grid_of_scene(arena *a, const scene *s, int grid, const run_options *o, grid_result *out)
{
    lux_error err       = { 0 };
    run_options options = *o;
    if (options.deadline == 0.0)
        options.deadline = HUGE_VAL;
    if (options.accuracy == 0.0)
        options.accuracy = (double)NAN;
    if (options.threads == 0)
        options.threads = 1;
    if (!grid_run(a, s, &s->study->grids[grid], &options, out, &err))
        fail_msg("%s", err.text);
}

double independent_half_width(const grid_result *r)
{
    double squares = 0.0;
    for (int k = 0; k < r->sensor_count; k++)
        squares += r->half_width[k] * r->half_width[k];
    return sqrt(squares) / r->sensor_count;
}
