/* sim/plan_pilot.c -- what paths and maps would cost: see plan_parts.h.
 *
 * Some of the sensors, or the views made small, get a few samples of paths, and if these are not
 * there at once, of paths that end in a map of few particles. A sensor whose half width is h after
 * n samples takes
 *
 *     n (h / (accuracy * max(E, floor)))^(1/b)        doubled as accuracy.h does,
 *
 * each of the rays that one takes here, where half widths fall as n^-b. Even samples make b more
 * than 1/2: it is taken to lie half way to where a quarter of the samples sees it, as what they
 * gain at first fades. What particles a map is made of is known as the map itself would know it.
 * What it smooths falls with the size of its cells, which are as large as it takes to give each the
 * same number of particles: as N^-1/2, and so does its noise. Where either would take too much of
 * the accuracy samples would be drawn in vain: paths are taken. Rays and samples are counted, and
 * no time is taken: the same study has the same plan on each machine.
 */
#include "core/color.h"
#include "sim/light_maps.h"
#include "sim/plan_parts.h"
#include "sim/render.h"

#include <stdlib.h>

enum {
    FEWEST_SAMPLES = 64,   /* a sensor */
    MOST_OF_ONE    = 1024, /* the same */
    ALL_SAMPLES    = 8192, /* of all sensors, about */
    MOST_SENSORS   = ALL_SAMPLES / FEWEST_SAMPLES,
    FEWEST_SENSORS = 4,               /* of a grid */
    LESS_AT_FIRST  = 4,               /* times */
    MAP_SAMPLES    = 4 * ALL_SAMPLES, /* that end in a map */
    PIXEL_SAMPLES  = SCRAMBLES,
    MOST_PIXELS    = 768,
    MOST_PLACES    = 8, /* grids or views */
    PARTICLES      = 1 << 15,
    GRID_LEAST     = LEAST_ROUNDS * 8 * SCRAMBLES,  /* samples that a run takes of a sensor, */
    GLOSSY_LEAST   = LEAST_ROUNDS * MIRROR_SAMPLES, /* where some light is rarely met; of a pixel */
    VIEW_LEAST     = LEAST_ROUNDS * SCRAMBLES * VIEW_FIRST_SAMPLES,
};

static const double at_once      = 2e6; /* rays: about two seconds, maps take one in any case */
static const double particle_ray = 2.0; /* rays of paths: measured, growing cells included */
static const double worth_a_map  = 3.0; /* times what a pilot of maps costs: else it is not made */
static const double speed        = 1e6; /* rays/s, about: of what a run may take at most */
static const double least_slope  = 0.5; /* of independent samples */
static const double most_slope   = 0.7;
static const double least_left   = 0.6;  /* of variance, beside noise that all of a map has */
static const double left_to_maps = 0.15; /* of the accuracy, of grids: see grid.c */

/* A sensor or pixel. */
typedef struct pilot_item {
    double ratio;  /* half width, relative */
    double smooth; /* relative, by the map of the pilot */
    double common; /* the same: its own noise, in all results alike */
    double rays;   /* a sample, of all that this one stands for */
} pilot_item;

typedef struct pilot {
    const plan_facts *f;
    arena *a;
    run_options o;
    int places, step;     /* grids or views, of which each so many are tried */
    double sensors;       /* of those that are tried */
    int samples;          /* an item */
    double needed;        /* of all items, as accurate as asked for */
    double least;         /* samples of a run, an item */
    double smooths;       /* what of the smoothing seen would stay if samples were many */
    double slope;         /* half widths fall with samples to the power of minus that */
    double drawn, traced; /* samples of paths, and their rays */
    pilot_item *items;
    int count, room;
} pilot;

/* ---- trials ---------------------------------------------------------------------------------- */

static bool more_items(pilot *p, int more, lux_error *err)
{
    if (p->count + more <= p->room)
        return true;
    int room        = 2 * (p->count + more);
    pilot_item *all = arena_array(p->a, pilot_item, (size_t)room, err);
    for (int i = 0; all && i < p->count; i++)
        all[i] = p->items[i];
    p->items = all;
    p->room  = room;
    return all != NULL;
}

