/* sim/grid_maps.c -- see grid_parts.h: illumination maps that the sensors of a grid ask. */
#include "core/color.h"
#include "sim/grid_parts.h"

#include <limits.h>

enum { MOST_REFINED = 1 }; /* times that maps are made anew, of four times the particles */

static const double square_share = 0.25;  /* of the way from sensor to sensor */
static const float square_side   = 0.05f; /* m, at most: of the squares where focused light is
                                             looked for */
static const float least_side = 2e-3f;    /* m: none is made smaller below */
static const double student_t = 2.1314;   /* 97.5 %, of SCRAMBLES - 1 degrees of freedom */

static float side_of_squares(const study_grid *grid)
{
    double u, v;
    if (grid->points)
        return square_side;
    study_grid_counts(grid, &u, &v);
    double step = fmin(d3_length(grid->u) / u, d3_length(grid->v) / v);
    return fminf((float)(square_share * step), square_side);
}

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

/* Half of the 95 % interval of their mean. */
static double half_width_of(const double of[SCRAMBLES], double *mean)
{
    double square = 0.0;
    *mean         = 0.0;
    for (int set = 0; set < SCRAMBLES; set++)
        *mean += of[set] / SCRAMBLES;
    for (int set = 0; set < SCRAMBLES; set++)
        square += (of[set] - *mean) * (of[set] - *mean);
    return student_t * sqrt(square / (SCRAMBLES - 1) / SCRAMBLES);
}

/* Maps are as they are, one for each scramble: more samples do not tell more of them. */
static bool note_fixed(grid_run_state *g, arena *a, lux_error *err)
{
    size_t n = (size_t)g->r->sensor_count;
    g->fixed = arena_array(a, double, n *(size_t)g->channels.judged, err);
    for (size_t k = 0; g->fixed && k < n; k++)
        for (int q = 0; q < g->channels.judged; q++) {
            double of[SCRAMBLES], ignored;
            for (int set = 0; set < SCRAMBLES; set++)
                of[set] = focused_of(g, q, (int)k, set, false);
            g->fixed[(size_t)q * n + k] = half_width_of(of, &ignored);
        }
    return g->fixed != NULL;
}

/* Squares about sensors, as they are fitted to what their light calls for. */
typedef struct squares {
    map_sensors of;
    float *side, *allowed;
} squares;

/* What is known of a sensor's light, lx. */
typedef struct known_light {
    double all;
    double smoothed; /* how far off its square may make it, */
    double sure;     /* and what of that is more than noise */
    double asked;    /* how far off all may be */
} known_light;

static void know_light(const grid_run_state *g, known_light *to)
{
    size_t n    = (size_t)g->r->sensor_count;
    double mean = 0.0;
    for (size_t k = 0; k < n; k++) {
        double fine = 0.0, off[SCRAMBLES], smoothed;
        for (int set = 0; set < SCRAMBLES; set++) {
            double of = focused_of(g, SAMPLED, (int)k, set, false);
            off[set]  = of - focused_of(g, SAMPLED, (int)k, set, true);
            fine += of / SCRAMBLES;
        }
        double noise = half_width_of(off, &smoothed);
        smoothed     = fabs(smoothed);
        to[k]        = (known_light){ .all      = g->known[k] + g->rough[k] + fine,
                                      .smoothed = STEPS_SMOOTHED * smoothed,
                                      .sure     = STEPS_SMOOTHED * (smoothed - noise) };
        mean += to[k].all / (double)n;
    }
    for (size_t k = 0; k < n; k++)
        to[k].asked = g->r->asked * fmax(to[k].all, 0.1 * mean);
}

/* How well a map serves. */
typedef struct fitness {
    int missed;  /* sensors at which it is too far off */
    double more; /* times as many particles are called for, about */
} fitness;

/* Makes squares smaller where they smooth too much. */
static fitness fit_squares(const grid_run_state *g, const known_light *known, squares *q)
{
    const double share = 0.8; /* of the accuracy: then a third of the square is left for the rest */
    const double most  = 0.2; /* of that, that may be smoothed where it can be helped */
    double over        = 1.0;
    fitness f          = { 0 };
    for (size_t k = 0; k < (size_t)g->r->sensor_count; k++) {
        const known_light *l = &known[k];
        double noise         = g->fixed[k] / share;
        bool too_smooth      = l->sure > 0.5 * most * l->asked && q->side[k] > least_side;
        q->allowed[k]        = (float)l->asked;
        if (noise + l->smoothed <= l->asked)
            continue;
        f.missed++;
        over = fmax(over, noise / ((1.0 - most) * l->asked));
        if (too_smooth)
            q->side[k] *= (float)fmin(fmax(sqrt(0.5 * most * l->asked / l->sure), 0.25), 0.7);
        else
            over = fmax(over, sqrt(2.0));
    }
    f.more = 1.2 * over * over;
    return f;
}

