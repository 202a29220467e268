/* lights/light_tree.c -- see light_tree.h: importances, and the ways down.
 *
 * The importance of a node for a point p with normal n, after section 5 of the paper:
 *
 *     peak max(cos e', floor) (cos i' + max(cos i, 0)) / 2 / (d^2 + r^2 / 8)
 *
 *          .--.          c, r  a ball around the lights; d from p to c
 *         ( c  ) r       u     the angle that the ball takes up from p: sin u = r / d
 *          '--'          i'    from n to the ball: i - u, at least 0
 *         /   \ axis     e'    what is left of the angle between the axis and p, as seen from c,
 *        / d   v               when u and the spread of the axes are taken off, at least 0
 *     n / i
 *     |/                 0 where cos i' <= 0, or e' is beyond the reach of light around its axis
 *     p
 *
 * The paper has max(d^2, r^2) and cos i' alone: in a hall of 1,000 equal lamps the relative
 * variance of the estimate is 4 to 10 times as large with them. Angles are their cosines and
 * sines throughout. Each bound is a little wide (SLACK), so that no light is lost at a horizon or a
 * rim to the rounding of floats.
 */
#include "lights/light_tree_parts.h"

/* Of cosines: some ulp of numbers near 1, as dot products of unit vectors have them */
static const float SLACK = 1e-6f;

/* Of r^2, below which a node does not come nearer: the best of 1/8 to 1 in halls and at random */
static const float BLUR = 0.125f;

/* Points, with what all nodes need of them */
typedef struct vreceiver {
    vvec3 p, n;
    vmask surface; /* n is a normal, not 0 0 0 */
} vreceiver;

static vreceiver receiver(const vvec3 *p, const vvec3 *n)
{
    return (vreceiver){ *p, *n, vdot(*n, *n) > 0.0f };
}

/* cos(max(a - b, 0)), a little above rather than below it, and 1 at most. */
static inline vfloat cos_less(vfloat cos_a, vfloat cos_b, vfloat sin_b)
{
    /* sin a too large by 1e-3 at most: where 1 - cos^2 has lost its bits, it must not be too small
     */
    vfloat sin_a = vsqrt(vmax(1.0f - cos_a * cos_a, vsplat(0.0f)) + 1e-6f);
    vfloat less  = vmin(cos_a * cos_b + sin_a * sin_b, vsplat(1.0f));
    return vselect(cos_a > cos_b, vsplat(1.0f), less);
}

static vfloat near_importance(const light_tree *t, const vreceiver *at, vint node)
{
    const float *table = &t->nodes->number[0];
    vint row           = node * NODE_NUMBERS;

    /* The ball, from p */
    vvec3 centre  = { vgather(table, row + NODE_X), vgather(table, row + NODE_Y),
                      vgather(table, row + NODE_Z) };
    vfloat r      = vgather(table, row + NODE_RADIUS);
    vvec3 to      = vsub(centre, at->p);
    vfloat d2     = vdot(to, to);
    vmask outside = d2 > r * r;
    vfloat part   = 1.0f / vsqrt(vmax(d2, r * r));
    vvec3 w       = vscale(to, part);
    vfloat sin_u  = r * part;
    vfloat cos_u  = vsqrt(vmax(1.0f - sin_u * sin_u, vsplat(0.0f)));

    /* What of it is above the horizon */
    vfloat cos_c = vdot(at->n, w);
    vfloat cos_i = cos_less(cos_c, cos_u, sin_u) + SLACK;
    cos_i        = vselect(outside & at->surface, cos_i, vsplat(1.0f));
    vfloat seen = vselect(outside & at->surface, 0.5f * (vmax(cos_c, vsplat(0.0f)) + cos_i), cos_i);

    /* Where it shines to */
    vvec3 axis       = { vgather(table, row + NODE_AXIS_X), vgather(table, row + NODE_AXIS_Y),
                         vgather(table, row + NODE_AXIS_Z) };
    vfloat cos_so    = vgather(table, row + NODE_COS_SPREAD);
    vfloat sin_so    = vgather(table, row + NODE_SIN_SPREAD);
    vfloat cos_reach = vgather(table, row + NODE_COS_REACH);
    vfloat cos_e     = cos_less(-vdot(axis, w), cos_u, sin_u);
    cos_e            = cos_less(cos_e, cos_so, sin_so) + SLACK;
    cos_e            = vselect(outside, cos_e, vsplat(1.0f));

    /* Uplight and wide beams are not weaker far from the axis */
    vfloat strength = vmax(cos_e, vgather(table, row + NODE_FLOOR));
    vfloat peak     = vgather(table, row + NODE_PEAK);
    vfloat square   = d2 + BLUR * r * r;
    return vkeep((cos_i > 0.0f) & (cos_e > cos_reach), peak * strength * seen / square);
}

static vfloat far_importance(const far_light *f, const vreceiver *at)
{
    vfloat cos_i = -vdot(at->n, vspread(f->axis));
    cos_i        = cos_less(cos_i, vsplat(f->cos_wide), vsplat(f->sin_wide)) + SLACK;
    cos_i        = vselect(at->surface, cos_i, vsplat(1.0f));
    return vkeep(cos_i > 0.0f, f->peak * cos_i);
}

/* ---- the far lights, and all near ones as one ------------------------------------------------ */

