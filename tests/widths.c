/* tests/widths.c -- see widths.h. */
#define _GNU_SOURCE
#include "tests/widths.h"

#include "tests/program.h"

#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static time_t newest; /* source */

static int look_at(const char *path, const struct stat *st, int kind, struct FTW *ftw)
{
    const char *end = strrchr(path, '.');
    (void)ftw;
    if (kind == FTW_F && end && (!strcmp(end, ".c") || !strcmp(end, ".h") || !strcmp(end, ".cpp")))
        if (st->st_mtim.tv_sec > newest)
            newest = st->st_mtim.tv_sec;
    return 0;
}

int width_after(int width) { return width == 1 ? 4 : width == 4 ? 8 : 0; }

bool program_of_width(int width, char *path, size_t size)
{
    static const char *const layers[] = { "core", "materials", "lights", "sky", "sim" };
    char folder[4096];
    for (int i = 0; i < 5; i++) {
        snprintf(folder, sizeof folder, "%s/%s", project_root(), layers[i]);
        nftw(folder, look_at, 16, FTW_PHYS);
    }
    struct stat st;
#ifdef __x86_64__
    if (width == 8 && !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")))
        return false;
#endif
    snprintf(path, size, "%s/build/release-%d/lux4", project_root(), width);
    return stat(path, &st) == 0 && st.st_mtim.tv_sec >= newest;
}
