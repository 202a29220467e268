/* sim/cost_rows.c -- the settings by which lux4 cost runs a study. */
#include "sim/cost_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Whether interreflection by illumination maps is wired into grids and views. */
static const bool maps_are_there = true;

const char *cost_ladder_name(cost_ladder l)
{
    static const char *const names[COST_LADDERS] = {
        [COST_ACCURACY] = "accuracy",   [COST_BOUNCES] = "bounces",
        [COST_TRANSPORT] = "transport", [COST_EFFECTS] = "effects",
        [COST_RECKONING] = "reckoning", [COST_RAYS] = "rays",
    };
    return names[l];
}

typedef struct list_maker {
    const scene *s;
    const plan *p;
    const cost_subject *of;
    const cost_options *o;
    cost_list *to;
} list_maker;

/* As planned. */
static cost_setting *add(list_maker *m, cost_ladder ladder, const char *text)
{
    cost_list *to = m->to;
    if (to->count == COST_MOST_SETTINGS)
        return &to->all[to->count - 1];
    cost_setting *made = &to->all[to->count++];
    *made       = (cost_setting){ .ladder = ladder, .run = m->o->run, .accuracy = (double)NAN };
    made->scene = (scene_options){ .threads = m->o->run.threads, .off = plan_without(m->p) };
    plan_apply(m->p, &made->run);
    snprintf(made->text, sizeof made->text, "%s", text);
    return made;
}

static void add_rung(list_maker *m, double percent)
{
    char text[64];
    snprintf(text, sizeof text, "--accuracy %g%%", percent);
    add(m, COST_ACCURACY, text)->accuracy = percent / 100.0;
    m->to->rungs++;
}

/* From coarse to fine, and among them what the study asks for. */
static void add_accuracies(list_maker *m)
{
    static const double percents[] = { 20.0, 10.0, 5.0, 2.0, 1.0, 0.5 };
    double asked = 100.0 * m->of->asked, before = HUGE_VAL;
    int count = (int)(sizeof percents / sizeof *percents);
    for (int i = 0; i <= count; i++) {
        double next = i < count ? percents[i] : 0.0;
        if (asked < before * (1.0 - 1e-9) && asked > next * (1.0 + 1e-9))
            add_rung(m, asked);
        if (i < count)
            add_rung(m, next);
        before = next;
    }
}

static void add_bounces(list_maker *m)
{
    static const int bounces[] = { 0, 1, 2, 4, 8 };
    if (m->o->run.direct_only || !m->s->reflects)
        return;
    for (size_t i = 0; i < sizeof bounces / sizeof *bounces; i++) {
        char text[64];
        snprintf(text, sizeof text, "bounces %d", bounces[i]);
        cost_setting *made    = add(m, COST_BOUNCES, text);
        made->run.transport   = TRANSPORT_PATH;
        made->run.bounded     = true;
        made->run.bounces     = bounces[i];
        made->run.direct_only = bounces[i] == 0; /* paths ask for lights at the first surface */
    }
    cost_setting *made  = add(m, COST_BOUNCES, "bounces unlimited");
    made->usual         = m->p->transport != TRANSPORT_MAPS;
    made->run.transport = TRANSPORT_PATH;
}

static void add_transports(list_maker *m)
{
    bool maps = m->p->transport == TRANSPORT_MAPS;
    if (!maps_are_there || m->o->run.direct_only || !m->s->reflects)
        return;
    cost_setting *path   = add(m, COST_TRANSPORT, "--transport path");
    path->usual          = !maps;
    path->run.transport  = TRANSPORT_PATH;
    cost_setting *other  = add(m, COST_TRANSPORT, "--transport maps");
    other->usual         = maps;
    other->run.transport = TRANSPORT_MAPS;
}

/* Effects that are on are left out, those that are off for their little worth are put in; one that
 * nothing calls for costs nothing, as the last row shows. */
static void add_effects(list_maker *m)
{
    bool some_off = false;
    for (int e = 0; e < EFFECTS; e++) {
        const plan_effect *is = &m->p->effects[e];
        char text[64];
        bool series = e == EFFECT_MOTION, rays = e == EFFECT_ANTIALIASING;
        some_off |= !is->on;
        if (series || rays || (!is->on && !(is->bound > 0.0)))
            continue;
        snprintf(text, sizeof text, is->on ? "--no %s" : "with %s", effect_name((effect)e));
        cost_setting *made = add(m, COST_EFFECTS, text);
        if (e != EFFECT_INTERREFLECTION) /* runs do without by themselves */
            made->scene.off ^= 1u << e;
        made->run.bound -= is->on ? 0.0 : fmin(is->bound, made->run.bound);
        if (e == EFFECT_INTERREFLECTION)
            made->run.direct_only = is->on;
    }
    if (!some_off)
        return;
    cost_setting *made    = add(m, COST_EFFECTS, "--only all");
    made->scene.off       = 0;
    made->run.bound       = 0.0;
    made->run.direct_only = m->o->run.direct_only;
}

/* What the scene has that can be reckoned in other ways. */
static bool has_tables(const scene *s)
{
    bool any = false;
    for (int l = 0; l < s->light_count; l++)
        any |= s->light_info[l].web != NULL;
    for (int i = 0; i < s->material_count; i++)
        any |= s->material_info[i].used && s->material_info[i].file;
    return any;
}

static bool has_disk(const scene *s)
{
    bool any = false;
    for (int l = scene_lamp_count(s); l < s->light_count; l++)
        any |= light_has_extent(s->lights[l]);
    return any;
}

static void add_reckonings(list_maker *m)
{
    if (m->s->extended)
        add(m, COST_RECKONING, "luminaires as points")->scene.off |=
            1u << EFFECT_AREA_LIGHTS | 1u << EFFECT_NEAR_FIELD;
    if (has_disk(m->s))
        add(m, COST_RECKONING, "sun as a point")->scene.measures.point_sun = true;
    add(m, COST_RECKONING, "projection test")->scene.measures.projection_test = true;
    if (!has_tables(m->s))
        return;
    add(m, COST_RECKONING, "angles by libm")->scene.measures.libm_tables     = true;
    add(m, COST_RECKONING, "tables: nearest")->scene.measures.nearest_tables = true;
}

static void add_rays(list_maker *m)
{
    static const int rays[] = { 1, 4, 9, 25 };
    if (m->of->grid)
        return;
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        char text[64];
        snprintf(text, sizeof text, "%d ray%s a pixel", rays[i], rays[i] > 1 ? "s" : "");
        add(m, COST_RAYS, text)->run.only_samples = rays[i];
    }
}

void cost_list_make(const scene *s, const plan *p, const cost_subject *of, const cost_options *o,
                    cost_list *out)
{
    list_maker m = { s, p, of, o, out };
    out->count = out->rungs = 0;
    out->usual_off          = plan_without(p);
    add_accuracies(&m);
    add_bounces(&m);
    add_transports(&m);
    add_effects(&m);
    add_reckonings(&m);
    add_rays(&m);
}
