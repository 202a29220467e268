/* sim/study_light.c -- what shines: `luminaires` and `lights` of a study.
 *
 * A new kind of ideal light is a line in light_kinds, with the table of its keys.
 */
#include "sim/study_read.h"

static const study_emission plain_light = { .color = { 1, 1, 1 }, .dimming = 1.0 };

/* ---- luminaires ----------------------------------------------------------------------------- */

static bool read_luminaire_at(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_luminaire *l = record;
    return (l->at = study_read_places(r, value, &l->at_count)) != NULL;
}

#define IN_LUMINAIRE(field) offsetof(study_luminaire, field)

static const study_key luminaire_table[] = {
    { "name", STUDY_OPTIONAL, study_read_name, IN_LUMINAIRE(name) },
    { "photometry", STUDY_REQUIRED, study_read_path, IN_LUMINAIRE(photometry) },
    { "at", STUDY_REQUIRED, read_luminaire_at, 0 },
    { "aim", STUDY_OPTIONAL, study_read_direction, IN_LUMINAIRE(aim) },
    { "rotate", STUDY_OPTIONAL, study_read_number, IN_LUMINAIRE(rotate_deg) },
    { "lumens", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(lumens) },
    { "lamp_lumens", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(lamp_lumens) },
    { "watts", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(watts) },
    { "color", STUDY_OPTIONAL, study_read_color, IN_LUMINAIRE(emission.color) },
    { "dimming", STUDY_OPTIONAL, study_read_nonnegative, IN_LUMINAIRE(emission.dimming) },
    { "group", STUDY_NOT_YET },
    { "layout", STUDY_NOT_YET },
    { "nodes", STUDY_NOT_YET },
    { "aim_at", STUDY_NOT_YET },
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
                                            .emission    = plain_light };
    if (!study_read_map(r, value, &luminaire_keys, l))
        return false;
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

/* ---- lights --------------------------------------------------------------------------------- */

typedef struct light_draft { /* a light, and what of its keys the light itself does not keep */
    study_light light;
    double lumens; /* lm; NAN: not given */
    int kind;      /* in light_kinds */
} light_draft;

typedef struct light_kind {
    study_word type;
    const study_keys *keys;
    bool (*finish)(const study_reader *r, const yaml_node_t *value, light_draft *draft);
} light_kind;

static bool read_light_type(const study_reader *r, const yaml_node_t *value, void *draft);

static bool read_light_at(const study_reader *r, const yaml_node_t *value, void *draft)
{
    study_light *l = &((light_draft *)draft)->light;
    return (l->at = study_read_places(r, value, &l->at_count)) != NULL;
}

/* A point that shines alike all around: lumens = 4 pi candelas. */
static bool finish_point(const study_reader *r, const yaml_node_t *value, light_draft *draft)
{
    bool by_lumens = !isnan(draft->lumens);
    if (by_lumens == !isnan(draft->light.intensity))
        return study_node_failed(r, value, ERR_FORMAT,
                                 "a point light takes either `intensity` or `lumens`, found %s",
                                 by_lumens ? "both" : "neither");
    if (by_lumens)
        draft->light.intensity = draft->lumens / (4.0 * M_PI);
    return true;
}

static const study_key point_table[] = {
    { "type", STUDY_REQUIRED, read_light_type, 0 },
    { "name", STUDY_OPTIONAL, study_read_name, offsetof(light_draft, light.name) },
    { "at", STUDY_REQUIRED, read_light_at, 0 },
    { "intensity", STUDY_OPTIONAL, study_read_nonnegative, offsetof(light_draft, light.intensity) },
    { "lumens", STUDY_OPTIONAL, study_read_nonnegative, offsetof(light_draft, lumens) },
    { "color", STUDY_OPTIONAL, study_read_color, offsetof(light_draft, light.emission.color) },
    { "dimming", STUDY_OPTIONAL, study_read_nonnegative,
      offsetof(light_draft, light.emission.dimming) },
    { "group", STUDY_NOT_YET },
};
static const study_keys point_keys = STUDY_KEYS("a point light", point_table);

static const light_kind light_kinds[] = {
    { { "point", STUDY_OPTIONAL }, &point_keys, finish_point },
    { { "cone", STUDY_NOT_YET } },
    { { "cosine", STUDY_NOT_YET } },
    { { "parallel", STUDY_NOT_YET } },
    { { "linear", STUDY_NOT_YET } },
    { { "disk", STUDY_NOT_YET } },
    { { "rect", STUDY_NOT_YET } },
};

static bool read_light_type(const study_reader *r, const yaml_node_t *value, void *draft)
{
    light_draft *d = draft;
    d->kind        = study_read_word(r, value, &light_kinds[0].type,
                                     sizeof light_kinds / sizeof *light_kinds, sizeof *light_kinds);
    return d->kind >= 0;
}

static bool read_light(const study_reader *r, const yaml_node_t *value, void *record)
{
    light_draft draft = { .light  = { .where     = study_node_where(value),
                                      .intensity = (double)NAN,
                                      .emission  = plain_light },
                          .lumens = (double)NAN };

    /* The type says which keys there are: it is read first, wherever it stands */
    const yaml_node_t *type = study_map_value(r, value, "type");
    if (type && !read_light_type(r, type, &draft))
        return false;
    const light_kind *kind = &light_kinds[draft.kind];
    if (!study_read_map(r, value, kind->keys, &draft) || !kind->finish(r, value, &draft))
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
