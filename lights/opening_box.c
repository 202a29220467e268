/* lights/opening_box.c -- an opening that is a box, or with no half.z a rectangle.
 *
 *     A(w) = sum over the axes i of area_i |w_i|,    area_x = 4 half_y half_z, ...
 *
 * From q >= 0 the face at +half_i is seen where q_i > half_i. It is drawn in proportion to
 * area_i q_i, then a place on it evenly in area.
 */
#include "lights/opening.h"

typedef struct vbox_view {
    vvec3 q;      /* m */
    vvec3 beyond; /* m, above the faces' planes */
    vvec3 area;   /* m^2, of the faces */
    vvec3 seen;   /* m^3, area_i q_i where the face is seen, else 0 */
    vfloat sum;   /* m^3, of these */
    vfloat by_area;
} vbox_view;

/* A point in a rectangle's very plane sees all of it edge on, as the limit from a side. */
static const float OFF_PLANE = 1e-12f; /* m */

static vbox_view look(const opening *o, const vvec3 *q)
{
    vbox_view v = { .q = *q };
    if (o->half.z == 0.0f)
        v.q.z = vmax(v.q.z, vsplat(OFF_PLANE));
    v.beyond = vsub(v.q, vspread(o->half));
    v.area   = vscale(
          vspread((vec3){ o->half.y * o->half.z, o->half.z * o->half.x, o->half.x * o->half.y }),
          vsplat(4.0f));
    v.seen    = (vvec3){ vkeep(v.beyond.x > 0.0f, v.area.x * v.q.x),
                         vkeep(v.beyond.y > 0.0f, v.area.y * v.q.y),
                         vkeep(v.beyond.z > 0.0f, v.area.z * v.q.z) };
    v.sum     = v.seen.x + v.seen.y + v.seen.z;
    v.by_area = vopening_by_area(v.beyond, v.q, v.sum);
    return v;
}

/* What of the box to[] leads to, on the face whose q_i / beyond_i is `ratio`. */
static vmask place(const vbox_view *v, vvec3 to, vfloat ratio, vmask seen, vopening_place *out)
{
    vfloat dist2   = vdot(to, to);
    vfloat across  = v->area.x * vabs(to.x) + v->area.y * vabs(to.y) + v->area.z * vabs(to.z);
    out->to        = to;
    out->projected = across / vsqrt(dist2);
    out->spread    = vopening_spread(v->by_area, out->projected, ratio, v->sum, dist2);
    return seen & (dist2 > 0.0f) & (out->spread > 0.0f);
}

/* The face that the ray from q along w meets, of those that are seen: how far q is before it in
 * each axis, less how far the ray has come when it reaches its plane. */
static vmask meet_face(const opening *o, const vbox_view *v, vvec3 w, vmask active,
                       vopening_place *out)
{
    vvec3 h  = vspread(o->half);
    vfloat x = v->beyond.x / -w.x, y = v->beyond.y / -w.y, z = v->beyond.z / -w.z;

    vvec3 on_x = valong(v->q, w, x), on_y = valong(v->q, w, y), on_z = valong(v->q, w, z);
    vmask met_x = (v->seen.x > 0.0f) & (x > 0.0f) & (vabs(on_x.y) <= h.y) & (vabs(on_x.z) <= h.z);
    vmask met_y = (v->seen.y > 0.0f) & (y > 0.0f) & (vabs(on_y.z) <= h.z) & (vabs(on_y.x) <= h.x);
    vmask met_z = (v->seen.z > 0.0f) & (z > 0.0f) & (vabs(on_z.x) <= h.x) & (vabs(on_z.y) <= h.y);

    vfloat dist  = vselect(met_z, z, vselect(met_y, y, x));
    vfloat near_ = vselect(met_z, v->beyond.z, vselect(met_y, v->beyond.y, v->beyond.x));
    vfloat q     = vselect(met_z, v->q.z, vselect(met_y, v->q.y, v->q.x));
    return place(v, vscale(w, dist), q / near_, active & (met_x | met_y | met_z), out);
}