static void add_item(pilot *p, const pilot_item *of, double against)
{
    p->items[p->count++] = (pilot_item){ .ratio  = of->ratio > 0.0 ? of->ratio / against : 0.0,
                                         .smooth = of->smooth > 0.0 ? of->smooth / against : 0.0,
                                         .common = of->common > 0.0 ? of->common / against : 0.0,
                                         .rays   = of->rays };
}

static bool interrupted(lux_error *err)
{
    return failed(err, ERR_INTERRUPTED, "interrupted while paths and maps were tried");
}

static bool try_grid(pilot *p, arena *scratch, int i, lux_error *err)
{
    const plan_facts *f = p->f;
    grid_result r;
    if (!grid_run(scratch, f->s, &f->s->study->grids[i], &p->o, &r, err) ||
        !more_items(p, r.sensor_count, err))
        return false;
    if (r.end == RUN_INTERRUPTED)
        return interrupted(err);
    p->drawn += (double)r.sensor_count * p->o.only_samples;
    p->traced += (double)(r.rays - r.known_rays);
    double stands_for = f->grids[i].sensor_count * f->sensors / p->sensors / r.sensor_count;
    double rays       = (double)(r.rays - r.known_rays) / ((double)r.sensor_count * p->samples);
    double noise      = p->o.indirect ? illumination_map_noise(p->o.indirect) : 0.0;
    for (int k = 0; k < r.sensor_count; k++) {
        pilot_item of = { .ratio  = r.half_width[k],
                          .smooth = r.smooth ? r.smooth[k] : 0.0,
                          .common = noise * r.indirect[k],
                          .rays   = rays * stands_for };
        add_item(p, &of, fmax(r.illuminance[k], 0.1 * r.average));
    }
    return true;
}

static bool try_view(pilot *p, arena *scratch, int i, lux_error *err)
{
    const plan_facts *f = p->f;
    study_view small    = f->s->study->views[i];
    double pixels       = (double)small.width * small.height;
    double less         = fmin(sqrt(MOST_PIXELS / pixels), 1.0);
    view_result r;
    small.width  = (int)fmax(floor(small.width * less), 1.0);
    small.height = (int)fmax(floor(small.height * less), 1.0);
    if (!view_run(scratch, f->s, &small, &p->o, &r, err) || !more_items(p, r.width * r.height, err))
        return false;
    if (r.end == RUN_INTERRUPTED)
        return interrupted(err);
    int n = r.width * r.height;
    p->drawn += (double)n * p->o.only_samples;
    p->traced += (double)r.rays;
    double rays = (double)r.rays / ((double)n * p->samples) * pixels / n * p->step;
    for (int k = 0; k < n; k++) {
        vec3 l        = { r.radiance[0][k], r.radiance[1][k], r.radiance[2][k] };
        double bright = LUMENS_PER_WATT * (double)rgb_luminance(l);
        pilot_item of = { .ratio = (double)r.half_width[k], .rays = rays };
        add_item(p, &of, fmax(bright, 0.1 * r.log_average));
    }
    return true;
}

static bool try_all(pilot *p, lux_error *err)
{
    p->count = 0;
    for (int i = 0; i < p->places; i += p->step) {
        arena scratch = { 0 };
        bool good = p->f->o->views ? try_view(p, &scratch, i, err) : try_grid(p, &scratch, i, err);
        arena_clear(&scratch);
        if (!good)
            return false;
    }
    return true;
}

/* Means over all that have any: of log half widths, and of the squares of what maps smooth. */
typedef struct pilot_look {
    double log_ratio, smooth2;
} pilot_look;

static pilot_look look_at(const pilot *p)
{
    pilot_look l = { 0 };
    double count = 0.0;
    for (int i = 0; i < p->count; i++) {
        const pilot_item *one = &p->items[i];
        l.smooth2 += one->smooth * one->smooth / p->count;
        if (one->ratio > 0.0)
            l.log_ratio += log(one->ratio), count += 1.0;
    }
    l.log_ratio = count > 0.0 ? l.log_ratio / count : 0.0;
    return l;
}

