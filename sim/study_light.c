/* sim/study_light.c -- ideal lamps: `lights` of a study.
 *
 * A new kind is a line in light_kinds, with the table of its keys.
 */
#include "sim/study_read.h"

static const double too_near     = 1e-9; /* m: nearer, one does not aim at a place */
static const double least_sine   = 1e-6; /* of an angle: below, two directions are parallel */
static const double largest_cosn = 1e4;  /* exponent of the cosine; a beam of 1 degree at half */

/* ---- keys ----------------------------------------------------------------------------------- */

typedef struct light_draft { /* a light, and what of its keys the light itself does not keep */
    study_light light;
    dvec3 from, to; /* m, linear */
    int kind;       /* in light_kinds */
} light_draft;

static study_read_fn read_type;

static bool read_at(const study_reader *r, const yaml_node_t *value, void *draft)
{
    study_light *l = &((light_draft *)draft)->light;
    return (l->at = study_read_places(r, value, &l->at_count)) != NULL;
}

static bool read_one_at(const study_reader *r, const yaml_node_t *value, void *draft)
{
    study_light *l = &((light_draft *)draft)->light;
    l->at          = arena_new(r->a, dvec3, r->err);
    l->at_count    = 1;
    return l->at && study_read_place(r, value, l->at);
}

static bool read_aim_at(const study_reader *r, const yaml_node_t *value, void *draft)
{
    study_light *l         = &((light_draft *)draft)->light;
    return l->aim_at_given = study_read_place(r, value, &l->aim_at);
}

static bool read_up(const study_reader *r, const yaml_node_t *value, void *draft)
{
    study_light *l     = &((light_draft *)draft)->light;
    return l->up_given = study_read_direction(r, value, &l->up);
}

static bool read_half_angle(const study_reader *r, const yaml_node_t *value, void *field)
{
    double degrees;
    if (!study_read_nonnegative(r, value, &degrees))
        return false;
    *(double *)field = degrees;
    return degrees <= 180.0 || study_unexpected(r, value, "an angle from 0 to 180 degrees");
}

static bool read_exponent(const study_reader *r, const yaml_node_t *value, void *field)
{
    double n;
    if (!study_read_nonnegative(r, value, &n))
        return false;
    *(double *)field = n;
    return n <= largest_cosn || study_unexpected(r, value, "a number from 0 to 10000");
}

static bool read_rect_size(const study_reader *r, const yaml_node_t *value, void *field)
{
    if (study_items(value) != 2)
        return study_unexpected(r, value, "[across, along up]");
    double *size = field;
    return study_read_positive(r, study_item(r, value, 0), &size[0]) &&
           study_read_positive(r, study_item(r, value, 1), &size[1]);
}

#define IN_LIGHT(field) offsetof(light_draft, light.field)

/* clang-format off */
#define KEYS_OF_ALL \
    STUDY_EMITTER_KEYS(study_light), \
    { "type", STUDY_REQUIRED, read_type, 0 }
#define KEYS_OF_AIM \
    { "at", STUDY_REQUIRED, read_at, 0 }, \
    { "aim", STUDY_OPTIONAL, study_read_direction, IN_LIGHT(aim) }, \
    { "aim_at", STUDY_OPTIONAL, read_aim_at, 0 }