/* The importance of all near lights together, and with the far ones. */
static vfloat importance_near(const light_tree *t, const vreceiver *at, vfloat *all)
{
    vfloat near_ = vsplat(0.0f);
    if (t->node_count > 0)
        near_ = near_importance(t, at, vsplat_int(0));
    *all = near_;
    for (int i = 0; i < t->far_count; i++)
        *all += far_importance(&t->far[i], at);
    return near_;
}

/* u, once it is known to lie in [from, from + share), as a number in [0,1). */
static inline vfloat rescale(vfloat u, vfloat from, vfloat share)
{
    return vmin(vmax((u - from) / share, vsplat(0.0f)), vsplat(1.0f - 0x1p-24f));
}

/* Chooses among the far lights in out where u is theirs; the lanes that go down the tree. */
static vmask choose_far(const light_tree *t, const vreceiver *at, vfloat u, vmask active,
                        vlight_choice *out)
{
    vfloat all;
    vfloat near_ = importance_near(t, at, &all);
    vmask open   = active & (all > 0.0f);
    vfloat share = near_ / all;
    vmask down   = open & (u < share);
    vfloat from  = share;

    out->index       = vsplat_int(-1);
    out->probability = vkeep(down, share);
    out->rest        = vkeep(down, rescale(u, vsplat(0.0f), share));
    open &= ~down;
    for (int i = 0; i < t->far_count && vany(open); i++) {
        /* What rounding leaves over at the end of [0,1) goes to none */
        share      = far_importance(&t->far[i], at) / all;
        vmask here = open & (u < from + share) & (share > 0.0f);

        out->index       = vselect_int(here, vsplat_int(t->far[i].light), out->index);
        out->probability = vselect(here, share, out->probability);
        out->rest        = vselect(here, rescale(u, from, share), out->rest);
        from += share;
        open &= ~here;
    }
    return down;
}

/* ---- down the tree --------------------------------------------------------------------------- */

/* The shares of the two children of a node. The lanes where one has any. */
static vmask child_shares(const light_tree *t, const vreceiver *at, vmask lanes, vint first,
                          vint second, vfloat *first_share, vfloat *second_share)
{
    vfloat a      = near_importance(t, at, first);
    vfloat b      = near_importance(t, at, second);
    vfloat both   = a + b;
    *first_share  = a / both;
    *second_share = b / both;
    return lanes & (both > 0.0f);
}

vmask vlight_tree_choose(const light_tree *t, const vvec3 *p, const vvec3 *n, vfloat u,
                         vmask active, vlight_choice *out)
{
    vreceiver at = receiver(p, n);
    vmask down   = choose_far(t, &at, u, active, out);
    vint node    = vsplat_int(0);
    while (vany(down)) {
        /* Lanes at a leaf are there */
        vint link  = vgather_int(t->links, vkeep_int(down, node));
        vmask leaf = down & (link < 0);
        out->index = vselect_int(leaf, ~link, out->index);
        down &= ~leaf;
        if (!vany(down))
            break;

        /* The others go on to one of two, or find none */
        vint first = vkeep_int(down, node + 1), second = vkeep_int(down, link);
        vfloat first_share, second_share;
        down = child_shares(t, &at, down, first, second, &first_share, &second_share);

        vmask is_first = out->rest < first_share;
        vfloat share   = vselect(is_first, first_share, second_share);
        vfloat from    = vselect(is_first, vsplat(0.0f), first_share);

        node             = vselect_int(is_first, first, second);
        out->probability = vselect(down, out->probability * share, out->probability);
        out->rest        = vselect(down, rescale(out->rest, from, share), out->rest);
    }
    vmask chosen     = active & (out->index >= 0) & (out->probability > 0.0f);
    out->index       = vselect_int(chosen, out->index, vsplat_int(-1));
    out->probability = vkeep(chosen, out->probability);
    out->rest        = vkeep(chosen, out->rest);
    return chosen;
}

/* Nodes are in the order of a walk that goes to the first child first: a leaf is below the second
 * one if it does not come before it. */
vfloat vlight_tree_probability(const light_tree *t, const vvec3 *p, const vvec3 *n, vint index,
                               vmask active)
{
    if (t->light_count == 0)
        return vsplat(0.0f);
    vreceiver at = receiver(p, n);
    vint place   = vgather_int(t->places, vkeep_int(active, index));
    vfloat all;
    vfloat near_ = importance_near(t, &at, &all);
    vmask down   = active & (all > 0.0f) & (place >= 0);
    vfloat found = vkeep(down, near_ / all);

    for (int i = 0; i < t->far_count; i++) {
        vmask here = active & (all > 0.0f) & (place == FAR_PLACE - i);
        found      = vselect(here, far_importance(&t->far[i], &at) / all, found);
    }

    vint node = vsplat_int(0);
    for (;;) {
        down &= node != place;
        if (!vany(down))
            return found;
        vint second = vgather_int(t->links, vkeep_int(down, node));
        second      = vkeep_int(down, second);
        vint first  = vkeep_int(down, node + 1);
        vfloat first_share, second_share;
        vmask any = child_shares(t, &at, down, first, second, &first_share, &second_share);

        vmask is_first = place < second;
        vfloat share   = vkeep(any, vselect(is_first, first_share, second_share));
        found          = vselect(down, found * share, found);
        node           = vselect_int(down, vselect_int(is_first, first, second), node);
        down &= found > 0.0f;
    }
}
