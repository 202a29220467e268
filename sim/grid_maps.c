/* sim/grid_maps.c -- see grid_parts.h: illumination maps that the sensors of a grid ask. */
#include "sim/grid_parts.h"

enum { MOST_REFINED = 1 }; /* times that maps are made anew, of four times the particles */

bool grid_make_maps(grid_run_state *g, arena *a, lux_error *err)
{
    grid_squares q;
    if (!grid_squares_new(g, a, &q, err) ||
        !light_maps_make(a, g->s, g->o, g->r->asked, &q.of, &g->maps, err) ||
        (g->maps.focused && !grid_grow_focused(g, a, &q, err)))
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
    /* In layers how groups are dimmed is to change no sample, nor what maps smooth of that */
    bool own =
        g->maps.indirect && !g->o->indirect && !g->o->maps && !g->o->only_samples && !g->layers;
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
