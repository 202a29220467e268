/* data/office/make_office.c -- makes the office that lux4 ships, and scenes to time it with.
 *
 *     make_office FOLDER              office.glb, panel.ldt and downlight.ies
 *     make_office --bench N FILE.glb  about N triangles, none of them an instance
 */
#include "data/office/layout.h"
#include "data/office/web.h"

#include <stdlib.h>
#include <string.h>

static void build(model *m) { office_build(m, 1.0); }

static bool write_bench(FILE *to, uint32_t triangles)
{
    model m = { 0 };
    bench_build(&m, triangles);
    const bool done = model_write_glb(&m, to);
    fprintf(stderr, "%u triangles\n", model_triangles(&m));
    model_clear(&m);
    return done;
}

static int finish(FILE *f, bool done, const char *path)
{
    if (f && fclose(f) == 0 && done)
        return EXIT_SUCCESS;
    perror(path);
    return EXIT_FAILURE;
}

static int make_bench(const char *count, const char *path)
{
    const unsigned long n = strtoul(count, NULL, 10);
    if (n < 1000 || n > 2000000) {
        fprintf(stderr, "--bench %s: 1000 to 2000000 triangles can be made\n", count);
        return EXIT_FAILURE;
    }
    FILE *f         = fopen(path, "wb");
    const bool done = f && write_bench(f, (uint32_t)n);
    return finish(f, done, path);
}

int main(int argc, char **argv)
{
    if (argc == 4 && strcmp(argv[1], "--bench") == 0)
        return make_bench(argv[2], argv[3]);
    if (argc != 2 || argv[1][0] == '-') {
        fprintf(stderr, "make_office FOLDER | --bench TRIANGLES FILE.glb\n");
        return 2;
    }
    return model_make(argv[1], "office.glb", build) |
           model_make_file(argv[1], "panel.ldt", panel_write) |
           model_make_file(argv[1], "downlight.ies", downlight_write);
}