/* A map, and g->fixed of it. */
typedef struct known_map {
    light_maps maps;
    double *fixed;
    int missed;
} known_map;

/* Map upon map: squares are fitted, and of more particles noise is less, until that is enough, or
 * they are too many. The best one is kept. */
static bool grow_focused(grid_run_state *g, arena *a, squares *q, known_light *known,
                         lux_error *err)
{
    const int64_t most   = INT64_C(1) << (g->o->deadline < HUGE_VAL ? 26 : 22); /* 10 s */
    const double at_once = 8.0; /* times: what is seen with few is not sure */
    known_map best       = { .missed = INT_MAX };
    int in_vain          = 0; /* maps that were no better */
    for (int64_t spent = 0;;) {
        know_light(g, known);
        fitness of    = fit_squares(g, known, q);
        map_figures f = illumination_map_figures(g->maps.focused);
        in_vain += of.missed >= best.missed;
        if (of.missed <= best.missed)
            best = (known_map){ g->maps, g->fixed, of.missed };
        spent += f.particles;
        double more     = (double)f.particles * fmin(of.more, at_once);
        double too_late = g->o->deadline - clock_seconds();
        if (of.missed == 0 || in_vain == 2 || 4 * spent > 3 * most ||
            f.seconds * more / (double)f.particles > 0.5 * too_late)
            break;
        more = fmin(more, (double)(most - spent));
        if (!light_maps_focused(a, g->s, g->o, g->r->asked, &q->of, (int64_t)more, &g->maps, err) ||
            !note_fixed(g, a, err))
            return false;
    }
    int64_t rays = g->maps.rays;
    g->maps      = best.maps;
    g->fixed     = best.fixed;
    g->maps.rays = rays;
    return true;
}

static bool make_squares(const grid_run_state *g, arena *a, squares *q, lux_error *err)
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

bool grid_make_maps(grid_run_state *g, arena *a, lux_error *err)
{
    squares q;
    known_light *known = arena_array(a, known_light, (size_t)g->r->sensor_count, err);
    if (!known || !make_squares(g, a, &q, err) ||
        !light_maps_make(a, g->s, g->o, g->r->asked, &q.of, &g->maps, err))
        return false;
    q.of.allowed = q.allowed;
    if (g->maps.focused && (!grid_find_rough(g, a, err) || !note_fixed(g, a, err) ||
                            !grow_focused(g, a, &q, known, err)))
        return false;
    for (int t = 0; t < g->o->threads; t++)
        path_use_maps(g->threads[t].paths, g->maps.indirect, g->maps.focused);
    for (int t = 0; g->o->pilot && scene_focuses(g->s) && t < g->o->threads; t++)
        path_leave_focused(g->threads[t].paths);
    return true;
}

/* ---- finer maps ------------------------------------------------------------------------------ */

/* As long as all has taken so far, five times over. */
static bool has_time(const grid_run_state *g)
{
    double now = clock_seconds();
    return now + 5.0 * (now - g->begun) < g->o->deadline;
}

bool grid_refine_maps(grid_run_state *g, arena *a, accuracy_result *got, bool *finer,
                      lux_error *err)
{
    bool own   = g->maps.indirect && !g->o->indirect && !g->o->maps && !g->o->only_samples;
    bool ended = got->end == RUN_HELD_UP || got->end == RUN_DONE;
    *finer = own && ended && g->refined < MOST_REFINED && has_time(g) && grid_is_smoothed(g, got);
    if (!*finer)
        return true;
    const illumination_map *map = g->maps.indirect;
    double accuracy             = g->r->asked / (double)(2 << g->refined++);
    int64_t before              = illumination_map_figures(map).particles;
    *finer                      = illumination_map_calls_for(map, accuracy, NULL) >
             illumination_map_calls_for(map, g->r->asked, NULL);
    if (!*finer)
        return true;
    if (!light_maps_indirect(a, g->s, g->o, accuracy, &map, NULL, err)) {
        bool stopped = err->code == ERR_INTERRUPTED;
        *finer       = false;
        got->end     = RUN_INTERRUPTED;
        *err         = stopped ? (lux_error){ 0 } : *err;
        return stopped;
    }
    map_figures f = illumination_map_figures(map);
    g->maps.rays += f.rays;
    g->maps.indirect = map;
    *finer           = f.particles > before;
    for (int t = 0; t < g->o->threads; t++)
        path_use_maps(g->threads[t].paths, g->maps.indirect, g->maps.focused);
    return true;
}
