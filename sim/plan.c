/* sim/plan.c -- see plan.h: what is on, what is off, and what the user has to say to that. */
#include "sim/plan_parts.h"

#include <stdio.h>
#include <string.h>

/* Of the accuracy asked for: what all that is off may come to. */
static const double bounds_share = 0.2;

typedef struct decision {
    const plan_facts *f;
    effects called;   /* what the scene calls for */
    uint32_t on, off; /* what the user says, bits 1 << effect */
    double left;      /* of what bounds may come to */
    bool direct;      /* light is not followed on from surfaces */
    plan *p;
} decision;

static bool has(uint32_t bits, effect e) { return bits >> e & 1; }

/* Where no light comes in from outside, none of it can be hidden. */
static effects called_for(const plan_facts *f, bool direct)
{
    const scene *s = f->s;
    effects all =
        f->o->views ? effects_of_views(s, direct) : effects_of_grids(s, direct, f->outside);
    bool hidden = s->glows;
    for (int l = 0; l < scene_lamp_count(s); l++)
        hidden |= !s->light_info[l].clear;
    all.on[EFFECT_SHADOWS] &= hidden || !f->sealed;
    return all;
}

/* What the user has no say in is open to be left out. */
static double open_bound(const decision *d, effect e)
{
    bool open = d->p->effects[e].on && !has(d->on | d->off, e);
    return open ? plan_bound(d->f, e, d->direct) : HUGE_VAL;
}

/* An effect is left out if its bound is below what is left of all. */
static bool leave_out(decision *d, effect e, double bound)
{
    plan_effect *to = &d->p->effects[e];
    if (!(bound < d->left))
        return false;
    d->left -= bound;
    d->p->bound += bound;
    to->on    = false;
    to->bound = bound;
    return true;
}

/* Light that comes back: without it, surfaces call for less. */
static void decide_interreflection(decision *d)
{
    plan_effect *to = &d->p->effects[EFFECT_INTERREFLECTION];
    to->on          = d->called.on[EFFECT_INTERREFLECTION];
    if (to->on && !has(d->off, EFFECT_INTERREFLECTION) &&
        !leave_out(d, EFFECT_INTERREFLECTION, open_bound(d, EFFECT_INTERREFLECTION)))
        return;
    bool was                             = d->called.on[EFFECT_INTERREFLECTION];
    d->direct                            = true;
    d->called                            = called_for(d->f, true);
    d->called.on[EFFECT_INTERREFLECTION] = was;
}

/* What is provably without effect, then what has the smallest bounds. */
static void decide_rest(decision *d)
{
    static const effect bounded[] = { EFFECT_NORMAL_MAPS, EFFECT_TEXTURES, EFFECT_NEAR_FIELD,
                                      EFFECT_AREA_LIGHTS };
    static const effect outer[]   = { EFFECT_SUN, EFFECT_SKY, EFFECT_PORTALS, EFFECT_PANORAMA };
    enum { BOUNDED = sizeof bounded / sizeof *bounded, OUTER = sizeof outer / sizeof *outer };
    plan_effect *all = d->p->effects;
    for (int e = 0; e < EFFECTS; e++)
        if (e != EFFECT_INTERREFLECTION)
            all[e].on = d->called.on[e];
    for (int i = 0; i < OUTER; i++)
        all[outer[i]].on &= !d->f->sealed;
    double bounds[BOUNDED];
    for (int i = 0; i < BOUNDED; i++)
        bounds[i] = open_bound(d, bounded[i]);
    for (int k = 0; k < BOUNDED; k++) {
        int least = 0;
        for (int i = 1; i < BOUNDED; i++)
            least = bounds[i] < bounds[least] ? i : least;
        leave_out(d, bounded[least], bounds[least]);
        bounds[least] = HUGE_VAL;
    }
}

/* Where these are off more rays are traced, and results are the same. */
static bool changes_results(effect e) { return e != EFFECT_PORTALS && e != EFFECT_MANY_LIGHTS; }

static void obey(decision *d, notices *n)
{
    char missing[200] = "";
    for (int i = 0; i < EFFECTS; i++) {
        effect e        = (effect)i;
        plan_effect *to = &d->p->effects[e];
        if (!has(d->on | d->off, e))
            continue;
        bool asked = has(d->off, e) && to->on;
        bool said  = e == EFFECT_INTERREFLECTION && d->f->o->direct_only;
        to->forced = true;
        to->missed = asked && changes_results(e) && !said;
        to->on     = has(d->on, e);
        if (!to->missed)
            continue;
        size_t length = strlen(missing);
        snprintf(missing + length, sizeof missing - length, "%s%s", length ? ", " : "",
                 effect_name(e));
    }
    if (missing[0])
        notice_add(n, "%s: left out as asked, though the study calls for it: %s: results change",
                   d->f->s->study->path, missing);
}

/* What the scene holds and is to be built without. */
static uint32_t built_without(const decision *d)
{
    uint32_t off = 0;
    for (int e = 0; e < EFFECTS; e++)
        if (d->called.on[e] && !d->p->effects[e].on)
            off |= 1u << e;
    return off;
}

static void decide(decision *d, notices *n)
{
    const plan_options *o = d->f->o;
    const uint32_t all    = (1u << EFFECTS) - 1;
    d->off                = o->no | (o->direct_only ? 1u << EFFECT_INTERREFLECTION : 0);
    d->off                = (o->has_only ? d->off | ~o->only : d->off) & all;
    d->on                 = o->has_only ? o->only & ~d->off & all : 0;
    d->left               = bounds_share * d->f->accuracy;
    d->called             = called_for(d->f, false);
    decide_interreflection(d);
    decide_rest(d);
    obey(d, n);
    d->p->off = built_without(d);
    for (int e = 0; e < EFFECTS; e++)
        if (d->p->effects[e].on && !d->called.on[e])
            d->p->on |= 1u << e;
    for (int e = 0; e < EFFECTS; e++)
        plan_tell(d->f, (effect)e, d->called.on[e], &d->p->effects[e]);
}

bool plan_make(const scene *s, const plan_options *o, plan *out, notices *n, lux_error *err)
{
    arena scratch = { 0 };
    plan_facts f;
    *out      = (plan){ 0 };
    bool good = plan_look(&scratch, s, o, &f, err);
    if (good) {
        decision d    = { .f = &f, .p = out };
        out->accuracy = f.accuracy;
        decide(&d, n);
        good             = plan_transport(&f, out, err);
        bool direct      = out->off >> EFFECT_INTERREFLECTION & 1;
        const char *weak = scene_left_to_chance(s, direct);
        if (weak)
            out->weak[out->weak_count++] = weak;
    }
    arena_clear(&scratch);
    return good;
}

void plan_apply(const plan *p, run_options *o)
{
    o->bound     = p->bound;
    o->transport = p->transport;
    o->direct_only |= p->off >> EFFECT_INTERREFLECTION & 1; /* else nothing gives light on */
}
