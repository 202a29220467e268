/* tests/bench/bench_hall.c -- what many lamps cost: a hall with 1,000 of them against one with 10.
 *
 *     bench_hall [RUNS]
 *
 * 40 x 60 x 8 m, the same 600 sensors, accuracy and total flux: luminaires with an opening where
 * nothing can shadow; the same above shelves; lamps without extent above shelves, of which the
 * strongest are asked and the weak ones are drawn. All take turns, so that whatever else the
 * machine does meets all of them; the median counts, by the process's own clock. Run it where
 * data/office is.
 */
#include "core/progress.h"
#include "tests/block.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_RUNS = 25, CASES = 4, COUNTS = 2 };

static const struct {
    const char *name;
    bool shelves, points, direct_only;
} cases[CASES] = {
    { "luminaires, bare room", false, false, false },
    { "luminaires, shelves", true, false, false },
    { "cosines, shelves", true, true, false },
    { "the same, direct light", true, true, true },
};
static const int counts[COUNTS][2] = { { 2, 5 }, { 25, 40 } };

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- the hall -------------------------------------------------------------------------------- */

typedef struct yaml {
    char text[65536];
    size_t size;
} yaml;

__attribute__((format(printf, 2, 3))) static void put(yaml *y, const char *format, ...)
{
    va_list more;
    va_start(more, format);
    int n = vsnprintf(y->text + y->size, sizeof y->text - y->size, format, more);
    va_end(more);
    y->size += (size_t)n;
    if (y->size >= sizeof y->text)
        exit(1);
}

static const char *hall_text(arena *a, int which, const int count[2])
{
    yaml *y          = arena_new(a, yaml, NULL);
    const double all = 900000.0; /* lm */
    int lamps        = count[0] * count[1];
    put(y, "lux4: 1\nroom: {size: [40, 60, 8], "
           "reflectance: {ceiling: 0.7, walls: 0.5, floor: 0.2}}\n");
    if (cases[which].shelves) {
        put(y, "scene:\n  - file: %s\n    at: [",
            block_write(a, "shelf.gltf", (vec3){ 1.2f, 40.0f, 2.0f }));
        for (int i = 0; i < 9; i++)
            put(y, "%s[%d, 30, 0]", i ? ", " : "", 4 * (i + 1));
        put(y, "]\n");
    }
    if (cases[which].points) {
        put(y, "lights:\n  - type: cosine\n    lumens: %g\n    at:\n", all / lamps);
        for (int i = 0; i < lamps; i++)
            put(y, "    - [%g, %g, 7.5]\n", 40.0 * (i % count[0] + 0.5) / count[0],
                60.0 * (i / count[0] + 0.5) / count[1]);
    } else {
        char *web = realpath("data/office/panel.ldt", NULL);
        if (!web) {
            fputs("bench_hall: there is no data/office/panel.ldt here\n", stderr);
            exit(1);
        }
        put(y,
            "luminaires:\n  - {photometry: %s, lumens: %g, layout: {fill: room, z: 7.5, "
            "count: [%d, %d]}}\n",
            web, all / lamps, count[0], count[1]);
        free(web);
    }
    put(y, "grids: [{name: g, origin: [0, 0, 0.8], u: [40, 0, 0], v: [0, 60, 0], spacing: 2}]\n"
           "accuracy: 5%%\n");
    return y->text;
}

/* ---- the clock ------------------------------------------------------------------------------- */

typedef struct run {
    double seconds[MOST_RUNS];
    double rays, lux, half_width; /* of the last */
} run;

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(const run *r, int runs)
{
    double sorted[MOST_RUNS];
    memcpy(sorted, r->seconds, sizeof sorted);
    qsort(sorted, (size_t)runs, sizeof *sorted, compare);
    return sorted[runs / 2];
}

static void time_run(const scene *s, int which, int number, run *out)
{
    arena a      = { 0 };
    double begun = seconds();
    grid_result r;
    run_options o = { .seed = (uint32_t)number + 1, .direct_only = cases[which].direct_only };
    grid_of_scene(&a, s, 0, &o, &r);
    out->seconds[number] = seconds() - begun;
    out->rays            = (double)r.rays;
    out->lux             = r.average;
    out->half_width      = 100.0 * r.worst_half_width;
    arena_clear(&a);
}

static void print_case(const char *name, const run of[COUNTS], int runs)
{
    double few = median(&of[0], runs), many = median(&of[1], runs);
    for (int c = 0; c < COUNTS; c++)
        printf("%-22s %6d %9.3f %9.2f %8.1f %8.2f\n", c ? "" : name, counts[c][0] * counts[c][1],
               c ? many : few, 1e-6 * of[c].rays, of[c].lux, of[c].half_width);
    printf("%-22s %6s %9.2f times\n", "", "", many / few);
}

int main(int argc, char **argv)
{
    int asked = argc > 1 ? atoi(argv[1]) : 0;
    int runs  = asked > 0 && asked <= MOST_RUNS ? asked : 5;
    arena a   = { 0 };
    const scene *halls[CASES][COUNTS];
    static run times[CASES][COUNTS];
    for (int i = 0; i < CASES; i++)
        for (int c = 0; c < COUNTS; c++)
            halls[i][c] = scene_of_text(&a, hall_text(&a, i, counts[c]));
    for (int n = 0; n < runs; n++)
        for (int i = 0; i < CASES; i++)
            for (int c = 0; c < COUNTS; c++)
                time_run(halls[i][c], i, n, &times[i][c]);

    printf("a hall of 40 x 60 m, 600 sensors, 5 %%, one thread, WIDTH=%d; median of %d runs\n"
           "%-22s %6s %9s %9s %8s %8s\n",
           LANES, runs, "", "lamps", "seconds", "Mrays", "lx", "+- %");
    for (int i = 0; i < CASES; i++)
        print_case(cases[i].name, times[i], runs);
    scratch_remove();
    arena_clear(&a);
    return 0;
}
