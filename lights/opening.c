/* lights/opening.c -- which shape the figures of a photometric file describe. */
#include "lights/opening.h"

#include <math.h>

/* Smaller is not measured, and too small for areas to be divided by. */
static const float NONE = 1e-5f; /* m */

static float half_of(float size) { return size > NONE ? 0.5f * size : 0.0f; }

/* The axes in the order that the type wants: those without extent last; a cylinder's own axis last
 * where all three have some. */
static void order_axes(opening *o, const float half[3], int last)
{
    int n = 0;
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < 3; i++)
            if (i != last && (half[i] > 0.0f) == (pass == 0))
                o->axis[n++] = i;
    if (last >= 0)
        o->axis[n] = last;
    if (last >= 0 && half[last] > 0.0f && half[o->axis[1]] == 0.0f) { /* it is flat along another */
        o->axis[2] = o->axis[1];
        o->axis[1] = last;
    }
    if (half[o->axis[0]] == 0.0f) {
        int first  = o->axis[0];
        o->axis[0] = o->axis[1];
        o->axis[1] = first;
    }
    o->half = (vec3){ half[o->axis[0]], half[o->axis[1]], half[o->axis[2]] };
}

/* Round shapes keep their kind only where they have the extents that make them round. */
static const opening_type *type_of(const photometry *p, const float half[3], int extents, int last)
{
    bool ellipsoid = p->opening == OPENING_SPHERE;
    bool round     = last >= 0;
    if (p->opening == OPENING_POINT || extents == 0)
        return NULL;
    if (extents == 1)
        return &opening_line;
    if (extents == 2)
        return ellipsoid || (round && half[last] == 0.0f) ? &opening_cylinder : &opening_box;
    return ellipsoid ? &opening_ellipsoid : round ? &opening_cylinder : &opening_box;
}

/* Means over a segment are h/2 and h^2/3; along an axis of a rectangle h^2/3, of an ellipse h^2/4.
 * The mean distance is at most the root of the mean square. */
static void find_means(opening *o)
{
    float share    = o->type == &opening_cylinder ? 0.25f : 1.0f / 3.0f;
    float x        = share * o->half.x * o->half.x;
    float y        = share * o->half.y * o->half.y;
    o->mean2       = x + y;
    o->mean2_along = fmaxf(x, y);
    o->mean1       = o->type == &opening_line ? 0.5f * o->half.x : sqrtf(o->mean2);
}

/* The area seen is a norm of the direction: least along an axis; most of a box along the vector of
 * its faces, of an ellipsoid along an axis, of a cylinder at most as of the box of both its areas.
 */
static void find_areas(opening *o)
{
    const float pi = 3.14159265f;
    float yz = o->half.y * o->half.z, zx = o->half.z * o->half.x, xy = o->half.x * o->half.y;
    if (o->type == &opening_box) {
        o->area       = 4.0f * sqrtf(yz * yz + zx * zx + xy * xy);
        o->least_area = 4.0f * fminf(yz, fminf(zx, xy));
    }
    if (o->type == &opening_ellipsoid) {
        o->area       = pi * fmaxf(yz, fmaxf(zx, xy));
        o->least_area = pi * fminf(yz, fminf(zx, xy));
    }
    if (o->type == &opening_cylinder) {
        o->area       = hypotf(pi * xy, 4.0f * fmaxf(yz, zx));
        o->least_area = fminf(pi * xy, 4.0f * fminf(yz, zx));
    }
}

opening opening_of(const photometry *p)
{
    const float half[3] = { half_of(p->length), half_of(p->width), half_of(p->height) };
    opening o           = { .axis = { 0, 1, 2 } };
    int extents         = (half[0] > 0.0f) + (half[1] > 0.0f) + (half[2] > 0.0f);
    int last            = -1; /* the axis of a cylinder, or across a disc */
    if (p->opening == OPENING_DISC || p->opening == OPENING_VERTICAL_CYLINDER)
        last = 2;
    if (p->opening == OPENING_CYLINDER_ALONG)
        last = 0;
    if (p->opening == OPENING_CYLINDER_ACROSS || p->opening == OPENING_VERTICAL_DISC)
        last = 1;

    o.type = type_of(p, half, extents, last);
    if (!o.type)
        return o;
    order_axes(&o, half, last);
    o.radius = sqrtf(v3_dot(o.half, o.half));
    find_areas(&o);
    o.flat = o.half.z == 0.0f;
    if (o.flat)
        find_means(&o);
    return o;
}