/* A place on a seen face, evenly: the face by s, which is then made even again. */
static vvec3 draw_face(const opening *o, const vbox_view *v, vfloat s, vfloat t, vfloat *ratio)
{
    vfloat at     = s * v->sum;
    vmask is_x    = at < v->seen.x;
    vmask is_y    = ~is_x & (at < v->seen.x + v->seen.y);
    vmask is_z    = ~is_x & ~is_y;
    vfloat before = vkeep(~is_x, vselect(is_y, v->seen.x, v->seen.x + v->seen.y));
    vfloat width  = vselect(is_x, v->seen.x, vselect(is_y, v->seen.y, v->seen.z));
    vfloat even   = vmin((at - before) / width, vsplat(1.0f));

    vfloat a = 2.0f * even - 1.0f, b = 2.0f * t - 1.0f;
    vfloat x = vselect(is_x, vsplat(1.0f), a) * o->half.x;
    vfloat y = vselect(is_y, vsplat(1.0f), vselect(is_x, a, b)) * o->half.y;
    vfloat z = vselect(is_z, vsplat(1.0f), b) * o->half.z;
    *ratio   = vselect(is_x, v->q.x / v->beyond.x,
                       vselect(is_y, v->q.y / v->beyond.y, v->q.z / v->beyond.z));
    return vsub((vvec3){ x, y, z }, v->q);
}

/* Square to the plane of the face that q is farthest above: all of the box lies beyond it. */
static vvec3 inward(const vbox_view *v)
{
    vmask is_z = (v->beyond.z >= v->beyond.x) & (v->beyond.z >= v->beyond.y);
    vmask is_y = ~is_z & (v->beyond.y >= v->beyond.x);
    vfloat one = vsplat(-1.0f);
    return (vvec3){ vkeep(~is_z & ~is_y, one), vkeep(is_y, one), vkeep(is_z, one) };
}

static vmask box_draw(const opening *o, const vvec3 *q, vfloat s, vfloat t, vmask active,
                      vopening_place *out)
{
    vbox_view v  = look(o, q);
    vmask seen   = active & (v.sum > 0.0f);
    vmask area   = vopening_pick(v.by_area, &s);
    vfloat ratio = { 0 };
    vvec3 to     = draw_face(o, &v, s, t, &ratio);
    vmask lit    = place(&v, to, ratio, seen & area, out);
    if (!vany(seen & ~area))
        return lit;

    vopening_place other;
    vvec3 w        = vopening_hemisphere(inward(&v), s, t);
    vmask met      = meet_face(o, &v, w, seen & ~area, &other);
    out->to        = vselect3(area, out->to, other.to);
    out->spread    = vselect(area, out->spread, other.spread);
    out->projected = vselect(area, out->projected, other.projected);
    return lit | met;
}

static vmask box_meet(const opening *o, const vvec3 *q, const vvec3 *w, vmask active,
                      vopening_place *out)
{
    vbox_view v = look(o, q);
    return meet_face(o, &v, *w, active & (v.sum > 0.0f), out);
}

static vfloat box_projected(const opening *o, const vvec3 *w)
{
    vec3 h = o->half;
    return 4.0f * (h.y * h.z * vabs(w->x) + h.z * h.x * vabs(w->y) + h.x * h.y * vabs(w->z));
}

static vvec3 box_leave(const opening *o, const vvec3 *w, vfloat s, vfloat t)
{
    vec3 h       = o->half;
    vvec3 area   = { h.y * h.z * w->x, h.z * h.x * w->y, h.x * h.y * w->z };
    vfloat at    = s * (area.x + area.y + area.z);
    vmask is_x   = at < area.x;
    vmask is_y   = ~is_x & (at < area.x + area.y);
    vmask is_z   = ~is_x & ~is_y;
    vfloat past  = vkeep(~is_x, vselect(is_y, area.x, area.x + area.y));
    vfloat width = vselect(is_x, area.x, vselect(is_y, area.y, area.z));
    vfloat even  = vmin((at - past) / width, vsplat(1.0f));

    vfloat a = 2.0f * even - 1.0f, b = 2.0f * t - 1.0f, one = vsplat(1.0f);
    return (vvec3){ vselect(is_x, one, a) * h.x, vselect(is_y, one, vselect(is_x, a, b)) * h.y,
                    vselect(is_z, one, b) * h.z };
}

const opening_type opening_box = {
    .draw = box_draw, .meet = box_meet, .projected = box_projected, .leave = box_leave
};
