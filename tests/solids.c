/* tests/solids.c -- see solids.h. */
#define _GNU_SOURCE /* open_memstream */
#include "tests/solids.h"

#include "tests/test.h"

#include <stdlib.h>
#include <string.h>

void assert_file_is(const char *path, bool (*write)(FILE *))
{
    char *made  = NULL;
    size_t size = 0;
    FILE *to    = open_memstream(&made, &size);
    assert_true(to && write(to));
    assert_int_equal(fclose(to), 0);

    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *kept        = malloc(size + 1);
    const size_t read = fread(kept, 1, size + 1, f);
    fclose(f);
    assert_int_equal(read, size);
    assert_memory_equal(kept, made, size);
    free(kept);
    free(made);
}

typedef struct edge {
    uint32_t from, to;
} edge;

static int edge_order(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    return p->from != q->from ? (p->from < q->from ? -1 : 1) : (p->to > q->to) - (p->to < q->to);
}

bool patch_is_closed(const patch *t)
{
    const uint32_t n = 3 * t->triangle_count;
    edge *there = calloc(2 * (size_t)n + 1, sizeof *there), *back = there + n;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t a = t->corners[i], b = t->corners[i % 3 == 2 ? i - 2 : i + 1];
        there[i] = (edge){ a, b };
        back[i]  = (edge){ b, a };
    }
    qsort(there, n, sizeof *there, edge_order);
    qsort(back, n, sizeof *back, edge_order);
    bool closed = memcmp(there, back, n * sizeof *there) == 0;
    for (uint32_t i = 1; i < n; i++)
        closed &= edge_order(&there[i - 1], &there[i]) != 0;
    free(there);
    return closed;
}

point patch_corner(const patch *t, uint32_t i)
{
    const float *p = t->xyz + 3 * t->corners[i];
    return (point){ (double)p[0], (double)p[1], (double)p[2] };
}

double patch_least_area(const patch *t, double *volume6)
{
    double least = HUGE_VAL;
    *volume6     = 0.0;
    for (uint32_t i = 0; i < 3 * t->triangle_count; i += 3) {
        const point a = patch_corner(t, i),
                    n = cross(minus(patch_corner(t, i + 1), a), minus(patch_corner(t, i + 2), a));
        const double area = 0.5 * length(n);
        assert_true(isfinite(area));
        least = fmin(least, area);
        *volume6 += dot(a, n);
    }
    return least;
}
