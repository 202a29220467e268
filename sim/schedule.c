/* sim/schedule.c -- see schedule.h: rows, totals, loads. */
#include "sim/schedule.h"

#include <stdlib.h>
#include <string.h>

/* ---- rows ------------------------------------------------------------------------------------ */

static int order(double a, double b) { return (a > b) - (a < b); }

/* 0: of one row. Lamps of an entry may differ in lumens, by how they are aimed (TILT); those of
 * glTF files have no entry, and must not. */
static int compare_kind(const scene_light *a, const scene_light *b)
{
    int by = order(a->where.line, b->where.line);
    by     = by ? by : order(a->where.column, b->where.column);
    by     = by ? by : strcmp(a->name, b->name);
    by     = by || a->where.line ? by : order(a->full, b->full);
    return by || a->where.line
               ? by
               : ((uintptr_t)a->web > (uintptr_t)b->web) - ((uintptr_t)a->web < (uintptr_t)b->web);
}

static int compare_lights(const void *a, const void *b)
{
    const scene_light *const *x = a, *const *y = b;
    int by = compare_kind(*x, *y);
    return by ? by : (*x > *y) - (*x < *y);
}

static int compare_rows(const void *a, const void *b)
{
    const scene_light *x = ((const schedule_row *)a)->first, *y = ((const schedule_row *)b)->first;
    return (x > y) - (x < y);
}

static bool make_rows(arena *a, const scene *s, schedule *c, lux_error *err)
{
    size_t count               = (size_t)s->light_count;
    arena scratch              = { 0 };
    const scene_light **lights = arena_array(&scratch, const scene_light *, count + 1, err);
    c->rows                    = lights ? arena_array(a, schedule_row, count + 1, err) : NULL;
    for (size_t i = 0; c->rows && i < count; i++)
        lights[i] = &s->light_info[i];
    if (c->rows)
        qsort(lights, count, sizeof *lights, compare_lights);
    for (size_t i = 0; c->rows && i < count; i++) {
        if (i == 0 || compare_kind(lights[i - 1], lights[i]) != 0)
            c->rows[c->row_count++].first = lights[i];
        schedule_row *r = &c->rows[c->row_count - 1];
        r->count++;
        r->lumens += lights[i]->full;
    }
    for (int i = 0; i < c->row_count; i++)
        c->rows[i].lumens /= c->rows[i].count;
    if (c->rows)
        qsort(c->rows, (size_t)c->row_count, sizeof *c->rows, compare_rows);
    arena_clear(&scratch);
    return c->rows != NULL;
}

/* ---- totals ---------------------------------------------------------------------------------- */

static void add_up(schedule *c)
{
    double rated_lumens = 0.0;
    for (int i = 0; i < c->row_count; i++) {
        const schedule_row *r  = &c->rows[i];
        const scene_light *one = r->first;
        if (isinf(r->lumens))
            continue;
        double lumens = r->count * r->lumens, watts = r->count * one->watts;
        c->count += r->count;
        c->lumens += lumens;
        c->dimmed_lumens += one->dimmed_to * lumens;
        c->dimmed |= one->dimmed_to != 1.0;
        if (isnan(watts)) {
            c->unrated += r->count;
            continue;
        }
        c->watts += watts;
        c->dimmed_watts += one->dimmed_to * watts;
        rated_lumens += lumens;
    }
    c->efficacy = c->watts > 0.0 ? rated_lumens / c->watts : (double)NAN;
    if (c->unrated == c->count)
        c->watts = c->dimmed_watts = (double)NAN;
}

static void tell_of_stale_watts(const scene *s, const schedule *c, notices *n)
{
    for (int i = 0; i < c->row_count; i++) {
        const scene_light *one   = c->rows[i].first;
        const study_luminaire *l = one->luminaire;
        if (l && isnan(l->watts) && !isnan(one->watts) &&
            (!isnan(l->lumens) || !isnan(l->lamp_lumens)))
            notice_add(n,
                       "%s:%d:%d: the light of %s is scaled, its %g W are not: `watts` says "
                       "otherwise",
                       s->study->path, l->where.line, l->where.column, one->name, one->watts);
    }
}

bool schedule_make(arena *a, const scene *s, schedule *out, notices *n, lux_error *err)
{
    const study_room *room = &s->study->room;
    dvec3 across           = d3_sub(s->high, s->low);
    double model           = across.x > 0.0 && across.y > 0.0 ? across.x * across.y : (double)NAN;
    *out                   = (schedule){ .floor    = room->given ? room->size.x * room->size.y : model,
                                         .of_model = !room->given && !isnan(model) };
    if (!make_rows(a, s, out, err))
        return false;
    add_up(out);
    tell_of_stale_watts(s, out, n);
    return true;
}

bool schedule_load_of(const schedule *c, double watts, const study_grid *g, double average,
                      schedule_load *out)
{
    dvec3 across = d3_cross(g->u, g->v);
    double own   = d3_length(across);
    if (g->points || g->quantity != QUANTITY_PLANAR || !(across.z > 0.999 * own) || isnan(average))
        return false;
    out->area        = isnan(c->floor) ? own : c->floor;
    out->average     = average;
    out->density     = watts / out->area;
    out->per_100_lux = average > 0.0 ? out->density / (average / 100.0) : (double)NAN;
    return true;
}
