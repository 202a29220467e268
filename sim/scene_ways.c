/* sim/scene_ways.c -- how much light of lamps and suns goes by ways that paths do not find.
 *
 * Straight light and mirror images are asked for. What round mirrors and solids of glass send on no
 * path finds that begins at a matt surface, but by meeting the lamp itself; what narrow lobes do,
 * seldom. So it is measured beforehand, by particles that set out from lamps and suns:
 *
 *                \ sun       Where one ends, on a surface that is no mirror, its light counts if
 *        round |  \          a ray from there, as the surface reflects, meets another surface: then
 *     - - - -  |- -\-        it is light that goes on within the scene, as in rooms, and not from a
 *              |  / \        roof to the sky.
 *     ---------+-/---*---
 *              focus
 *
 * Focused light counts in any case: sensors may stand in it.
 */
#include "core/color.h"
#include "sim/emission.h"
#include "sim/scene_build.h"
#include "sim/shading.h"

enum { PARTICLES = 1 << 14, MOST_MEETINGS = 16, WAY_SEED = 0x3a75 };

static const float narrow_pdf = 100.0f;  /* 1/sr: a lobe of about 6 degrees */
static const double met_often = 8.0;     /* times, in the first samples of a sensor: then a lamp
                                            is not overlooked */
static const double share_of_lobe = 0.1; /* about what a narrow lobe gives back */

/* What became of one particle: its light where it ended, W; by which way. */
typedef struct fate {
    float light;
    bool sun, focused, narrow; /* focused onto what is not matt is found as narrow lobes are */
    int32_t made_of;           /* what first sent it on so; -1 */
} fate;

/* A packet of particles on its way. */
typedef struct travellers {
    vray ray;
    vrgb flux;
    vint image, made_of;
    vmask going, focused, narrow;
} travellers;

/* What the scattering that was drawn makes of a way. */
static void note_way(const scene *s, travellers *p, const vscatter *drawn, const vhit *hit,
                     vint made_of, vint does, vmask on)
{
    vmask single = on & (drawn->pdf == INFINITY) & ~drawn->straight;
    vmask lens   = single & drawn->bent & ((does & DOES_LENS) != 0);
    vmask mirror = single & ~drawn->bent;
    vint image   = p->image;
    if (s->mirror_images)
        image = vselect_int(mirror, mirrors_precede(s->mirror_images, image, hit, mirror), image);
    else
        image = vselect_int(mirror, vsplat_int(-1), image);
    image         = vselect_int(lens, vsplat_int(-1), image);
    vmask focused = (single & (image < 0)) & ~(drawn->bent & ~lens);
    vmask narrow  = on & (drawn->pdf < INFINITY);
    p->made_of    = vselect_int((focused | narrow) & (p->made_of < 0), made_of, p->made_of);
    p->image      = image;
    p->focused    = p->focused | focused;
    p->narrow     = p->narrow | narrow;
}

/* Where light comes to a surface that scatters it widely it ends; it counts if it goes on from
 * there to another surface. */
static vmask ends_here(const scene *s, const vsurface *at, const vscatter *drawn, vmask wide)
{
    vmask blocked = { 0 };
    vray on       = { vray_start(at, &drawn->wi), drawn->wi, vsplat(INFINITY) };
    world_any_hit(s->world, &on, &wide, NULL, 1, RAYS_INCOHERENT, &blocked);
    return blocked;
}

static void step(const scene *s, travellers *p, vuint index, uint32_t depth, fate *to)
{
    vhit hit;
    world_first_hit(s->world, &p->ray, &p->going, 1, RAYS_INCOHERENT, &hit);
    vmask met = p->going & (hit.instance >= 0);
    vsurface at;
    vshading shading;
    scene_shade(s, &hit, &p->ray.direction, vsplat(0.0f), met, &at, &shading);
    vint does  = vgather_int(s->material_does, vkeep_int(met, at.material));
    vsample4 u = vsobol4(index, vsplat_uint(hash_combine_u32(WAY_SEED, depth)));
    vscatter drawn;
    vmask goes = materials_scatter(s->materials, at.material, &shading, u.x, u.y, u.z, met, &drawn);
    vmask wide = goes & (drawn.pdf < narrow_pdf);
    vmask others = wide & ~p->focused;
    vmask counts = p->focused & met & (wide | ~goes);
    if (vany(others))
        counts = counts | ends_here(s, &at, &drawn, others);
    vmask mapped = (does & (DOES_NARROW | DOES_AROUND | DOES_HOLLOW)) == 0;
    for (int bits = vbits(counts); bits; bits &= bits - 1) {
        int i         = __builtin_ctz((unsigned)bits);
        to[i].light   = lane(vrgb_luminance(p->flux), i);
        bool focused  = vbits(p->focused) >> i & 1;
        to[i].focused = focused && (vbits(mapped) >> i & 1);
        to[i].narrow  = (vbits(p->narrow) >> i & 1) || (focused && !to[i].focused);
        to[i].made_of = lane(p->made_of, i);
    }
    vmask on = goes & ~wide;
    note_way(s, p, &drawn, &hit, at.material, does, on);
    p->flux  = vselect3(on, vmul(p->flux, drawn.weight), p->flux);
    p->ray   = (vray){ vray_start(&at, &drawn.wi), drawn.wi, vsplat(INFINITY) };
    p->going = on & (vrgb_luminance(p->flux) > 0.0f);
}

