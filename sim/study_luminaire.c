/* sim/study_luminaire.c -- measured lamps: `luminaires` of a study, one by one and in layouts. */
#include "sim/study_read.h"

enum { MOST_LAID_OUT = 1000000 }; /* in all layouts */

/* Nearer than this, m, one does not aim at a place. */
static const double too_near = 1e-9;

/* ---- layout --------------------------------------------------------------------------------- */

static bool read_fill(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word words[] = { { "room", STUDY_OPTIONAL } };
    bool *fill                      = field;

    *fill = study_read_word(r, value, words, 1, sizeof *words) == 0;
    return *fill;
}

/* N, [nx, ny] or [nx, ny, nz] */
static bool read_count(const study_reader *r, const yaml_node_t *value, void *record)
{
    static const char wanted[] = "one to three whole numbers from 1 to 100000";
    study_layout *l            = record;
    l->axes                    = study_items(value);
    if (l->axes >= 1 && l->axes <= 3)
        return study_read_wholes(r, value, STUDY_MOST_ITEMS, wanted, l->axes, l->count);

    double x;
    if (value->type != YAML_SCALAR_NODE)
        return study_unexpected(r, value, wanted);
    if (!study_read_number(r, value, &x))
        return false;
    if (!(x >= 1.0 && x <= STUDY_MOST_ITEMS && x == floor(x)))
        return study_unexpected(r, value, wanted);
    l->axes     = 1;
    l->count[0] = (int)x;
    return true;
}

static const study_key layout_table[] = {
    { "fill", STUDY_OPTIONAL, read_fill, offsetof(study_layout, fill) },
    { "z", STUDY_OPTIONAL, study_read_positive, offsetof(study_layout, z) },
    { "from", STUDY_OPTIONAL, study_read_place, offsetof(study_layout, from) },
    { "to", STUDY_OPTIONAL, study_read_place, offsetof(study_layout, to) },
    { "count", STUDY_REQUIRED, read_count, 0 },
};
static const study_keys layout_keys = STUDY_KEYS("a layout", layout_table);

/* The keys of the way in which it is written, and none of the other. */
static bool layout_form_kept(const study_reader *r, const yaml_node_t *value, bool fill)
{
    static const char *const keys[][3] = { { "from", "to", NULL }, { "fill", "z", NULL } };
    for (int i = 0; keys[fill][i]; i++)
        if (!study_map_value(r, value, keys[fill][i]))
            return study_node_failed(r, value, ERR_FORMAT,
                                     "a layout needs `fill: room` and `z`, or `from` and `to`");
    for (int i = 0; keys[!fill][i]; i++) {
        const yaml_node_t *stray = study_map_value(r, value, keys[!fill][i]);
        if (stray)
            return study_node_failed(r, stray, ERR_FORMAT, "`%s` does not go with `%s`",
                                     keys[!fill][i], keys[fill][0]);
    }
    return true;
}

/* Several lamps at one place were hardly meant. */
static bool layout_has_places(const study_reader *r, const yaml_node_t *value,
                              const study_layout *l)
{
    static const char *const names = "xyz";
    double way[] = { l->to.x - l->from.x, l->to.y - l->from.y, l->to.z - l->from.z };
    if (l->axes == 1 && l->count[0] > 1 && d3_length(d3_sub(l->to, l->from)) == 0.0)
        return study_node_failed(r, value, ERR_FORMAT, "`from` and `to` are at the same place");
    for (int i = 0; l->axes > 1 && i < l->axes; i++)
        if (l->count[i] > 1 && way[i] == 0.0)
            return study_node_failed(r, value, ERR_FORMAT,
                                     "%d along %c, but `from` and `to` have the same %c",
                                     l->count[i], names[i], names[i]);
    return true;
}

static bool read_layout(const study_reader *r, const yaml_node_t *value, void *field)
{
    study_layout *l = field;
    *l = (study_layout){ .where = study_node_where(value), .given = true, .z = (double)NAN };
    l->count[0] = l->count[1] = l->count[2] = 1;
    if (!study_read_map(r, value, &layout_keys, l) || !layout_form_kept(r, value, l->fill))
        return false;

    double all = (double)l->count[0] * l->count[1] * l->count[2];
    if (all > STUDY_MOST_ITEMS)
        return study_node_failed(r, value, ERR_FORMAT, "%.0f luminaires, expected at most %d", all,
                                 STUDY_MOST_ITEMS);
    const yaml_node_t *count = study_map_value(r, value, "count");
    if (l->fill)
        return l->axes == 2 || study_unexpected(r, count, "[along x, along y]");
    return layout_has_places(r, count, l);
}

/* ---- a luminaire ---------------------------------------------------------------------------- */

static bool read_at(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_luminaire *l = record;
    return (l->at = study_read_places(r, value, &l->at_count)) != NULL;
}

static bool read_aim(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_luminaire *l  = record;
    return l->aim_given = study_read_direction(r, value, &l->aim);
}

static bool read_aim_at(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_luminaire *l     = record;
    return l->aim_at_given = study_read_place(r, value, &l->aim_at);
}

#define IN_LUMINAIRE(field) offsetof(study_luminaire, field)

