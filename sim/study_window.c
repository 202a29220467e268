/* sim/study_window.c -- `windows` of a study's room: openings in its walls, floor and ceiling. */
#include "materials/material.h"
#include "sim/study_read.h"

enum { MOST_WINDOWS = 100 };

static const double least_left = 1e-3; /* m, of the wall beside a window */
static const double touching   = 1e-6; /* m: overlaps that come of rounding */
static const double rounding   = 1e-6;
static const double glass_ior  = 1.52;

/* ---- values --------------------------------------------------------------------------------- */

static bool read_wall(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word sides[] = { { "floor" }, { "ceiling" }, { "south" },
                                        { "east" },  { "north" },   { "west" } };
    int side = study_read_word(r, value, sides, sizeof sides / sizeof *sides, sizeof *sides);
    *(study_side *)field = (study_side)((int)SIDE_FLOOR + side);
    return side >= 0;
}

static bool read_window_at(const study_reader *r, const yaml_node_t *value, void *field)
{
    double *at = field;
    if (study_items(value) != 2)
        return study_unexpected(r, value, "[from the wall's left end, sill] in m");
    return study_read_nonnegative(r, study_item(r, value, 0), &at[0]) &&
           study_read_nonnegative(r, study_item(r, value, 1), &at[1]);
}

static bool read_window_size(const study_reader *r, const yaml_node_t *value, void *field)
{
    double *size = field;
    if (study_items(value) != 2)
        return study_unexpected(r, value, "[width, height] in m");
    return study_read_positive(r, study_item(r, value, 0), &size[0]) &&
           study_read_positive(r, study_item(r, value, 1), &size[1]);
}

/* As much as glass lets through, or all. */
static bool read_transmittance(const study_reader *r, const yaml_node_t *value, void *field)
{
    double most = pane_most(glass_ior), t;
    if (!study_read_share(r, value, &t))
        return false;
    *(double *)field = t < 1.0 ? fmin(t, most) : t;
    return t == 1.0 || t <= most * (1.0 + rounding) ||
           study_node_failed(r, value, ERR_FORMAT,
                             "expected a `transmittance` of at most %.4g, or 1 for an open hole, "
                             "found %.4g (a pane of glass reflects the rest)",
                             floor(most * 1e4 + rounding) * 1e-4, t);
}

static bool read_window(const study_reader *r, const yaml_node_t *value, void *record)
{
    static const study_key table[] = {
        { "wall", STUDY_REQUIRED, read_wall, offsetof(study_window, wall) },
        { "at", STUDY_REQUIRED, read_window_at, offsetof(study_window, at) },
        { "size", STUDY_REQUIRED, read_window_size, offsetof(study_window, size) },
        { "transmittance", STUDY_OPTIONAL, read_transmittance,
          offsetof(study_window, transmittance) },
    };
    static const study_keys keys = STUDY_KEYS("a window", table);
    study_window *w              = record;
    *w = (study_window){ .where = study_node_where(value), .transmittance = 1.0 };
    return study_read_map(r, value, &keys, w);
}

bool study_read_windows(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_room *room = record;
    room->windows =
        study_read_list(r, value, sizeof(study_window), read_window, &room->window_count);
    return room->windows && (room->window_count <= MOST_WINDOWS ||
                             study_node_failed(r, value, ERR_ARGUMENT,
                                               "%d windows, expected at most %d: more are for a "
                                               "glTF file",
                                               room->window_count, MOST_WINDOWS));
}

/* ---- whether they fit ----------------------------------------------------------------------- */

static const char *const side_names[] = {
    [SIDE_FLOOR] = "floor",    [SIDE_CEILING] = "ceiling",  [SIDE_SOUTH] = "south wall",
    [SIDE_EAST] = "east wall", [SIDE_NORTH] = "north wall", [SIDE_WEST] = "west wall",
};

/* m, of a window's wall: along it, and up. */
static void wall_lengths(dvec3 size, study_side wall, double out[2])
{
    bool flat = wall == SIDE_FLOOR || wall == SIDE_CEILING;
    out[0]    = wall == SIDE_EAST || wall == SIDE_WEST ? size.y : size.x;
    out[1]    = flat ? size.y : size.z;
}

static bool fits_wall(const study_reader *r, const study_room *room, const study_window *w,
                      const yaml_node_t *node)
{
    double lengths[2];
    wall_lengths(room->size, w->wall, lengths);
    bool flat = w->wall == SIDE_FLOOR || w->wall == SIDE_CEILING;
    for (int k = 0; k < 2; k++) {
        double most = lengths[k] - least_left;
        /* Half of what is to be left forgives the rounding of decimals */
        if (w->at[k] >= 0.5 * least_left && w->at[k] + w->size[k] <= most + 0.5 * least_left &&
            w->size[k] >= 0.5 * least_left)
            continue;
        return study_node_failed(r, node, ERR_FORMAT,
                                 "a window from %g to %g m %s the %s, which is %g m %s: expected "
                                 "it within %g to %g m",
                                 w->at[k], w->at[k] + w->size[k],
                                 flat     ? k == 0 ? "along x of" : "along y of"
                                 : k == 0 ? "along"
                                          : "up",
                                 side_names[w->wall], lengths[k],
                                 flat     ? "long that way"
                                 : k == 0 ? "long"
                                          : "high",
                                 least_left, most);
    }
    return true;
}

static bool overlap(const study_window *a, const study_window *b)
{
    bool both = a->wall == b->wall;
    for (int k = 0; k < 2 && both; k++)
        both = a->at[k] + a->size[k] > b->at[k] + touching &&
               b->at[k] + b->size[k] > a->at[k] + touching;
    return both;
}

bool study_check_windows(const study_reader *r, const study_room *room, const yaml_node_t *list)
{
    const study_window *w = room->windows;
    for (int i = 0; i < room->window_count; i++) {
        const yaml_node_t *node = study_item(r, list, i);
        if (!fits_wall(r, room, &w[i], node))
            return false;
        for (int j = 0; j < i; j++)
            if (overlap(&w[i], &w[j]))
                return study_node_failed(r, node, ERR_FORMAT,
                                         "this window overlaps the one at %d:%d, which takes "
                                         "%g to %g m along the %s and %g to %g m up",
                                         w[j].where.line, w[j].where.column, w[j].at[0],
                                         w[j].at[0] + w[j].size[0], side_names[w[j].wall],
                                         w[j].at[1], w[j].at[1] + w[j].size[1]);
    }
    return true;
}
