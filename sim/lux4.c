/* sim/lux4.c -- see lux4.h: the stages of the simulator, behind plain types. */
#include "sim/lux4.h"

#include "core/parallel.h"
#include "sim/accuracy.h"
#include "sim/command.h"
#include "sim/render.h"

#include <string.h>

struct lux4 {
    arena a; /* everything lives here, this struct too */
    notices notices;
    const study *study;
    const scene *scene;
};

typedef struct owned_grid {
    lux4_grid public; /* first: what the caller sees is this */
    arena a;
} owned_grid;

typedef struct owned_view {
    lux4_view public;
    arena a;
} owned_view;

const char *lux4_version(void) { return LUX4_VERSION; }

static void *give_error(const lux_error *from, lux4_error *to)
{
    if (!to)
        return NULL;
    int exit = exit_code_of(from, true);
    to->code = exit == EXIT_INTERRUPTED ? LUX4_INTERRUPTED
               : exit == EXIT_RUNTIME   ? LUX4_RUNTIME
                                        : LUX4_INPUT;
    memcpy(to->text, from->text, sizeof to->text);
    return NULL;
}
_Static_assert(sizeof((lux4_error *)0)->text == sizeof((lux_error *)0)->text,
               "one line is as long");

lux4 *lux4_open(const char *path, lux4_error *err) { return lux4_open_variant(path, NULL, err); }

lux4 *lux4_open_variant(const char *path, const char *variant, lux4_error *err)
{
    lux_error why = { 0 };
    arena a       = { 0 };
    lux4 *l       = arena_new(&a, lux4, &why);
    if (l) {
        l->notices.a = &l->a;
        l->a         = a; /* from here on, the arena is the one inside */
        l->study     = study_read(&l->a, path, variant, &l->notices, &why);
        l->scene     = l->study ? scene_new(&l->a, l->study,
                                            &(scene_options){ .threads = parallel_processors() },
                                            &l->notices, &why)
                                : NULL;
        if (l->scene)
            return l;
        a = l->a;
    }
    arena_clear(&a);
    return give_error(&why, err);
}

void lux4_close(lux4 *l)
{
    if (!l)
        return;
    arena a = l->a;
    arena_clear(&a);
}

int lux4_warning_count(const lux4 *l) { return l->notices.count; }
const char *lux4_warning(const lux4 *l, int index)
{
    const notice *n = l->notices.first;
    for (int i = 0; n && i < index; i++)
        n = n->next;
    return n ? n->text : NULL;
}

int lux4_grid_count(const lux4 *l) { return l->study->grid_count; }
const char *lux4_grid_name(const lux4 *l, int i) { return l->study->grids[i].name; }
int lux4_view_count(const lux4 *l) { return l->study->view_count; }
const char *lux4_view_name(const lux4 *l, int i) { return l->study->views[i].name; }

static run_options options_of(const lux4_options *o, progress *p)
{
    const lux4_options none = { 0 };
    if (!o)
        o = &none;
    *p = (progress){ .draw = o->progress, .context = o->context, .stop = o->stop };
    return (run_options){ .accuracy    = o->accuracy > 0.0 ? o->accuracy : (double)NAN,
                          .deadline    = o->seconds > 0.0 ? clock_seconds() + o->seconds : HUGE_VAL,
                          .seed        = o->seed ? o->seed : 1,
                          .threads     = o->threads > 0 ? o->threads : parallel_processors(),
                          .direct_only = o->direct_only,
                          .progress    = p };
}

/* Places and normals by component. */
static bool split_sensors(owned_grid *g, const grid_result *r, lux_error *err)
{
    double **to[] = { &g->public.x,        &g->public.y,        &g->public.z,
                      &g->public.normal_x, &g->public.normal_y, &g->public.normal_z };
    for (int c = 0; c < 6; c++) {
        *to[c] = arena_array(&g->a, double, (size_t)r->sensor_count, err);
        if (!*to[c])
            return false;
    }
    for (int k = 0; k < r->sensor_count; k++) {
        const grid_sensor *s = &r->sensors[k];
        g->public.x[k] = s->at.x, g->public.y[k] = s->at.y, g->public.z[k] = s->at.z;
        g->public.normal_x[k] = s->normal.x, g->public.normal_y[k] = s->normal.y;
        g->public.normal_z[k] = s->normal.z;
    }
    return true;
}

