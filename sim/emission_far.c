/* sim/emission_far.c -- particles of what is far away: suns, parallel light, skies; open and
 * through portals as emission_parts.h says.
 */
#include "core/color.h"
#include "core/packet_math.h"
#include "sim/emission_parts.h"

/* ---- lines ---------------------------------------------------------------------------------- */

/* m^2, of portal i as seen along wi from outside; 0 from inside. */
static vfloat portal_seen(const emission *e, int i, const vvec3 *wi)
{
    const portal *p = &e->portals[i];
    float area      = 4.0f * v3_length(p->u) * v3_length(p->v);
    return area * vmax(vdot(*wi, vspread(p->outward)), vsplat(0.0f));
}

vfloat emission_portals_seen(const emission *e, const vvec3 *wi)
{
    vfloat sum = vsplat(0.0f);
    for (int i = 0; i < e->portal_count; i++)
        sum = sum + portal_seen(e, i, wi);
    return sum;
}

/* An even place on one of the portals, that is drawn as it is seen; `sum` of them all. */
static vvec3 place_on_portal(const emission *e, const vvec3 *wi, vfloat sum, vfloat pick,
                             const vfloat st[2])
{
    vfloat at = pick * sum, before = vsplat(0.0f);
    vvec3 place = vspread(e->around.centre);
    for (int i = 0; i < e->portal_count; i++) {
        const portal *p = &e->portals[i];
        vfloat seen     = portal_seen(e, i, wi);
        vmask taken     = (seen > 0.0f) & (before <= at);
        place           = vselect3(taken, portal_place(p, st[0], st[1]), place);
        before          = before + seen;
    }
    return place;
}

/* N: how many portals a line from wi through p goes in by. */
static vfloat portals_on_line(const emission *e, const vvec3 *p, const vvec3 *wi)
{
    vfloat count = vsplat(0.0f);
    for (int i = 0; i < e->portal_count; i++) {
        const portal *q = &e->portals[i];
        vvec3 out       = vspread(q->outward);
        vfloat cos_out  = vdot(*wi, out);
        vvec3 to        = vsub(*p, vspread(q->centre));
        vvec3 at        = vsub(to, vscale(*wi, vdot(to, out) / cos_out));
        vmask in        = (cos_out > 0.0f) & portal_covers(q, &at);
        count           = count + vkeep(in, vsplat(1.0f));
    }
    return count;
}

/* A line along which light comes from wi, and with what density each way draws it, 1/m^2. */
typedef struct vline {
    vvec3 origin; /* m, before the sphere */
    vfloat open, through;
    vmask in; /* it goes in by a portal */
} vline;

static vline draw_line(const emission *e, const vvec3 *wi, const vfloat st[2], vfloat pick,
                       vmask through)
{
    vvec3 u, v, centre = vspread(e->around.centre);
    vfloat x, y;
    vframe(*wi, &u, &v);
    vsquare_to_disk(st[0], st[1], &x, &y);
    vvec3 place = valong(centre, vadd(vscale(u, x), vscale(v, y)), vsplat(e->around.radius));

    vline l = { .open = vsplat(1.0f / e->area) };
    if (e->portal_count > 0) {
        vfloat sum = emission_portals_seen(e, wi);
        place      = vselect3(through, place_on_portal(e, wi, sum, pick, st), place);
        vfloat n   = portals_on_line(e, &place, wi);
        n          = vselect(through, vmax(n, vsplat(1.0f)), n); /* rounded past its edge */
        l.through  = vkeep(sum > 0.0f, n / sum);
        l.in       = l.through > 0.0f;
    }
    vfloat ahead = vdot(vsub(place, centre), *wi);
    l.origin     = valong(place, *wi, e->around.radius - ahead);
    return l;
}

/* The lanes that draw by portals, and *pick made even again. */
static vmask choose_way(float through, vfloat *pick)
{
    vmask by_portal = *pick < through;
    vfloat inside   = *pick / through;
    vfloat open     = (*pick - through) / (1.0f - through);
    *pick           = vmin(vselect(by_portal, inside, open), vsplat(0x1.fffffep-1f));
    return by_portal;
}

/* k / (k + 1) of those that go in by none, as all have the flux of 1 / (k + N). */
static vfloat evenness(const emission *e, const vline *line)
{
    float k = (float)e->rare;
    if (e->portal_count == 0)
        return vsplat(1.0f);
    return vselect(line->in, vsplat(1.0f), vsplat(k / (k + 1.0f)));
}

static void set_ray(vparticle *out, const vvec3 *origin, const vvec3 *wi, vmask lit)
{
    out->ray.origin    = vkeep3(lit, *origin);
    out->ray.direction = vkeep3(lit, vneg(*wi));
    out->ray.reach     = vkeep(lit, vsplat(INFINITY));
}

