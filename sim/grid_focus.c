/* sim/grid_focus.c -- see grid_parts.h: focused light, by squares about sensors.
 *
 * The spread of what SCRAMBLES maps know of a square tells its noise, a square of twice the area
 * around it what it smoothes. Both are rough, and where next to no particle came, or the field
 * around happens to be as bright in the mean as in the middle, they are far too small. So, as in
 * accuracy.h, no square is taken to be much surer than the others are.
 *
 * Noise: of particles of w watts the irradiance E on an area A has the variance w E / A, with w
 * what all squares together have,
 *
 *     w = sum h^2 A / sum E             (h: half widths)
 *
 * and where h is less than that the mean of both counts. Smoothing s: in the same way by its share
 * in E, sqrt(sum s^2 / sum E^2). E there is the mean of the square's own and of all: that of a
 * square which particles missed tells nothing.
 */
#include "core/color.h"
#include "sim/grid_parts.h"

static const double square_share = 0.25;  /* of the way from sensor to sensor */
static const float square_side   = 0.05f; /* m, at most: of the squares where focused light is
                                             looked for */
static const float least_side = 2e-3f;    /* m: none is made smaller below */

static float side_of_squares(const study_grid *grid)
{
    double u, v;
    if (grid->points)
        return square_side;
    study_grid_counts(grid, &u, &v);
    double step = fmin(d3_length(grid->u) / u, d3_length(grid->v) / v);
    return fminf((float)(square_share * step), square_side);
}

/* ---- what maps know -------------------------------------------------------------------------- */

/* lx, of channel q as accuracy.h judges it: what the map of that number knows at a sensor;
 * smoothed: by its larger square. */
static double focused_of(const grid_run_state *g, int q, int sensor, int set, bool smoothed)
{
    double sum = 0.0;
    for (int l = g->layers ? 0 : -1; l < g->layers; l++) {
        bool counts = g->moments ? l == 0 || l == 1 + q : q <= FULL || l == q - LAYERS;
        if (!counts)
            continue;
        vec3 coarse, fine = illumination_map_at_sensor(g->maps.focused, sensor, set, l, &coarse);
        double dimmed =
            !g->moments && q == SAMPLED && l >= 0 ? (double)scene_dimming_of_group(g->s, l) : 1.0;
        sum += dimmed * LUMENS_PER_WATT * (double)rgb_luminance(smoothed ? coarse : fine);
    }
    return sum;
}

/* By that square alone; to->smoothed is left. */
static void know_square(const grid_run_state *g, int q, int sensor, double *noise, grid_focus *to)
{
    double of[SCRAMBLES], off[SCRAMBLES], smoothed;
    for (int set = 0; set < SCRAMBLES; set++) {
        of[set]  = focused_of(g, q, sensor, set, false);
        off[set] = of[set] - focused_of(g, q, sensor, set, true);
    }
    *noise    = accuracy_half_width(of, SCRAMBLES, &to->lux);
    to->doubt = STEPS_SMOOTHED * accuracy_half_width(off, SCRAMBLES, &smoothed);
    to->own   = STEPS_SMOOTHED * fabs(smoothed);
}

/* Where the square of `own` is less than that of all, the mean of both. */
static double pooled(double own, double square_of_all)
{
    return sqrt(fmax(own * own, 0.5 * (own * own + square_of_all)));
}

static void know_channel(const grid_run_state *g, const grid_squares *squares, int q)
{
    int n         = g->r->sensor_count;
    double *noise = g->fixed + (size_t)q * (size_t)n;
    grid_focus *f = g->focus + (size_t)q * (size_t)n;
    double flux = 0.0, smoothed = 0.0, sum = 0.0, square = 0.0;
    for (int k = 0; k < n; k++) {
        double side = (double)squares->side[k];
        know_square(g, q, k, &noise[k], &f[k]);
        flux += noise[k] * noise[k] * side * side;
        smoothed += f[k].own * f[k].own;
        sum += f[k].lux;
        square += f[k].lux * f[k].lux;
    }
    for (int k = 0; k < n && sum > 0.0; k++) {
        double side = (double)squares->side[k], e = 0.5 * (f[k].lux + sum / n);
        noise[k]      = pooled(noise[k], flux / sum * e / (side * side));
        f[k].smoothed = pooled(f[k].own, smoothed / square * e * e);
    }
}