/* All samples, and of sensors first a quarter of them. */
static bool try_twice(pilot *p, pilot_look *first, lux_error *err)
{
    *first = (pilot_look){ 0 };
    if (!p->f->o->views) {
        p->o.only_samples = p->samples / LESS_AT_FIRST;
        if (!try_all(p, err))
            return false;
        *first = look_at(p);
    }
    p->o.only_samples = p->samples;
    return try_all(p, err);
}

/* Of a pixel there are too few samples to tell how half widths fall. */
static bool try_paths(pilot *p, lux_error *err)
{
    pilot_look first;
    if (!try_twice(p, &first, err))
        return false;
    double fell = (first.log_ratio - look_at(p).log_ratio) / log(LESS_AT_FIRST);
    double seen = p->f->o->views ? least_slope : fell;
    p->slope    = fmin(fmax(0.5 * (least_slope + seen), least_slope), most_slope);
    return true;
}

/* ---- what they tell -------------------------------------------------------------------------- */

static int compare(const void *a, const void *b)
{
    double x = ((const pilot_item *)a)->ratio, y = ((const pilot_item *)b)->ratio;
    return (x > y) - (x < y);
}

/* Rays of samples until as many items as are needed are that accurate, with a map of so many times
 * the particles (of paths any number); HUGE_VAL: they never are. */
static double rays_for(const pilot *p, double accuracy, double times)
{
    if (p->count > 0)
        qsort(p->items, (size_t)p->count, sizeof *p->items, compare);
    int last   = (int)(p->needed * p->count);
    last       = last < p->count ? last : p->count - 1;
    double sum = 0.0;
    for (int i = 0; i < p->count; i++) {
        const pilot_item *one = &p->items[i < last ? i : last];
        double common         = one->common / accuracy;
        double left           = 1.0 - common * common / times;
        if (left < least_left)
            return HUGE_VAL;
        double ratio  = one->ratio / (accuracy * sqrt(left));
        double wanted = p->samples * pow(ratio, 1.0 / p->slope);
        double taken  = p->least;
        while (taken < wanted && taken < (double)SCRAMBLES * MOST_SAMPLES)
            taken *= 2.0;
        sum += taken * p->items[i].rays;
    }
    return sum;
}

/* Whether a map of so many times the particles smooths no more than is left to it, at the worst
 * sensors: three times the root mean square, as samples are too few to tell them one by one. */
static bool is_fine(const pilot *p, double times, double accuracy)
{
    double worst = 3.0 * sqrt(look_at(p).smooth2);
    return p->smooths * worst <= sqrt(times) * 2.0 * left_to_maps * accuracy;
}

/* Particles of a map that is made once, and samples of it. That one grid alone may have a finer one
 * made is not waited for: it costs four times as much, and seldom helps. */
static void weigh_maps(const pilot *p, double accuracy, double share, plan_pilot *out)
{
    map_figures f    = illumination_map_figures(p->o.indirect);
    int64_t pilots   = 0;
    double particles = (double)illumination_map_calls_for(p->o.indirect, accuracy, &pilots);
    double each      = particle_ray * (double)f.rays / (double)f.particles;
    double times     = particles / PARTICLES;
    double samples   = rays_for(p, share * accuracy, times);
    out->too_coarse =
        samples == HUGE_VAL || particles >= MAP_MOST_PARTICLES || !is_fine(p, times, accuracy);
    out->maps = each * (particles + (double)pilots) + samples;
}

/* Samples that end in a map cost little, and few do not show what stays. */
static void take_more(pilot *p)
{
    while (!p->f->o->views && 2 * p->samples * p->count <= MAP_SAMPLES && p->samples < MOST_OF_ONE)
        p->samples *= 2;
}

/* What of the smoothing that is seen would stay however many samples there were: even samples have
 * an eighth of the variance at best where these are four times as many. */
static double smoothing_kept(const pilot_look *first, const pilot_look *now)
{
    const double falls = pow(LESS_AT_FIRST, 1.5);
    double before      = now->smooth2 > 0.0 ? first->smooth2 / now->smooth2 : 1.0;
    return sqrt(fmin(fmax((falls - before) / (falls - 1.0), 0.0), 1.0));
}