static void follow(const scene *s, const emission *source, uint32_t first, fate *to)
{
    vparticle of;
    vuint index  = vunsigned(vlane_index()) + first;
    vmask drawn  = emission_draw(source, index, vsplat_uint(WAY_SEED), ALL_LANES, &of);
    travellers p = { .ray     = of.ray,
                     .flux    = of.flux,
                     .made_of = vsplat_int(-1),
                     .going   = drawn & (of.source >= 0) & (of.source < s->light_count) };
    for (int i = 0; i < LANES; i++) {
        int l   = lane(of.source, i);
        bool is = vbits(p.going) >> i & 1;
        to[i]   = (fate){ .made_of = -1, .sun = is && s->light_info[l].sun };
        if (is && s->light_info[l].owner) /* its body would stop it */
            p.going = p.going & (vlane_index() != i);
    }
    for (uint32_t depth = 0; depth < MOST_MEETINGS && vany(p.going); depth++)
        step(s, &p, index, depth, to);
}

/* ---- what is told ---------------------------------------------------------------------------- */

typedef struct tally {
    double all, focused, narrow;
    int32_t focused_by, narrow_by;
} tally;

static void add_fate(tally *t, const fate *f)
{
    t->all += (double)f->light;
    if (f->focused) {
        t->focused += (double)f->light;
        t->focused_by = t->focused_by < 0 ? f->made_of : t->focused_by;
    } else if (f->narrow) {
        t->narrow += (double)f->light;
        t->narrow_by = t->narrow_by < 0 ? f->made_of : t->narrow_by;
    }
}

static scene_ways ways_of(const tally *t)
{
    if (!(t->all > 0.0))
        return (scene_ways){ 0 };
    return (scene_ways){ .focused = t->focused / t->all, .narrow = t->narrow / t->all };
}

static void tell(const scene *s, notices *n, const char *whose, double share, const char *how,
                 int made_of, const char *found)
{
    if (share > SHARE_THAT_MATTERS)
        notice_add(n, "%s: about %.2g %% of the light of %s comes %s (first \"%s\"): %s",
                   s->study->path, 100.0 * share, whose, how,
                   made_of >= 0 ? s->material_info[made_of].name : "", found);
}

/* m^2, the face of a box, about. */
static double face_of(const light *l)
{
    light_bounds b = light_bounds_of(l);
    dvec3 d        = d3_sub(d3_from(b.high), d3_from(b.low));
    return fmax(d.x * d.y, fmax(d.y * d.z, d.z * d.x));
}

/* m^2 that a light needs, so that samples of a sensor find it by a narrow lobe often enough: as
 * seen from a quarter of the scene's diagonal, against all directions by their cosine. */
static double face_needed(const scene *s)
{
    double d = fmin(0.25 * d3_length(d3_sub(s->high, s->low)), 3.0);
    return met_often * M_PI * d * d / (MIRROR_SAMPLES * share_of_lobe);
}

static bool some_lamps_hide(const scene *s)
{
    double needed = face_needed(s), glowing = 0.0;
    for (int l = 0; l < s->light_count; l++) {
        light_bounds b = light_bounds_of(s->lights[l]);
        bool found = light_has_extent(s->lights[l]) && !b.far && face_of(s->lights[l]) >= needed;
        if (!found && b.peak > 0.0f && !s->light_info[l].sun)
            return true;
    }
    for (int e = 0; e < s->emitter_count; e++) /* triangles: half of their boxes */
        glowing += 0.5 * face_of(s->lights[s->light_count + e]);
    return s->emitter_count > 0 && glowing < needed;
}

static void tell_ways(scene *s, const tally *lamps, const tally *suns, notices *n)
{
    static const char round[]  = "by way of round mirrors or solids of glass";
    static const char narrow[] = "by way of narrow lobes";
    static const char map[]    = "it is found by particles";
    static const char lost[]   = "it is found rarely, intervals are not valid";
    if (s->lamps_hide)
        tell(s, n, "lamps", s->by_lamps.focused, round, lamps->focused_by, map);
    tell(s, n, "suns", s->by_suns.focused, round, suns->focused_by, map);
    if (s->lamps_hide)
        tell(s, n, "lamps", s->by_lamps.narrow, narrow, lamps->narrow_by, lost);
    tell(s, n, "suns", s->by_suns.narrow, narrow, suns->narrow_by, lost);
}

bool scene_find_ways(scene *s, notices *n, lux_error *err)
{
    bool bends = s->narrow || s->hollow;
    if (!bends || !(s->low.x <= s->high.x) || s->light_count == 0)
        return true;
    arena a                = { 0 };
    const emission *source = emission_new(&a, s, err);
    fate *fates            = source ? arena_array(&a, fate, PARTICLES, err) : NULL;
    if (fates) {
        tally lamps = { .focused_by = -1, .narrow_by = -1 }, suns = lamps;
        for (uint32_t i = 0; i < PARTICLES; i += LANES)
            follow(s, source, i, fates + i);
        for (int i = 0; i < PARTICLES; i++)
            add_fate(fates[i].sun ? &suns : &lamps, &fates[i]);
        s->by_lamps   = ways_of(&lamps);
        s->by_suns    = ways_of(&suns);
        s->lamps_hide = some_lamps_hide(s);
        tell_ways(s, &lamps, &suns, n);
    }
    arena_clear(&a);
    return fates != NULL;
}

bool scene_focuses(const scene *s)
{
    bool lamps = scene_lamp_count(s) > 0 && (s->by_lamps.focused > 0.0 || s->lenses);
    bool suns  = s->sun_count > 0 && (s->by_suns.focused > 0.0 || s->lenses);
    return (lamps && s->lamps_hide) || suns;
}

bool scene_is_rarely_met(const scene *s)
{
    return s->by_lamps.narrow + (s->lamps_hide ? 0.0 : s->by_lamps.focused) > SHARE_THAT_MATTERS;
}