static const study_key luminaire_table[] = {
    STUDY_EMITTER_KEYS(study_luminaire),
    { "photometry", STUDY_REQUIRED, study_read_path, IN_LUMINAIRE(photometry) },
    { "at", STUDY_OPTIONAL, read_at, 0 },
    { "layout", STUDY_OPTIONAL, read_layout, IN_LUMINAIRE(layout) },
    { "nodes", STUDY_OPTIONAL, study_read_text, IN_LUMINAIRE(nodes) },
    { "aim", STUDY_OPTIONAL, read_aim, 0 },
    { "aim_at", STUDY_OPTIONAL, read_aim_at, 0 },
    { "rotate", STUDY_OPTIONAL, study_read_number, IN_LUMINAIRE(rotate_deg) },
    { "lumens", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(lumens) },
    { "lamp_lumens", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(lamp_lumens) },
    { "watts", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(watts) },
};
static const study_keys luminaire_keys = STUDY_KEYS("a luminaire", luminaire_table);

static bool read_luminaire(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_luminaire *l = record;
    *l                 = (study_luminaire){ .where       = study_node_where(value),
                                            .aim         = { 0, 0, -1 },
                                            .lumens      = (double)NAN,
                                            .lamp_lumens = (double)NAN,
                                            .watts       = (double)NAN,
                                            .emission    = STUDY_EMISSION_PLAIN };
    if (!study_read_map(r, value, &luminaire_keys, l))
        return false;
    if ((l->at != NULL) + l->layout.given + (l->nodes != NULL) != 1)
        return study_node_failed(r, value, ERR_FORMAT,
                                 "a luminaire takes one of `at`, `layout` and `nodes`");
    if (l->aim_given && l->aim_at_given)
        return study_node_failed(r, value, ERR_FORMAT,
                                 "a luminaire takes `aim` or `aim_at`, not both");
    if (!isnan(l->lumens) && !isnan(l->lamp_lumens))
        return study_node_failed(r, value, ERR_FORMAT,
                                 "a luminaire takes `lumens` or `lamp_lumens`, not both");
    return true;
}

bool study_read_luminaires(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s = record;
    s->luminaires =
        study_read_list(r, value, sizeof(study_luminaire), read_luminaire, &s->luminaire_count);
    return s->luminaires != NULL;
}

/* ---- once the room is known ----------------------------------------------------------------- */

/* Half the spacing from the walls: the first of n along a side of length L is at L / 2n. */
static bool fill_room(const study *s, const study_layout *l, study_layout *span, lux_error *err)
{
    if (!s->room.given)
        return study_failed(s, l->where, err, ERR_FORMAT, "`fill: room`, but there is no `room`");
    if (!(l->z < s->room.size.z))
        return study_failed(s, l->where, err, ERR_FORMAT,
                            "`z: %g` is not below the ceiling at %g m", l->z, s->room.size.z);
    double x   = s->room.size.x / (2.0 * l->count[0]);
    double y   = s->room.size.y / (2.0 * l->count[1]);
    span->from = (dvec3){ x, y, l->z };
    span->to   = (dvec3){ s->room.size.x - x, s->room.size.y - y, l->z };
    return true;
}

/* How far from `from` to `to` number i of n is. */
static double share_of_way(int i, int n) { return n > 1 ? (double)i / (n - 1) : 0.5; }

static double between(double from, double to, double t) { return (1.0 - t) * from + t * to; }

static bool lay_out(const study *s, study_luminaire *l, arena *a, lux_error *err)
{
    study_layout span = l->layout;
    if (span.fill && !fill_room(s, &l->layout, &span, err))
        return false;
    const int *n = span.count;
    l->at_count  = n[0] * n[1] * n[2];
    l->at        = arena_array(a, dvec3, (size_t)l->at_count, err);
    for (int k = 0; l->at && k < l->at_count; k++) {
        double x = share_of_way(k % n[0], n[0]);
        double y = span.axes == 1 ? x : share_of_way(k / n[0] % n[1], n[1]);
        double z = span.axes == 1 ? x : share_of_way(k / n[0] / n[1], n[2]);
        l->at[k] = (dvec3){ between(span.from.x, span.to.x, x), between(span.from.y, span.to.y, y),
                            between(span.from.z, span.to.z, z) };
    }
    return l->at != NULL;
}

bool study_finish_luminaires(study *s, arena *a, lux_error *err)
{
    int laid_out = 0; /* a line makes many, and an alias many of such lines */
    for (int i = 0; i < s->luminaire_count; i++) {
        study_luminaire *l = &s->luminaires[i];
        if (l->layout.given && !lay_out(s, l, a, err))
            return false;
        laid_out += l->layout.given ? l->at_count : 0;
        if (laid_out > MOST_LAID_OUT)
            return study_failed(s, l->where, err, ERR_FORMAT, "more than %d luminaires in layouts",
                                MOST_LAID_OUT);
        for (int k = 0; l->aim_at_given && k < l->at_count; k++)
            if (!(d3_length(d3_sub(l->aim_at, l->at[k])) > too_near))
                return study_failed(s, l->where, err, ERR_FORMAT,
                                    "`aim_at` is where the luminaire is");
    }
    return true;
}
