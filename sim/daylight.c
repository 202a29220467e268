/* sim/daylight.c -- see daylight.h. */
#include "sim/daylight.h"

#include "sim/moment_sky.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- figures --------------------------------------------------------------------------------- */

daylight_figures daylight_figures_of(const grid_moment *m, int n)
{
    daylight_figures f = { .minimum = HUGE_VAL };
    for (int k = 0; k < n; k++) {
        f.average += m->illuminance[k] / n;
        f.average_half_width += m->half_width[k] / n;
        f.sun += m->sun ? m->sun[k] / n : 0.0;
        f.minimum = fmin(f.minimum, m->illuminance[k]);
        f.maximum = fmax(f.maximum, m->illuminance[k]);
    }
    f.uniformity = f.average > 0.0 ? f.minimum / f.average : 0.0;
    for (int k = 0; k < n; k++) {
        double against     = fmax(m->illuminance[k], 0.1 * f.average);
        double ratio       = m->half_width[k] > 0.0 ? m->half_width[k] / against : 0.0;
        f.worst_half_width = fmax(f.worst_half_width, ratio);
    }
    return f;
}

bool daylight_same_date(const moment *a, const moment *b)
{
    return a->local.year == b->local.year && a->local.month == b->local.month &&
           a->local.day == b->local.day;
}

bool daylight_sum_sun(arena *a, daylight_series *s, lux_error *err)
{
    bool sun = false;
    s->dates = 0;
    for (int h = 0; h < s->count; h++) {
        s->dates += h == 0 || !daylight_same_date(&s->moments[h - 1], &s->moments[h]);
        sun |= s->light[h].sun != NULL;
    }
    if (!sun || isnan(s->step_h))
        return true;
    s->sun_hours = arena_array(a, double, (size_t)s->plan.sensor_count, err);
    for (int h = 0; s->sun_hours && h < s->count; h++)
        for (int k = 0; s->light[h].sun && k < s->plan.sensor_count; k++)
            s->sun_hours[k] += s->step_h * s->light[h].sun[k] / s->dates;
    return s->sun_hours != NULL;
}

/* ---- the beginning --------------------------------------------------------------------------- */

/* Batches are as even as can be: none is left with a moment or two. */
static int first_of_batch(const daylight *d, int batch)
{
    return (int)((long long)d->moment_count * batch / d->batches);
}

static bool make_scene(daylight *d, int batch, lux_error *err)
{
    arena_clear(&d->of_scene);
    int first       = first_of_batch(d, batch);
    scene_options o = { .threads      = d->threads,
                        .moments      = d->moments + first,
                        .moment_count = first_of_batch(d, batch + 1) - first,
                        .off          = d->off,
                        .on           = d->on };
    d->scene        = scene_new(&d->of_scene, d->study, &o, d->notices, err);
    return d->scene != NULL;
}

/* "55.7558 N, 37.6173 E; Europe/Moscow; sky: clear". */
static void say_where(const study *s, char *text, size_t size)
{
    const study_site *in = &s->site;
    int length           = 0;
    text[0]              = '\0';
    if (in->given)
        length =
            snprintf(text, size, "%.4f %c, %.4f %c; %.40s; ", fabs(in->at.latitude_deg),
                     in->at.latitude_deg < 0.0 ? 'S' : 'N', fabs(in->at.longitude_deg),
                     in->at.longitude_deg < 0.0 ? 'W' : 'E', in->zone_name ? in->zone_name : "UTC");
    if (s->sky.given && length >= 0 && (size_t)length < size)
        snprintf(text + length, size - (size_t)length, "sky: %.30s", s->sky.name);
}

static bool make_series(daylight *d, int i, double step_h, lux_error *err)
{
    daylight_series *s = &d->series[i];
    size_t count       = (size_t)d->moment_count;
    *s                 = (daylight_series){ .moments   = d->moments,
                                            .wanted    = d->moment_count,
                                            .north_deg = d->study->site.north_deg,
                                            .step_h    = step_h };
    say_where(d->study, s->under, sizeof s->under);
    if (!grid_sensors(d->a, d->scene, &d->study->grids[i], &s->plan, err))
        return false;
    s->light = arena_array(d->a, grid_moment, count, err);
    s->of    = s->light ? arena_array(d->a, daylight_figures, count, err) : NULL;
    return s->of != NULL;
}

static void tell_nights(const daylight *d)
{
    const study *s = d->study;
    int nights     = 0;
    for (int h = 0; h < d->moment_count; h++)
        nights += d->moments[h].sun_known && !(d->moments[h].to_sun.z > 0.0f);
    if (nights > 0 && study_needs_sun(s))
        notice_add(d->notices,
                   "%s:%d:%d: the sun is below the horizon at %d of %d moments: the sky is dark "
                   "then",
                   s->path, s->sky.where.line, s->sky.where.column, nights, d->moment_count);
}

