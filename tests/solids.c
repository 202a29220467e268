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

static point corner(const patch *t, uint32_t i)
{
    const float *p = t->xyz + 3 * t->corners[i];
    return (point){ (double)p[0], (double)p[1], (double)p[2] };
}

static point cross_of(point a, point b, point c)
{
    const point e = { b.x - a.x, b.y - a.y, b.z - a.z }, f = { c.x - a.x, c.y - a.y, c.z - a.z };
    return (point){ e.y * f.z - e.z * f.y, e.z * f.x - e.x * f.z, e.x * f.y - e.y * f.x };
}

double patch_least_area(const patch *t, double *volume6)
{
    double least = HUGE_VAL;
    *volume6     = 0.0;
    for (uint32_t i = 0; i < 3 * t->triangle_count; i += 3) {
        const point a = corner(t, i), n = cross_of(a, corner(t, i + 1), corner(t, i + 2));
        const double area = 0.5 * sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
        assert_true(isfinite(area));
        least = fmin(least, area);
        *volume6 += a.x * n.x + a.y * n.y + a.z * n.z;
    }
    return least;
}