lux4_grid *lux4_run_grid(lux4 *l, int index, const lux4_options *options, lux4_error *err)
{
    lux_error why = { 0 };
    arena a       = { 0 };
    grid_result r;
    progress p;
    run_options o = options_of(options, &p);
    if (index < 0 || index >= l->study->grid_count) {
        failed(&why, ERR_ARGUMENT, "%s: grid %d of %d", l->study->path, index,
               l->study->grid_count);
        return give_error(&why, err);
    }
    owned_grid *g = arena_new(&a, owned_grid, &why);
    if (g && grid_run(&a, l->scene, &l->study->grids[index], &o, &r, &why)) {
        g->public = (lux4_grid){ .name             = r.grid->name,
                                 .quantity         = grid_quantity_name(r.grid->quantity),
                                 .sensor_count     = r.sensor_count,
                                 .left_out         = r.left_out,
                                 .columns          = r.columns,
                                 .rows             = r.rows,
                                 .illuminance_lx   = r.illuminance,
                                 .direct_lx        = r.direct,
                                 .indirect_lx      = r.indirect,
                                 .half_width_lx    = r.half_width,
                                 .average_lx       = r.average,
                                 .minimum_lx       = r.minimum,
                                 .maximum_lx       = r.maximum,
                                 .uniformity       = r.uniformity,
                                 .missed           = r.missed,
                                 .accuracy_reached = r.reached,
                                 .enough           = r.end == RUN_DONE,
                                 .interrupted      = r.end == RUN_INTERRUPTED,
                                 .left_to_chance   = r.left_to_chance,
                                 .seconds          = r.seconds,
                                 .rays             = r.rays };
        g->a      = a;
        if (split_sensors(g, &r, &why))
            return &g->public;
        a = g->a;
    }
    arena_clear(&a);
    return give_error(&why, err);
}

void lux4_grid_free(lux4_grid *grid)
{
    if (!grid)
        return;
    arena a = ((owned_grid *)grid)->a;
    arena_clear(&a);
}

lux4_view *lux4_run_view(lux4 *l, int index, const lux4_options *options, lux4_error *err)
{
    lux_error why = { 0 };
    arena a       = { 0 };
    view_result r;
    progress p;
    run_options o = options_of(options, &p);
    if (index < 0 || index >= l->study->view_count) {
        failed(&why, ERR_ARGUMENT, "%s: view %d of %d", l->study->path, index,
               l->study->view_count);
        return give_error(&why, err);
    }
    owned_view *v = arena_new(&a, owned_view, &why);
    if (v && view_run(&a, l->scene, &l->study->views[index], &o, &r, &why)) {
        v->public = (lux4_view){ .name             = r.view->name,
                                 .width            = r.width,
                                 .height           = r.height,
                                 .red              = r.radiance[0],
                                 .green            = r.radiance[1],
                                 .blue             = r.radiance[2],
                                 .illuminance_lx   = r.illuminance,
                                 .half_width_cd_m2 = r.half_width,
                                 .distance_m       = r.distance,
                                 .normal_x         = r.normal[0],
                                 .normal_y         = r.normal[1],
                                 .normal_z         = r.normal[2],
                                 .albedo_red       = r.albedo[0],
                                 .albedo_green     = r.albedo[1],
                                 .albedo_blue      = r.albedo[2],
                                 .accuracy_reached = r.reached,
                                 .enough           = r.end == RUN_DONE,
                                 .interrupted      = r.end == RUN_INTERRUPTED,
                                 .left_to_chance   = r.left_to_chance,
                                 .seconds          = r.seconds,
                                 .rays             = r.rays };
        v->a      = a;
        return &v->public;
    }
    arena_clear(&a);
    return give_error(&why, err);
}

void lux4_view_free(lux4_view *view)
{
    if (!view)
        return;
    arena a = ((owned_view *)view)->a;
    arena_clear(&a);
}