#define KEY_OF_STRENGTH(name) \
    { #name, STUDY_OPTIONAL, study_read_nonnegative, IN_LIGHT(name) }
#define KEY_OF_PHOTOMETRY \
    { "photometry", STUDY_OPTIONAL, study_read_path, IN_LIGHT(photometry) }
/* clang-format on */

_Static_assert(offsetof(light_draft, light) == 0, "a draft is read as the light it begins with");

static const study_key point_table[] = {
    KEYS_OF_ALL,
    { "at", STUDY_REQUIRED, read_at, 0 },
    KEY_OF_STRENGTH(intensity),
    KEY_OF_STRENGTH(lumens),
};
static const study_key cone_table[] = {
    KEYS_OF_ALL,
    KEYS_OF_AIM,
    KEY_OF_STRENGTH(intensity),
    KEY_OF_STRENGTH(lumens),
    { "inner", STUDY_OPTIONAL, read_half_angle, IN_LIGHT(inner_deg) },
    { "outer", STUDY_REQUIRED, read_half_angle, IN_LIGHT(outer_deg) },
};
static const study_key cosine_table[] = {
    KEYS_OF_ALL,
    KEYS_OF_AIM,
    KEY_OF_STRENGTH(intensity),
    KEY_OF_STRENGTH(lumens),
    { "exponent", STUDY_OPTIONAL, read_exponent, IN_LIGHT(exponent) },
};
static const study_key parallel_table[] = {
    KEYS_OF_ALL,
    { "aim", STUDY_REQUIRED, study_read_direction, IN_LIGHT(aim) },
    KEY_OF_STRENGTH(illuminance),
    { "at", STUDY_OPTIONAL, read_one_at, 0 },
    { "radius", STUDY_OPTIONAL, study_read_positive, IN_LIGHT(radius) },
};
static const study_key linear_table[] = {
    KEYS_OF_ALL,
    { "from", STUDY_REQUIRED, study_read_place, offsetof(light_draft, from) },
    { "to", STUDY_REQUIRED, study_read_place, offsetof(light_draft, to) },
    KEY_OF_STRENGTH(lumens),
    KEY_OF_STRENGTH(intensity),
    KEY_OF_PHOTOMETRY,
};
static const study_key disk_table[] = {
    KEYS_OF_ALL,
    KEYS_OF_AIM,
    { "radius", STUDY_REQUIRED, study_read_positive, IN_LIGHT(radius) },
    KEY_OF_STRENGTH(luminance),
    KEY_OF_STRENGTH(lumens),
    KEY_OF_PHOTOMETRY,
};
static const study_key rect_table[] = {
    KEYS_OF_ALL,
    KEYS_OF_AIM,
    { "up", STUDY_OPTIONAL, read_up, 0 },
    { "size", STUDY_REQUIRED, read_rect_size, IN_LIGHT(size) },
    KEY_OF_STRENGTH(luminance),
    KEY_OF_STRENGTH(lumens),
    KEY_OF_PHOTOMETRY,
};

/* ---- what a kind asks for besides ----------------------------------------------------------- */

static bool finish_cone(const study_reader *r, const yaml_node_t *value, light_draft *d)
{
    const study_light *l = &d->light;
    return l->inner_deg < l->outer_deg ||
           study_node_failed(r, value, ERR_FORMAT,
                             "expected `inner` < `outer` (half angles), found %g and %g",
                             l->inner_deg, l->outer_deg);
}

static bool finish_parallel(const study_reader *r, const yaml_node_t *value, light_draft *d)
{
    return (d->light.at != NULL) == !isnan(d->light.radius) ||
           study_node_failed(r, value, ERR_FORMAT,
                             "a parallel light takes both `at` and `radius` (a beam) or neither");
}

static bool finish_linear(const study_reader *r, const yaml_node_t *value, light_draft *d)
{
    study_light *l = &d->light;
    l->along       = d3_sub(d->to, d->from);
    if (!(d3_length(l->along) > too_near))
        return study_node_failed(r, value, ERR_FORMAT, "`from` and `to` are at the same place");
    l->at       = arena_new(r->a, dvec3, r->err);
    l->at_count = 1;
    if (l->at)
        *l->at = d3_scale(d3_add(d->from, d->to), 0.5);
    return l->at != NULL;
}

static bool are_parallel(dvec3 a, dvec3 b)
{
    return !(d3_length(d3_cross(a, b)) > least_sine * d3_length(a) * d3_length(b));
}

static bool finish_rect(const study_reader *r, const yaml_node_t *value, light_draft *d)
{
    study_light *l = &d->light;
    for (int k = 0; l->up_given && k < l->at_count; k++)
        if (are_parallel(l->up, study_light_aim(l, k)))
            return study_node_failed(r, value, ERR_FORMAT, "`up` is parallel to `%s`",
                                     l->aim_at_given ? "aim_at" : "aim");
    l->up = study_light_up(l, 0);
    return true;
}

dvec3 study_light_aim(const study_light *l, int k)
{
    return l->aim_at_given ? d3_sub(l->aim_at, l->at[k]) : l->aim;
}

dvec3 study_light_up(const study_light *l, int k)
{
    static const dvec3 north = { 0, 1, 0 }, east = { 1, 0, 0 };
    if (l->up_given)
        return l->up;
    return are_parallel(north, study_light_aim(l, k)) ? east : north;
}

/* ---- kinds ---------------------------------------------------------------------------------- */

typedef struct light_kind {
    study_word type;
    study_keys keys;
    const char *strengths[2]; /* "intensity", "lumens": one of them is given */
    bool (*finish)(const study_reader *r, const yaml_node_t *value, light_draft *draft); /* NULL */
} light_kind;

/* clang-format off */
static const light_kind light_kinds[] = {
    [STUDY_POINT]    = { { "point" }, STUDY_KEYS("a point light", point_table),
                         { "intensity", "lumens" }, NULL },
    [STUDY_CONE]     = { { "cone" }, STUDY_KEYS("a cone light", cone_table),
                         { "intensity", "lumens" }, finish_cone },
    [STUDY_COSINE]   = { { "cosine" }, STUDY_KEYS("a cosine light", cosine_table),
                         { "intensity", "lumens" }, NULL },
    [STUDY_PARALLEL] = { { "parallel" }, STUDY_KEYS("a parallel light", parallel_table),
                         { "illuminance" }, finish_parallel },
    [STUDY_LINEAR]   = { { "linear" }, STUDY_KEYS("a linear light", linear_table),
                         { "intensity", "lumens" }, finish_linear },
    [STUDY_DISK]     = { { "disk" }, STUDY_KEYS("a disk light", disk_table),
                         { "luminance", "lumens" }, NULL },
    [STUDY_RECT]     = { { "rect" }, STUDY_KEYS("a rect light", rect_table),
                         { "luminance", "lumens" }, finish_rect },
};
/* clang-format on */

static bool read_type(const study_reader *r, const yaml_node_t *value, void *draft)
{
    light_draft *d = draft;
    d->kind        = study_read_word(r, value, &light_kinds[0].type,
                                     sizeof light_kinds / sizeof *light_kinds, sizeof *light_kinds);
    return d->kind >= 0;
}

/* Exactly one strength; with photometry, which has one, lumens or none. */
static bool one_strength(const study_reader *r, const yaml_node_t *value, const light_kind *kind,
                         const study_light *l)
{
    const char *const *name = kind->strengths;
    bool first              = study_map_value(r, value, name[0]) != NULL;
    bool second             = name[1] && study_map_value(r, value, name[1]) != NULL;
    if (l->photometry)
        return !first || study_node_failed(r, value, ERR_FORMAT,
                                           "`%s` does not go with `photometry`", name[0]);
    if (first != second)
        return true;
    if (!name[1])
        return study_node_failed(r, value, ERR_FORMAT, "%s needs the key `%s`", kind->keys.what,
                                 name[0]);
    return study_node_failed(r, value, ERR_FORMAT, "%s takes either `%s` or `%s`, found %s",
                             kind->keys.what, name[0], name[1], first ? "both" : "neither");
}

static bool aimed_well(const study_reader *r, const yaml_node_t *value, const study_light *l)
{
    if (!l->aim_at_given)
        return true;
    if (study_map_value(r, value, "aim"))
        return study_node_failed(r, value, ERR_FORMAT, "a light takes `aim` or `aim_at`, not both");
    for (int k = 0; k < l->at_count; k++)
        if (!(d3_length(study_light_aim(l, k)) > too_near))
            return study_node_failed(r, value, ERR_FORMAT, "`aim_at` is where the light is");
    return true;
}

static bool read_light(const study_reader *r, const yaml_node_t *value, void *record)
{
    light_draft draft = { .light = { .where       = study_node_where(value),
                                     .aim         = { 0, 0, -1 },
                                     .up          = { 0, 1, 0 },
                                     .radius      = (double)NAN,
                                     .exponent    = 1.0,
                                     .intensity   = (double)NAN,
                                     .lumens      = (double)NAN,
                                     .luminance   = (double)NAN,
                                     .illuminance = (double)NAN,
                                     .emission    = STUDY_EMISSION_PLAIN } };

    /* The type says which keys there are: it is read first, wherever it stands */
    const yaml_node_t *type = study_map_value(r, value, "type");
    if (type && !read_type(r, type, &draft))
        return false;
    const light_kind *kind = &light_kinds[draft.kind];
    draft.light.kind       = (study_light_kind)draft.kind;
    if (!study_read_map(r, value, &kind->keys, &draft) ||
        !one_strength(r, value, kind, &draft.light) || !aimed_well(r, value, &draft.light) ||
        (kind->finish && !kind->finish(r, value, &draft)))
        return false;
    *(study_light *)record = draft.light;
    return true;
}

bool study_read_lights(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s  = record;
    s->lights = study_read_list(r, value, sizeof(study_light), read_light, &s->light_count);
    return s->lights != NULL;
}