/* Maps are as they are, one for each scramble: more samples do not tell more of them. */
static bool know_focused(grid_run_state *g, arena *a, const grid_squares *squares, lux_error *err)
{
    size_t all = (size_t)g->r->sensor_count * (size_t)g->channels.judged;
    g->fixed   = arena_array(a, double, all, err);
    g->focus   = g->fixed ? arena_array(a, grid_focus, all, err) : NULL;
    for (int q = 0; g->focus && q < g->channels.judged; q++)
        know_channel(g, squares, q);
    return g->focus != NULL;
}

/* ---- what they are to know ------------------------------------------------------------------- */

/* How well a map serves. */
typedef struct fitness {
    int missed;  /* sensors at which it is too far off, */
    double over; /* and by what they are in all: the sum of logarithms of how many times */
    double more; /* times as many particles are called for, about */
} fitness;

/* What channels that are held to the accuracy ask of a sensor's square. */
typedef struct demand {
    double over;    /* times, that it is too far off at worst, */
    double noise;   /* and that its noise alone is */
    double smaller; /* times, that it is to be */
    double allowed; /* lx */
} demand;

static const double share_of_maps = 0.8; /* of the accuracy: then a third of the square is left for
                                            the rest */
static const double may_smooth = 0.2;    /* of the accuracy, where it can be helped */

/* Smoothing that hides in noise is left until there are more particles. */
static double smaller_by(const grid_focus *f, double noise, double asked)
{
    double sure = f->smoothed - f->doubt, enough = 0.5 * may_smooth * asked;
    bool plain = sure > fmax(enough, 0.5 * noise);
    return plain ? fmin(fmax(sqrt(enough / sure), 0.25), 0.7) : 1.0;
}

/* As accuracy.h holds channels to it; `rough` and what is known besides are light, too. */
static void demand_of_channel(const grid_run_state *g, int q, demand *of)
{
    size_t n = (size_t)g->r->sensor_count, first = (size_t)q * n;
    bool part    = g->layers && !g->moments;
    size_t floor = part ? (size_t)FULL * n : first;
    double asked = g->r->asked * (part ? PARTS_SHARE : 1.0), mean = 0.0;
    for (size_t k = 0; k < n; k++)
        mean += (g->known[floor + k] + g->rough[floor + k] + g->focus[floor + k].lux) / (double)n;
    for (size_t k = 0; k < n; k++) {
        const grid_focus *f = &g->focus[first + k];
        double e            = g->known[first + k] + g->rough[first + k] + f->lux;
        double allowed      = asked * fmax(e, 0.1 * mean);
        double noise        = g->fixed[first + k] / share_of_maps;
        if (!(allowed > 0.0))
            continue; /* at night */
        of[k].allowed = fmin(of[k].allowed, allowed);
        of[k].noise   = fmax(of[k].noise, noise / ((1.0 - may_smooth) * allowed));
        if (noise + f->smoothed <= allowed)
            continue;
        of[k].over    = fmax(of[k].over, (noise + f->smoothed) / allowed);
        of[k].smaller = fmin(of[k].smaller, smaller_by(f, noise, allowed));
    }
}

