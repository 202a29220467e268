/* lights/photometry_opening.c -- the luminous opening of a LM-63 file, told by the signs of its
 * width, length and height: a minus says "round", in another way in each version.
 */
#include "lights/photometry_parts.h"

#include <math.h>

/* What the signs of length, width and height mean. Where a version has no such row, the first of
 * any other counts. */
static const struct {
    photometry_format from, to;
    signed char length, width, height;
    opening_shape shape;
} signs[] = {
#define ANY       PHOTOMETRY_LM63_1986, PHOTOMETRY_LM63_2019
#define OLD       PHOTOMETRY_LM63_1986, PHOTOMETRY_LM63_1991
#define OLD_TO_95 PHOTOMETRY_LM63_1986, PHOTOMETRY_LM63_1995
#define OF_95     PHOTOMETRY_LM63_1995, PHOTOMETRY_LM63_1995
#define NEW       PHOTOMETRY_LM63_2002, PHOTOMETRY_LM63_2019
#define NONE      PHOTOMETRY_NO_FILE, PHOTOMETRY_NO_FILE /* clear, though in no version */
    { ANY, 0, 0, 0, OPENING_POINT },
    { ANY, 1, 1, 0, OPENING_RECTANGLE },
    { ANY, 1, 1, 1, OPENING_BOX },
    { ANY, 1, 0, 1, OPENING_BOX },
    { ANY, 0, 1, 1, OPENING_BOX },
    { OLD_TO_95, 0, -1, 0, OPENING_DISC },
    { OLD_TO_95, 0, -1, 1, OPENING_VERTICAL_CYLINDER },
    { OF_95, 0, -1, -1, OPENING_SPHERE },
    { OF_95, 1, 0, -1, OPENING_CYLINDER_ALONG },
    { OF_95, 0, 1, -1, OPENING_CYLINDER_ACROSS },
    { OF_95, -1, 1, 1, OPENING_VERTICAL_CYLINDER },
    { OF_95, 1, -1, 1, OPENING_VERTICAL_CYLINDER },
    { OF_95, -1, 1, -1, OPENING_SPHERE },
    { OF_95, 1, -1, -1, OPENING_SPHERE },
    { OLD, 1, -1, 0, OPENING_DISC },
    { OLD, 1, -1, 1, OPENING_SPHERE },
    { NEW, -1, -1, 0, OPENING_DISC },
    { NEW, -1, -1, 1, OPENING_VERTICAL_CYLINDER },
    { NEW, -1, -1, -1, OPENING_SPHERE },
    { NEW, 1, -1, -1, OPENING_CYLINDER_ALONG },
    { NEW, -1, 1, -1, OPENING_CYLINDER_ACROSS },
    { NEW, 0, -1, -1, OPENING_VERTICAL_DISC }, /* faces along the length */
    { NEW, -1, 0, -1, OPENING_VERTICAL_DISC }, /* the same with the two exchanged */
    { NONE, 1, 0, 0, OPENING_LINE },
    { NONE, 0, 1, 0, OPENING_LINE },
    { NONE, 0, 0, 1, OPENING_LINE },
    { NONE, -1, 1, 0, OPENING_DISC },
    { NONE, -1, 0, 0, OPENING_DISC },
    { NONE, -1, 0, 1, OPENING_VERTICAL_CYLINDER },
#undef ANY
#undef OLD
#undef OLD_TO_95
#undef OF_95
#undef NEW
#undef NONE
};

static int sign_of(double x) { return (x > 0.0) - (x < 0.0); }

/* The row of signs[] for these; with any_version, of another version if need be; -1: none. */
static int find_signs(photometry_format f, const int sign[3], bool any_version)
{
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++)
        if ((any_version || (f >= signs[i].from && f <= signs[i].to)) &&
            signs[i].length == sign[0] && signs[i].width == sign[1] && signs[i].height == sign[2])
            return (int)i;
    return -1;
}

bool opening_from_signs(photometry *p, double width, double length, double height)
{
    const int sign[3] = { sign_of(length), sign_of(width), sign_of(height) };
    int own           = find_signs(p->format, sign, false);
    int row           = own >= 0 ? own : find_signs(p->format, sign, true);
    p->opening        = row >= 0 ? signs[row].shape : OPENING_POINT;
    p->length         = row >= 0 ? (float)fabs(length) : 0.0f;
    p->width          = row >= 0 ? (float)fabs(width) : 0.0f;
    p->height         = row >= 0 ? (float)fabs(height) : 0.0f;

    /* Round shapes whose second diameter was left out */
    bool round = p->opening == OPENING_DISC || p->opening == OPENING_VERTICAL_CYLINDER ||
                 p->opening == OPENING_SPHERE;
    if (round && p->length == 0.0f)
        p->length = p->width;
    if (round && p->width == 0.0f)
        p->width = p->length;
    if (p->opening == OPENING_CYLINDER_ALONG && p->width == 0.0f)
        p->width = p->height;
    if (p->opening == OPENING_CYLINDER_ACROSS && p->length == 0.0f)
        p->length = p->height;
    return own >= 0;
}