/* ---- lights --------------------------------------------------------------------------------- */

far_flux emission_far_flux(const emission *e, const light *l)
{
    vvec3 p = vspread(e->around.centre);
    vlight_sample of;
    light_sample(l, &p, vsplat(0.5f), vsplat(0.5f), ALL_LANES, &of);
    double square = (double)lane(vrgb_luminance(of.e), 0);
    vfloat seen   = emission_portals_seen(e, &of.wi);
    return (far_flux){ square * (double)e->area, square * (double)lane(seen, 0) };
}

vmask emission_draw_light(const emission *e, int which, const emission_numbers *n, vmask active,
                          vparticle *out)
{
    vvec3 centre  = vspread(e->around.centre);
    float through = e->through[which];
    vfloat pick   = n->way;
    vmask way     = choose_way(through, &pick);
    vlight_sample of;
    vmask lit = light_sample(e->s->lights[which], &centre, n->u.z, n->u.w, active, &of);

    const vfloat st[2] = { n->u.x, n->u.y };
    vline line         = draw_line(e, &of.wi, st, n->portal, way);
    vfloat density     = (1.0f - through) * line.open + through * line.through;
    lit &= (density > 0.0f) & (~way | (line.through > 0.0f));

    set_ray(out, &line.origin, &of.wi, lit);
    out->flux = vkeep3(lit, vscale(of.e, 1.0f / density));
    out->even = vkeep(lit, evenness(e, &line));
    return lit;
}

/* ---- skies ---------------------------------------------------------------------------------- */

/* What comes from wi of all skies of a group: the radiance of one that is drawn by its luminance,
 * divided by its chance. */
static vrgb draw_radiance(const emission *e, const sky_source *from, const vvec3 *wi, vfloat pick,
                          vmask active, vparticle *out)
{
    vmask below  = active & (wi->z < 0.0f);
    vfloat total = vsplat(0.0f), of_drawn = vsplat(1.0f);
    vrgb drawn = { 0 };
    for (int k = 0; k < from->count; k++) {
        int number         = from->skies[k];
        const scene_sky *s = &e->s->skies[number];
        vmask here         = s->ground ? below : s->sky->below ? active : active & ~below;
        vrgb radiance      = sky_radiance(s->sky, wi, here);
        vfloat bright      = vkeep(here, vrgb_luminance(radiance));

        /* It is drawn with its share of all so far; what is left of pick goes on */
        vmask some  = bright > 0.0f;
        vfloat all  = total + bright;
        vfloat at   = pick * all;
        vmask taken = some & (at < bright);
        vfloat left = vselect(taken, at / bright, (at - bright) / total);
        pick        = vselect(some, vmin(left, vsplat(0x1.fffffep-1f)), pick);
        drawn       = vselect3(taken, radiance, drawn);
        of_drawn    = vselect(taken, bright, of_drawn);
        out->source = vselect_int(taken, vsplat_int(-1 - number), out->source);
        out->group  = vselect_int(taken, vsplat_int(s->group), out->group);
        total       = all;
    }
    return vscale(drawn, total / of_drawn);
}

vmask emission_draw_sky(const emission *e, int which, const emission_numbers *n, vmask active,
                        vparticle *out)
{
    const sky_source *from = &e->skies[which - e->light_count];
    float through          = e->through[which];
    vfloat pick            = n->way;
    vmask way              = choose_way(through, &pick);

    /* A direction either way, with the densities of both */
    vfloat by_open, by_portals = { 0 };
    vvec3 wi = dome_sample(from->open, n->u.z, n->u.w, active, &by_open);
    if (through > 0.0f) {
        vfloat ignored;
        vvec3 other = dome_sample(from->through, n->u.z, n->u.w, active, &ignored);
        wi          = vselect3(way, other, wi);
        by_open     = dome_pdf(from->open, &wi, active);
        by_portals  = dome_pdf(from->through, &wi, active);
    }

    const vfloat st[2] = { n->u.x, n->u.y };
    vline line         = draw_line(e, &wi, st, n->portal, way);
    vfloat density = (1.0f - through) * by_open * line.open + through * by_portals * line.through;
    vmask lit      = active & (density > 0.0f) & (~way | (line.through > 0.0f));
    vrgb radiance  = draw_radiance(e, from, &wi, pick, lit, out);
    lit &= vrgb_luminance(radiance) > 0.0f;

    set_ray(out, &line.origin, &wi, lit);
    out->flux = vkeep3(lit, vscale(radiance, 1.0f / density));
    out->even = vkeep(lit, evenness(e, &line));
    return lit;
}
