/* sim/emission_sky.c -- by which tables skies are drawn from.
 */
#include "sim/emission_parts.h"

#include <string.h>

/* More groups that have skies share their tables: their particles are less even. */
enum { MOST_TABLES = 32 };

/* Of the mean, where there may be some: a cell's luminance is that of points in it. */
static const double least_luminance = 1e-3;

typedef struct sky_tables {
    const dome *open, *through;
    far_flux flux;
} sky_tables;

/* The direction of the middle of a cell, to where brightness.h has it. */
static vvec3 cell_direction(const brightness *b, int row, int column)
{
    double down    = M_PI * (row + 0.5) / b->rows;
    double azimuth = 2.0 * M_PI * (column + 0.5) / b->columns;
    return vspread((vec3){ (float)(-sin(down) * sin(azimuth)), (float)(-sin(down) * cos(azimuth)),
                           (float)cos(down) });
}

static void raise_dark_cells(brightness *b, bool below)
{
    const int rows = below ? b->rows : (b->rows + 1) / 2;
    for (size_t i = 0; i < (size_t)rows * (size_t)b->columns; i++)
        b->luminance[i] = (float)fmax((double)b->luminance[i], least_luminance * b->mean);
}

/* Multiplies by the area of portals seen; returns the integral of L S(w). All through a cell that
 * area differs from its middle by no more than all of it times half the cell's diagonal. */
static double weigh_by_portals(const emission *e, brightness *b)
{
    double cell = M_PI * hypot(0.5 / b->rows, 1.0 / b->columns), area = 0.0, sum = 0.0;
    for (int i = 0; i < e->portal_count; i++)
        area += 4.0 * (double)(v3_length(e->portals[i].u) * v3_length(e->portals[i].v));
    for (int j = 0; j < b->rows; j++) {
        double sr =
            2.0 * M_PI / b->columns * (cos(M_PI * j / b->rows) - cos(M_PI * (j + 1.0) / b->rows));
        for (int i = 0; i < b->columns; i++) {
            float *at   = &b->luminance[(size_t)j * (size_t)b->columns + (size_t)i];
            vvec3 wi    = cell_direction(b, j, i);
            double seen = (double)lane(emission_portals_seen(e, &wi), 0);
            sum += (double)*at * seen * sr;
            *at = (float)((double)*at * (seen + area * cell));
        }
    }
    return sum;
}

static bool make_tables(arena *a, const emission *e, const sky_source *of, sky_tables *to,
                        lux_error *err)
{
    arena scratch   = { 0 };
    brightness b    = { 0 };
    bool below      = false;
    const sky **all = arena_array(&scratch, const sky *, (size_t)of->count, err);
    for (int k = 0; all && k < of->count; k++) {
        all[k] = e->s->skies[of->skies[k]].sky;
        below  = below || all[k]->below;
    }
    bool good = all && brightness_of(&scratch, &b, all, of->count, err);
    if (good) {
        raise_dark_cells(&b, below);
        to->open      = dome_of_table(a, &b, err);
        to->flux.open = 4.0 * M_PI * b.mean * of->count * (double)e->area;
        good          = to->open != NULL;
    }
    if (good && e->portal_count > 0) {
        to->flux.through = of->count * weigh_by_portals(e, &b);
        to->through      = dome_of_table(a, &b, err);
        good             = to->through != NULL;
    }
    arena_clear(&scratch);
    return good;
}

/* Those of each group one after the other; all at once: group -1. */
static bool sort_skies(arena *a, emission *e, sky_source *to, lux_error *err)
{
    const scene *s = e->s;
    const int n    = s->layered ? s->group_count : 1;
    int32_t *list  = arena_array(a, int32_t, (size_t)s->sky_count + 1, err);
    for (int g = 0; list && g < n; g++) {
        int count = 0;
        for (int k = 0; k < s->sky_count; k++)
            if (!s->layered || s->skies[k].group == g)
                list[count++] = k;
        if (count > 0)
            to[e->sky_count++] =
                (sky_source){ .group = s->layered ? g : -1, .skies = list, .count = count };
        list += count;
    }
    return list != NULL;
}

static bool share_tables(arena *a, const emission *e, sky_source *to, far_flux *flux,
                         lux_error *err)
{
    sky_source all    = { .skies = to[0].skies, .count = e->s->sky_count };
    sky_tables tables = { 0 };
    if (!make_tables(a, e, &all, &tables, err))
        return false;
    for (int i = 0; i < e->sky_count; i++) {
        to[i].open    = tables.open;
        to[i].through = tables.through;
        flux[i] = (far_flux){ tables.flux.open / e->sky_count, tables.flux.through / e->sky_count };
    }
    return true;
}

bool emission_make_skies(arena *a, emission *e, far_flux **flux, lux_error *err)
{
    const size_t room = (size_t)e->s->group_count + 1;
    sky_source *to    = arena_array(a, sky_source, room, err);
    *flux             = to ? arena_array(a, far_flux, room, err) : NULL;
    if (!*flux || !sort_skies(a, e, to, err))
        return false;
    e->skies = to;
    if (e->sky_count > MOST_TABLES)
        return share_tables(a, e, to, *flux, err);
    for (int i = 0; i < e->sky_count; i++) {
        sky_tables tables = { 0 };
        if (!make_tables(a, e, &to[i], &tables, err))
            return false;
        to[i].open    = tables.open;
        to[i].through = tables.through;
        (*flux)[i]    = tables.flux;
    }
    return true;
}
