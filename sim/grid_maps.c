/* sim/grid_maps.c -- see grid_parts.h: illumination maps that the sensors of a grid ask. */
#include "core/color.h"
#include "sim/grid_parts.h"

enum { MOST_REFINED = 1 }; /* times that maps are made anew, of four times the particles */

static const double square_share = 0.25;  /* of the way from sensor to sensor */
static const float square_side   = 0.05f; /* m, at most: of the squares where focused light is
                                             looked for */
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

/* lx, of channel q as accuracy.h judges it: what the map of that number knows at a sensor. */
static double focused_of(const grid_run_state *g, int q, int sensor, int set)
{
    double sum = 0.0;
    for (int l = g->layers ? 0 : -1; l < g->layers; l++) {
        bool counts = g->moments ? l == 0 || l == 1 + q : q <= FULL || l == q - LAYERS;
        if (!counts)
            continue;
        vec3 coarse, fine = illumination_map_at_sensor(g->maps.focused, sensor, set, l, &coarse);
        double dimmed =
            !g->moments && q == SAMPLED && l >= 0 ? (double)scene_dimming_of_group(g->s, l) : 1.0;
        sum += dimmed * LUMENS_PER_WATT * (double)rgb_luminance(fine);
    }
    return sum;
}

/* Maps are as they are, one for each scramble: more samples do not tell more of them. */
static bool note_fixed(grid_run_state *g, arena *a, lux_error *err)
{
    size_t n = (size_t)g->r->sensor_count;
    g->fixed = arena_array(a, double, n *(size_t)g->channels.judged, err);
    for (size_t k = 0; g->fixed && k < n; k++)
        for (int q = 0; q < g->channels.judged; q++) {
            double of[SCRAMBLES], mean = 0.0, square = 0.0;
            for (int set = 0; set < SCRAMBLES; set++) {
                of[set] = focused_of(g, q, (int)k, set);
                mean += of[set] / SCRAMBLES;
            }
            for (int set = 0; set < SCRAMBLES; set++)
                square += (of[set] - mean) * (of[set] - mean);
            g->fixed[(size_t)q * n + k] = student_t * sqrt(square / (SCRAMBLES - 1) / SCRAMBLES);
        }
    return g->fixed != NULL;
}

/* By how much a map's noise is too large, at the worst sensor, for what is known of its light. */
static double too_noisy(const grid_run_state *g)
{
    const double share = 0.7; /* of the accuracy: then half of the square is left for the rest */
    size_t n           = (size_t)g->r->sensor_count;
    double mean = 0.0, worst = 0.0;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < n; k++) {
            double all = g->known[k];
            for (int set = 0; set < SCRAMBLES; set++)
                all += focused_of(g, SAMPLED, (int)k, set) / SCRAMBLES;
            if (pass == 0)
                mean += all / (double)n;
            else
                worst = fmax(worst, g->fixed[k] / (share * g->r->asked * fmax(all, 0.1 * mean)));
        }
    return worst;
}

/* More particles, as noise falls with the root of their number, until they are enough or too many.
 */
static bool grow_focused(grid_run_state *g, arena *a, const map_sensors *m, lux_error *err)
{
    const int64_t most   = INT64_C(1) << (g->o->deadline < HUGE_VAL ? 26 : 23); /* half a minute */
    const double at_once = 16.0; /* times: what is seen with few is not sure */
    for (;;) {
        double over     = too_noisy(g);
        int64_t so_far  = illumination_map_figures(g->maps.focused).particles;
        double factor   = fmin(1.2 * over * over, at_once);
        int64_t more    = (int64_t)((double)so_far * factor);
        double too_late = g->o->deadline - clock_seconds();
        double seconds  = illumination_map_figures(g->maps.focused).seconds * factor;
        if (!(over > 1.0) || so_far >= most || seconds > 0.5 * too_late)
            return true;
        if (!light_maps_focused(a, g->s, g->o, g->r->asked, m, more < most ? more : most, &g->maps,
                                err) ||
            !note_fixed(g, a, err))
            return false;
    }
}

bool grid_make_maps(grid_run_state *g, arena *a, lux_error *err)
{
    size_t n      = (size_t)g->r->sensor_count;
    vec3 *at      = arena_array(a, vec3, n, err);
    vec3 *normal  = at ? arena_array(a, vec3, n, err) : NULL;
    map_sensors m = { (int)n, at, normal, side_of_squares(g->r->grid), g->r->grid->quantity };
    for (size_t k = 0; normal && k < n; k++) {
        at[k]     = scene_place(g->s, g->r->sensors[k].at);
        normal[k] = d3_to_float(g->r->sensors[k].normal);
    }
    if (!normal || !light_maps_make(a, g->s, g->o, g->r->asked, &m, &g->maps, err))
        return false;
    if (g->maps.focused && (!note_fixed(g, a, err) || !grow_focused(g, a, &m, err)))
        return false;
    for (int t = 0; t < g->o->threads; t++)
        path_use_maps(g->threads[t].paths, g->maps.indirect, g->maps.focused);
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
    double accuracy = g->r->asked / (double)(2 << g->refined++);
    int64_t before  = illumination_map_figures(g->maps.indirect).particles;
    const illumination_map *map;
    if (!light_maps_indirect(a, g->s, g->o, accuracy, &map, err)) {
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