/* Makes squares smaller where they smooth too much. */
static fitness fit_squares(const grid_run_state *g, demand *of, grid_squares *q)
{
    double over = 1.0;
    fitness f   = { 0 };
    for (int k = 0; k < g->r->sensor_count; k++)
        of[k] = (demand){ .over = 1.0, .smaller = 1.0, .allowed = HUGE_VAL };
    for (int c = g->layers && !g->moments ? FULL : SAMPLED; c < g->channels.judged; c++)
        demand_of_channel(g, c, of);
    for (int k = 0; k < g->r->sensor_count; k++) {
        q->allowed[k] = of[k].allowed < HUGE_VAL ? (float)of[k].allowed : 1.0f;
        if (of[k].over <= 1.0)
            continue;
        f.missed++;
        f.over += log(of[k].over);
        over = fmax(over, of[k].noise);
        if (of[k].smaller < 1.0 && q->side[k] > least_side)
            q->side[k] *= (float)of[k].smaller;
        else
            over = fmax(over, sqrt(2.0));
    }
    f.more = 1.2 * over * over;
    return f;
}

/* ---- making ---------------------------------------------------------------------------------- */

/* A map, and what is known of it. */
typedef struct known_map {
    light_maps maps;
    double *fixed;
    grid_focus *focus;
    double over;
} known_map;

/* Map upon map: squares are fitted, and of more particles noise is less, until that is enough, or
 * they are too many. The best one is kept. */
static bool grow(grid_run_state *g, arena *a, grid_squares *q, demand *of, lux_error *err)
{
    const int64_t most   = INT64_C(1) << (g->o->deadline < HUGE_VAL ? 26 : 22); /* 10 s */
    const double at_once = 8.0; /* times: what is seen with few is not sure */
    known_map best       = { .over = HUGE_VAL };
    int in_vain          = 0; /* maps that were no better */
    for (int64_t spent = 0;;) {
        fitness fits  = fit_squares(g, of, q);
        map_figures f = illumination_map_figures(g->maps.focused);
        in_vain += fits.over >= best.over;
        if (fits.over < best.over)
            best = (known_map){ g->maps, g->fixed, g->focus, fits.over };
        spent += f.particles;
        double more     = (double)f.particles * fmin(fits.more, at_once);
        double too_late = g->o->deadline - clock_seconds();
        if (fits.missed == 0 || in_vain == 2 || 4 * spent > 3 * most ||
            f.seconds * more / (double)f.particles > 0.5 * too_late)
            break;
        more = fmin(more, (double)(most - spent));
        if (!light_maps_focused(a, g->s, g->o, g->r->asked, &q->of, (int64_t)more, &g->maps, err) ||
            !know_focused(g, a, q, err))
            return false;
    }
    int64_t rays = g->maps.rays;
    g->maps      = best.maps;
    g->fixed     = best.fixed;
    g->focus     = best.focus;
    g->maps.rays = rays;
    return true;
}

bool grid_grow_focused(grid_run_state *g, arena *a, grid_squares *q, lux_error *err)
{
    demand *of    = arena_array(a, demand, (size_t)g->r->sensor_count, err);
    q->of.allowed = q->allowed;
    return of && grid_find_rough(g, a, err) && know_focused(g, a, q, err) && grow(g, a, q, of, err);
}

bool grid_squares_new(const grid_run_state *g, arena *a, grid_squares *q, lux_error *err)
{
    size_t n     = (size_t)g->r->sensor_count;
    vec3 *at     = arena_array(a, vec3, n, err);
    vec3 *normal = at ? arena_array(a, vec3, n, err) : NULL;
    q->side      = normal ? arena_array(a, float, n, err) : NULL;
    q->allowed   = q->side ? arena_array(a, float, n, err) : NULL;
    q->of        = (map_sensors){ .count    = (int)n,
                                  .at       = at,
                                  .normal   = normal,
                                  .side     = side_of_squares(g->r->grid),
                                  .quantity = g->r->grid->quantity,
                                  .sides    = q->side };
    for (size_t k = 0; q->allowed && k < n; k++) {
        at[k]      = scene_place(g->s, g->r->sensors[k].at);
        normal[k]  = d3_to_float(g->r->sensors[k].normal);
        q->side[k] = q->of.side;
    }
    return q->allowed != NULL;
}