static bool try_maps(pilot *p, double accuracy, double share, plan_pilot *out, lux_error *err)
{
    arena a        = { 0 };
    map_options of = { .light     = MAP_INDIRECT,
                       .seed      = p->o.seed,
                       .threads   = p->o.threads,
                       .particles = PARTICLES,
                       .accuracy  = accuracy,
                       .deadline  = HUGE_VAL,
                       .progress  = p->o.progress };
    p->o.indirect  = illumination_map_new(&a, p->f->s, &of, err);
    p->o.transport = TRANSPORT_MAPS;
    pilot_look first;
    take_more(p);
    bool good = p->o.indirect && try_twice(p, &first, err);
    if (good) {
        pilot_look now = look_at(p);
        p->smooths     = smoothing_kept(&first, &now);
        weigh_maps(p, accuracy, share, out);
    }
    arena_clear(&a);
    return good;
}

/* ---- both ------------------------------------------------------------------------------------ */

static void share_out(pilot *p)
{
    const plan_facts *f = p->f;
    bool views          = f->o->views;
    p->places           = views ? f->s->study->view_count : f->s->study->grid_count;
    p->step             = (p->places + MOST_PLACES - 1) / MOST_PLACES;
    p->samples          = PIXEL_SAMPLES;
    p->slope            = least_slope;
    p->needed           = views ? VIEW_NEEDED_PERCENT / 100.0 : 1.0;
    p->least = views ? VIEW_LEAST : scene_is_rarely_met(f->s) ? GLOSSY_LEAST : GRID_LEAST;
    if (views || p->places == 0)
        return;
    int tried = (p->places + p->step - 1) / p->step, sensors = 0;
    int each = MOST_SENSORS / tried > FEWEST_SENSORS ? MOST_SENSORS / tried : FEWEST_SENSORS;
    for (int i = 0; i < p->places; i += p->step) {
        int n = f->grids[i].sensor_count;
        p->sensors += n;
        sensors += n < each ? n : each;
    }
    p->samples = FEWEST_SAMPLES;
    while (2 * p->samples * sensors <= ALL_SAMPLES && p->samples < MOST_OF_ONE)
        p->samples *= 2;
    p->o.most_sensors = each;
}

/* Whether a pilot of maps, whose particles go as far as paths, is not worth its rays; or the run
 * has no time for it. */
static bool is_soon(const pilot *p, double paths)
{
    double rays = 2.0 * PARTICLES * particle_ray * p->traced / fmax(p->drawn, 1.0);
    double most = p->f->o->seconds > 0.0 ? speed * p->f->o->seconds : HUGE_VAL;
    return fmin(paths, most) <= fmax(at_once, worth_a_map * rays);
}

bool plan_pilot_run(const plan_facts *f, double accuracy, plan_pilot *out, lux_error *err)
{
    arena a        = { 0 };
    progress quiet = { .stop = f->o->progress ? f->o->progress->stop : NULL };
    pilot p        = { .f = f,
                       .a = &a,
                       .o = { .accuracy  = accuracy,
                              .deadline  = HUGE_VAL,
                              .seed      = f->o->seed,
                              .threads   = f->o->threads > 0 ? f->o->threads : 1,
                              .transport = TRANSPORT_PATH,
                              .pilot     = true,
                              .progress  = &quiet } };
    share_out(&p);
    double of_parts = f->s->layered ? PARTS_SHARE : 1.0;
    double to_maps  = 1.0 - left_to_maps;
    bool good       = try_paths(&p, err);
    *out            = (plan_pilot){ .at_once = true };
    if (good) {
        out->paths = rays_for(&p, of_parts * accuracy * (scene_focuses(f->s) ? to_maps : 1.0), 1.0);
        out->at_once = is_soon(&p, out->paths);
    }
    if (good && !out->at_once)
        good = try_maps(&p, accuracy, of_parts * to_maps, out, err);
    arena_clear(&a);
    return good;
}
