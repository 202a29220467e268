/* materials/brdf_make.c -- from the places of a file to a table that spans the hemisphere. */
#include "materials/brdf_parts.h"

#include <stdint.h>
#include <string.h>

static const double DEG  = M_PI / 180.0;
static const double SAME = 1e-6; /* degrees: places this near are one */

static const struct {
    int axes, order[4]; /* which of the file's axes each of the table's is */
    bool turns[4];      /* which of the file's are azimuths */
    const char *names[4];
} kinds[] = {
    [BRDF_ISOTROPIC]   = { 3,
                           { 1, 0, 2 },
                           { false, false, true },
                           { "theta_in", "theta_out", "delta_phi" } },
    [BRDF_ANISOTROPIC] = { 4,
                           { 2, 3, 0, 1 },
                           { false, true, false, true },
                           { "theta_in", "phi_in", "theta_out", "phi_out" } },
    [BRDF_HALF] = { 3, { 0, 1, 2 }, { false, false, true }, { "theta_h", "theta_d", "phi_d" } },
};

/* ---- places ---------------------------------------------------------------------------------- */

/* An axis while it is made: where its places are, and which of the file's each one repeats. */
typedef struct making {
    float *at;
    int *from;
    int count;
} making;

static void add(making *m, double deg, int from)
{
    m->at[m->count]     = (float)(deg * DEG);
    m->from[m->count++] = from;
}

/* The border goes on to the normal and to the horizon. */
static void make_theta(making *m, const double *deg, int count)
{
    if (deg[0] > SAME)
        add(m, 0.0, 0);
    for (int i = 0; i < count; i++)
        add(m, deg[i], i);
    if (deg[count - 1] < 90.0 - SAME)
        add(m, 90.0, count - 1);
}

/* Around: the last place is dropped if it is the first once more; delta_phi of at most 180 degrees
 * is mirrored. */
static void make_phi(making *m, const double *deg, int count, bool mirrors, double period)
{
    if (count > 1 && deg[count - 1] - deg[0] > period - SAME)
        count--;
    for (int i = 0; i < count; i++)
        add(m, deg[i], i);
    if (!mirrors || deg[0] < -SAME || deg[count - 1] > 180.0 + SAME)
        return;
    for (int i = count - 1; i >= 0; i--)
        if (deg[i] > SAME && deg[i] < 180.0 - SAME)
            add(m, 360.0 - deg[i], i);
}

bool brdf_check_places(const char *where, brdf_kind kind, int axis, const double *deg, int count,
                       lux_error *err)
{
    const char *what = kinds[kind].names[axis];
    bool turns       = kinds[kind].turns[axis];
    double low = turns ? -180.0 : 0.0, high = turns ? 540.0 : 90.0;
    double span = kind == BRDF_HALF ? 180.0 : turns ? 360.0 : 90.0;
    if (count < 1)
        return failed(err, ERR_FORMAT, "%s: %s has no places", where, what);
    for (int i = 0; i < count; i++) {
        if (!(deg[i] >= low && deg[i] <= high))
            return failed(err, ERR_FORMAT, "%s: %s %g is not in [%g, %g] degrees", where, what,
                          deg[i], low, high);
        if (i > 0 && !(deg[i] > deg[i - 1]))
            return failed(err, ERR_FORMAT, "%s: found %g after %g, expected ascending %s", where,
                          deg[i], deg[i - 1], what);
    }
    if (deg[0] > 180.0)
        return failed(err, ERR_FORMAT, "%s: %s begins at %g, at most 180 degrees were expected",
                      where, what, deg[0]);
    if (deg[count - 1] - deg[0] > span + SAME)
        return failed(err, ERR_FORMAT, "%s: %s spans %g degrees, at most %g were expected", where,
                      what, deg[count - 1] - deg[0], span);
    return true;
}

/* *out gets its places in a, *from in scratch. */
static bool make_axis(const brdf_data *d, int axis, arena *a, arena *scratch, table_axis *out,
                      int **from, lux_error *err)
{
    if (!brdf_check_places(d->name, d->kind, axis, d->deg[axis], d->counts[axis], err))
        return false;
    size_t most = 2 * (size_t)d->counts[axis] + 2;
    making m    = { .at = arena_array(a, float, most, err) };
    m.from      = m.at ? arena_array(scratch, int, most, err) : NULL;
    if (!m.from)
        return false;
    bool turns = kinds[d->kind].turns[axis], half = d->kind == BRDF_HALF;
    if (turns)
        make_phi(&m, d->deg[axis], d->counts[axis], d->kind == BRDF_ISOTROPIC,
                 half ? 180.0 : 360.0);
    else
        make_theta(&m, d->deg[axis], d->counts[axis]);
    *from = m.from;
    *out  = (table_axis){ .at = m.at, .count = m.count, .periodic = turns };
    if (turns)
        out->period = half ? (float)M_PI : (float)(2.0 * M_PI);
    return table_axis_check(out, d->name, err) && table_axis_bins(out, a, err);
}

/* ---- values ---------------------------------------------------------------------------------- */

/* A place without data takes those of the one `step` floats before it. */
static void take_neighbour(float *to, const float *from)
{
    if (to[0] < 0.0f && from[0] >= 0.0f)
        memcpy(to, from, 3 * sizeof *to);
}