bool daylight_begin(daylight *d, double step_h, lux_error *err)
{
    const study *s = d->study;
    d->batches     = (d->moment_count + MOST_MOMENTS_A_BATCH - 1) / MOST_MOMENTS_A_BATCH;
    d->series      = arena_array(d->a, daylight_series, (size_t)s->grid_count + 1, err);
    if (!d->series || !make_scene(d, 0, err))
        return false;
    if (d->scene->moment_count == 0)
        return failed(err, ERR_ARGUMENT, "%s: the study has no daylight: `sky` says which",
                      s->path);
    for (int i = 0; i < s->grid_count; i++)
        if (!make_series(d, i, step_h, err))
            return false;
    tell_nights(d);
    return true;
}

bool daylight_plan(daylight *d, uint32_t off, uint32_t on, lux_error *err)
{
    d->off = off;
    d->on  = on;
    return (off | on) == 0 || make_scene(d, 0, err);
}

void daylight_end(daylight *d)
{
    arena_clear(&d->of_scene);
    d->scene = NULL;
}

/* ---- the run --------------------------------------------------------------------------------- */

/* A grid's run ends with its scratch, a series stays. NULL, if memory is out. */
static double *keep(arena *a, const double *values, int n, lux_error *err)
{
    double *copy = arena_array(a, double, (size_t)n, err);
    return copy ? memcpy(copy, values, (size_t)n * sizeof *copy) : NULL;
}

static bool keep_moment(const daylight *d, daylight_series *s, const grid_moment *from,
                        lux_error *err)
{
    int n           = s->plan.sensor_count;
    grid_moment *to = &s->light[s->count];
    to->illuminance = keep(d->a, from->illuminance, n, err);
    to->direct      = to->illuminance ? keep(d->a, from->direct, n, err) : NULL;
    to->half_width  = to->direct ? keep(d->a, from->half_width, n, err) : NULL;
    to->sun         = to->half_width && from->sun ? keep(d->a, from->sun, n, err) : NULL;
    if (!to->half_width || (from->sun && !to->sun))
        return false;
    s->of[s->count++] = daylight_figures_of(to, n);
    return true;
}

/* The worst that a batch had to say is what is said of all. */
static bool keep_run(const daylight *d, daylight_series *s, const grid_result *r, lux_error *err)
{
    for (int h = 0; h < r->moment_count; h++)
        if (!keep_moment(d, s, &r->moments[h], err))
            return false;
    if (s->end == RUN_DONE || r->end == RUN_INTERRUPTED)
        s->end = r->end;
    s->asked          = r->asked;
    s->reached        = fmax(s->reached, r->reached);
    s->missed         = r->missed > s->missed ? r->missed : s->missed;
    s->left_to_chance = s->left_to_chance ? s->left_to_chance : r->left_to_chance;
    s->seconds += r->seconds;
    s->rays += r->rays;
    return true;
}

static bool run_grid(const daylight *d, int i, const run_options *o, lux_error *err)
{
    arena scratch = { 0 };
    grid_result r = { 0 };
    bool good     = grid_run(&scratch, d->scene, &d->study->grids[i], o, &r, err) &&
                keep_run(d, &d->series[i], &r, err);
    arena_clear(&scratch);
    return good;
}

static bool run_batches(daylight *d, const run_options *o, lux_error *err)
{
    int grids = d->study->grid_count;
    for (int batch = 0; batch < d->batches; batch++) {
        if (batch > 0 && !make_scene(d, batch, err))
            return false;
        for (int i = 0; i < grids; i++) {
            run_options own = *o;
            own.deadline    = deadline_share(o->deadline, grids * (d->batches - batch) - i);
            if (progress_stopped(o->progress))
                return failed(err, ERR_INTERRUPTED, "interrupted before there was any result");
            if (!run_grid(d, i, &own, err))
                return false;
        }
    }
    return true;
}

bool daylight_run(daylight *d, const run_options *o, lux_error *err)
{
    int grids = d->study->grid_count, begun = 0;
    lux_error why = { 0 };
    bool good     = run_batches(d, o, &why);
    for (int i = 0; i < grids; i++) {
        daylight_series *s = &d->series[i];
        begun += s->count > 0;
        if (s->count < s->wanted)
            s->end = RUN_INTERRUPTED;
    }
    if (!good && (why.code != ERR_INTERRUPTED || begun == 0))
        return failed(err, why.code, "%s", why.text);
    for (int i = 0; i < grids; i++)
        if (!daylight_sum_sun(d->a, &d->series[i], err))
            return false;
    return true;
}