/* Along one axis, upward and then downward; how many places are left without. */
static size_t fill_along(const brdf_data *d, int axis, float *rgb, size_t places)
{
    size_t stride = 1, count = (size_t)d->counts[axis], left = 0;
    for (int i = axis + 1; i < kinds[d->kind].axes; i++)
        stride *= (size_t)d->counts[i];
    for (size_t line = 0; line < places / count; line++) {
        float *from = rgb + 3 * (line / stride * stride * count + line % stride);
        for (size_t i = 1; i < count; i++)
            take_neighbour(from + 3 * stride * i, from + 3 * stride * (i - 1));
        for (size_t i = count - 1; i > 0; i--)
            take_neighbour(from + 3 * stride * (i - 1), from + 3 * stride * i);
        left += from[0] < 0.0f ? count : 0; /* all or none of a line */
    }
    return left;
}

/* A copy of the values in scratch without gaps. */
static float *filled(const brdf_data *d, size_t places, arena *scratch, float *missing, notices *n,
                     lux_error *err)
{
    float *rgb = arena_array(scratch, float, 3 * places, err);
    if (!rgb)
        return NULL;
    memcpy(rgb, d->rgb, 3 * places * sizeof *rgb);
    size_t gaps = 0;
    for (size_t i = 0; i < places; i++) {
        for (size_t k = 0; k < 3; k++)
            if (!(rgb[3 * i + k] <= 1e30f)) /* NaN: no */
                return failed(err, ERR_FORMAT, "%s: value %zu is no number below 1e30", d->name,
                              3 * i + k + 1);
        bool gap = rgb[3 * i] < 0.0f || rgb[3 * i + 1] < 0.0f || rgb[3 * i + 2] < 0.0f;
        for (size_t k = 0; k < 3 && gap; k++)
            rgb[3 * i + k] = -1.0f;
        gaps += gap;
    }
    *missing = (float)((double)gaps / (double)places);
    if (gaps == places)
        return failed(err, ERR_FORMAT, "%s: no place has data", d->name);
    if (gaps == 0)
        return rgb;

    notice_add(n, "%s: %.3g %% of its places have no data: they repeat their neighbours'", d->name,
               100.0 * (double)*missing);
    static const int along[] = { 0, 2, 1, 3 };
    for (size_t left = gaps, i = 0; left > 0; i++)
        if (along[i % 4] < kinds[d->kind].axes)
            left = fill_along(d, along[i % 4], rgb, places);
    return rgb;
}

static bool make_values(brdf *b, const brdf_data *d, int *const from[4], arena *a, arena *scratch,
                        notices *n, lux_error *err)
{
    size_t stored = 1, places = 1;
    int axes = kinds[d->kind].axes, at[4] = { 0 };
    for (int i = 0; i < axes; i++) {
        stored *= (size_t)d->counts[i];
        places *= (size_t)b->axes[i].count;
    }
    float *rgb = filled(d, stored, scratch, &b->figures.missing, n, err);
    b->values  = rgb ? arena_alloc(a, 4 * places, sizeof(float), 16, err) : NULL;
    if (!b->values)
        return false;
    for (size_t i = 0; i < places; i++) {
        int index[4];
        for (int k = 0; k < axes; k++)
            index[kinds[d->kind].order[k]] = from[k][at[k]];
        size_t source = 0;
        for (int k = 0; k < axes; k++)
            source = source * (size_t)d->counts[k] + (size_t)index[k];
        memcpy(b->values + 4 * i, rgb + 3 * source, 3 * sizeof(float));
        for (int k = axes - 1; k >= 0 && ++at[k] == b->axes[k].count; k--)
            at[k] = 0;
    }
    b->figures.bytes = 16 * places;
    return true;
}

static bool count_places(const brdf_data *d, const brdf *b, lux_error *err)
{
    int64_t stored = 1, places = 1;
    for (int i = 0; i < kinds[d->kind].axes; i++) {
        stored *= d->counts[i]; /* two factors of at most 2^22 and an int: never too large */
        places *= b->axes[i].count;
        if (stored > BRDF_MOST_PLACES || places > BRDF_MOST_PLACES)
            return failed(err, ERR_FORMAT, "%s: more than %d places", d->name, BRDF_MOST_PLACES);
    }
    return true;
}

static bool make(brdf *b, const brdf_data *d, arena *a, arena *scratch, notices *n, lux_error *err)
{
    int *from[4];
    for (int i = 0; i < kinds[d->kind].axes; i++)
        if (!make_axis(d, kinds[d->kind].order[i], a, scratch, &b->axes[i], &from[i], err))
            return false;
    return count_places(d, b, err) && make_values(b, d, from, a, scratch, n, err) &&
           brdf_integrate(b, a, d->name, n, err);
}

const brdf *brdf_make(arena *a, const brdf_data *d, notices *n, lux_error *err)
{
    brdf *b = arena_new(a, brdf, err);
    if (!b)
        return NULL;
    b->kind    = d->kind;
    b->figures = (brdf_figures){
        .kind = d->kind, .axes = kinds[d->kind].axes, .bands = d->bands, .scale_least = 1.0f
    };
    memcpy(b->figures.counts, d->counts, sizeof b->figures.counts);
    arena scratch = { 0 };
    bool made     = make(b, d, a, &scratch, n, err);
    arena_clear(&scratch);
    return made ? b : NULL;
}
