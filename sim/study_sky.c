/* sim/study_sky.c -- light from outside: `sky` of a study.
 *
 * Keys of a model may stand in the sky itself or in a mapping of the model's name:
 *
 *     {model: cie, type: 12}   {model: cie, cie: {type: 12}}   {cie: {type: 12}}
 */
#include "sim/study_read.h"

#include <stdio.h>
#include <string.h>

/* ---- models ---------------------------------------------------------------------------------- */

enum {
    NONE         = 1,
    UNIFORM      = 2,
    OVERCAST     = 4,
    INTERMEDIATE = 8,
    CLEAR        = 16,
    CIE          = 32,
    PEREZ        = 64,
    PANORAMA     = 128,
    DISTRIBUTED  = UNIFORM | OVERCAST | INTERMEDIATE | CLEAR | CIE, /* by one of the CIE types */
};

typedef struct sky_model {
    study_word word;
    int bit;
    study_sky_model model;
    int type; /* of the CIE's; -1: as `type` says */
} sky_model;

enum { SKY_TYPE_OVERCAST = 16, SKY_TYPE_CLEAR = 12, SKY_TYPE_INTERMEDIATE = 7 };

static const sky_model models[] = {
    { { "none" }, NONE, STUDY_SKY_NONE, 0 },
    { { "uniform" }, UNIFORM, STUDY_SKY_CIE, 0 },
    { { "overcast" }, OVERCAST, STUDY_SKY_CIE, SKY_TYPE_OVERCAST },
    { { "intermediate" }, INTERMEDIATE, STUDY_SKY_CIE, SKY_TYPE_INTERMEDIATE },
    { { "clear" }, CLEAR, STUDY_SKY_CIE, SKY_TYPE_CLEAR },
    { { "cie" }, CIE, STUDY_SKY_CIE, -1 },
    { { "perez" }, PEREZ, STUDY_SKY_PEREZ, 0 },
    { { "panorama" }, PANORAMA, STUDY_SKY_PANORAMA, 0 },
};
enum { MODELS = sizeof models / sizeof *models };

/* ---- keys ------------------------------------------------------------------------------------ */

typedef struct sky_draft {
    study_sky sky;
    const sky_model *model; /* NULL: not said */
} sky_draft;

static bool read_within(const study_reader *r, const yaml_node_t *value, double low, double high,
                        const char *wanted, double *out)
{
    double x;
    if (!study_read_number(r, value, &x))
        return false;
    *out = x;
    return (x >= low && x <= high) || study_unexpected(r, value, wanted);
}

static bool read_model(const study_reader *r, const yaml_node_t *value, void *draft)
{
    int i = study_read_word(r, value, &models[0].word, MODELS, sizeof *models);
    if (i >= 0)
        ((sky_draft *)draft)->model = &models[i];
    return i >= 0;
}

static bool read_type(const study_reader *r, const yaml_node_t *value, void *field)
{
    double type;
    if (!study_read_number(r, value, &type))
        return false;
    if (!(type >= 1.0 && type <= 15.0 && type == floor(type)))
        return study_unexpected(r, value, "a type of ISO 15469, a whole number from 1 to 15");
    *(int *)field = (int)type;
    return true;
}

static bool read_sun(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word words[] = {
        { "off", STUDY_OPTIONAL },
        { "on", STUDY_OPTIONAL },
        { "disk", STUDY_OPTIONAL },
        { "point", STUDY_OPTIONAL },
    };
    int i = study_read_word(r, value, words, sizeof words / sizeof *words, sizeof *words);
    if (i >= 0)
        *(study_sun *)field = (study_sun)(STUDY_SUN_OFF + i);
    return i >= 0;
}

static bool read_turbidity(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_within(r, value, 1.0, 20.0, "a turbidity (Linke's) from 1 to 20", field);
}

/* The sun itself gives 133 klx outside of the air; ten times that is a slip. */
static bool read_lux(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_within(r, value, 0.0, 1e6, "lux, a number from 0 to 1e6", field);
}

static bool read_some_lux(const study_reader *r, const yaml_node_t *value, void *field)
{
    return study_read_positive(r, value, field) && read_lux(r, value, field);
}

/* Outside of the air the sun gives 1361 W/m^2; edges of clouds add to that. */
static bool read_irradiance(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_within(r, value, 0.0, 2000.0, "W/m^2, a number from 0 to 2000", field);
}

static bool read_some_irradiance(const study_reader *r, const yaml_node_t *value, void *field)
{
    return study_read_positive(r, value, field) && read_irradiance(r, value, field);
}

static bool read_dew_point(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_within(r, value, -100.0, 50.0, "a temperature from -100 to 50 C", field);
}

static bool read_azimuth(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_within(r, value, -360.0, 360.0, "an angle from -360 to 360 degrees", field);
}

static bool read_elevation(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_within(r, value, -90.0, 90.0, "an angle from -90 to 90 degrees", field);
}

static bool read_sun_at(const study_reader *r, const yaml_node_t *value, void *record)
{
    static const study_key table[] = {
        { "azimuth", STUDY_REQUIRED, read_azimuth, offsetof(study_sky, sun_azimuth_deg) },
        { "elevation", STUDY_REQUIRED, read_elevation, offsetof(study_sky, sun_elevation_deg) },
    };
    static const study_keys keys               = STUDY_KEYS("`sun_at`", table);
    return ((study_sky *)record)->sun_at_given = study_read_map(r, value, &keys, record);
}

/* clang-format off */
#define IN_SKY(field) offsetof(sky_draft, sky.field)
#define KEYS_OF_CIE \
    { "type", STUDY_OPTIONAL, read_type, IN_SKY(type) }
#define KEYS_OF_PEREZ \
    { "direct_normal", STUDY_OPTIONAL, read_irradiance, IN_SKY(direct_normal) }, \
    { "diffuse_horizontal", STUDY_OPTIONAL, read_some_irradiance, IN_SKY(diffuse_horizontal) }, \
    { "dew_point", STUDY_OPTIONAL, read_dew_point, IN_SKY(dew_point_c) }
#define KEYS_OF_PANORAMA \
    { "file", STUDY_OPTIONAL, study_read_path, IN_SKY(file) }, \
    { "rotate", STUDY_OPTIONAL, read_azimuth, IN_SKY(rotate_deg) }, \
    { "scale", STUDY_OPTIONAL, study_read_positive, IN_SKY(scale) }
/* clang-format on */

static bool read_cie(const study_reader *r, const yaml_node_t *value, void *draft)
{
    static const study_key table[] = { KEYS_OF_CIE };
    static const study_keys keys   = STUDY_KEYS("`cie`", table);
    return study_read_map(r, value, &keys, draft);
}

static bool read_perez(const study_reader *r, const yaml_node_t *value, void *draft)
{
    static const study_key table[] = { KEYS_OF_PEREZ };
    static const study_keys keys   = STUDY_KEYS("`perez`", table);
    return study_read_map(r, value, &keys, draft);
}

static bool read_panorama(const study_reader *r, const yaml_node_t *value, void *draft)
{
    static const study_key table[] = {
        KEYS_OF_PANORAMA,
        { "horizontal", STUDY_OPTIONAL, read_some_lux, IN_SKY(horizontal) },
    };
    static const study_keys keys = STUDY_KEYS("`panorama`", table);
    return study_read_map(r, value, &keys, draft);
}

_Static_assert(offsetof(sky_draft, sky) == 0, "a draft is read as the sky it begins with");

static const study_key sky_table[] = {
    { "model", STUDY_OPTIONAL, read_model, 0 },
    KEYS_OF_CIE,
    { "sun", STUDY_OPTIONAL, read_sun, IN_SKY(sun) },
    { "turbidity", STUDY_OPTIONAL, read_turbidity, IN_SKY(turbidity) },
    { "horizontal", STUDY_OPTIONAL, read_lux, IN_SKY(horizontal) },
    { "sun_illuminance", STUDY_OPTIONAL, read_lux, IN_SKY(sun_illuminance) },
    { "sun_at", STUDY_OPTIONAL, read_sun_at, 0 },
    { "ground", STUDY_OPTIONAL, study_read_reflectance, IN_SKY(ground) },
    KEYS_OF_PEREZ,
    KEYS_OF_PANORAMA,
    { "cie", STUDY_OPTIONAL, read_cie, 0 },
    { "perez", STUDY_OPTIONAL, read_perez, 0 },
    { "panorama", STUDY_OPTIONAL, read_panorama, 0 },
};
static const study_keys sky_keys = STUDY_KEYS("a sky", sky_table);

/* ---- which go together ----------------------------------------------------------------------- */

/* What a key is for; in a mapping of its own model, or NULL. */
typedef struct key_use {
    const char *key, *nest;
    int with;
} key_use;

static const key_use uses[] = {
    { "type", "cie", CIE },
    { "cie", NULL, CIE },
    { "direct_normal", "perez", PEREZ },
    { "diffuse_horizontal", "perez", PEREZ },
    { "dew_point", "perez", PEREZ },
    { "perez", NULL, PEREZ },
    { "file", "panorama", PANORAMA },
    { "rotate", "panorama", PANORAMA },
    { "scale", "panorama", PANORAMA },
    { "horizontal", "panorama", DISTRIBUTED | PANORAMA },
    { "panorama", NULL, PANORAMA },
    { "turbidity", NULL, DISTRIBUTED },
    { "sun_illuminance", NULL, DISTRIBUTED | PEREZ },
    { "sun_at", NULL, DISTRIBUTED | PEREZ },
    { "ground", NULL, DISTRIBUTED | PEREZ },
};
enum { USES = sizeof uses / sizeof *uses };

/* The value of a key wherever it stands. */
static const yaml_node_t *find(const study_reader *r, const yaml_node_t *map, const key_use *u)
{
    const yaml_node_t *flat = study_map_value(r, map, u->key);
    const yaml_node_t *nest = u->nest ? study_map_value(r, map, u->nest) : NULL;
    return flat || !nest ? flat : study_map_value(r, nest, u->key);
}

/* In a variant a key of the study's own sky may be in the way. */
static const char *way_out(const study_reader *r, const char *key, char out[80])
{
    out[0] = '\0';
    if (r->variant)
        snprintf(out, 80, " (`%s: ~` in the variant takes it out)", key);
    return out;
}

static bool no_key_twice(const study_reader *r, const yaml_node_t *map)
{
    for (int i = 0; i < USES; i++) {
        const yaml_node_t *nest  = uses[i].nest ? study_map_value(r, map, uses[i].nest) : NULL;
        const yaml_node_t *inner = nest ? study_map_value(r, nest, uses[i].key) : NULL;
        if (inner && study_map_value(r, map, uses[i].key))
            return study_node_failed(r, inner, ERR_FORMAT, "`%s` stands in line %d already",
                                     uses[i].key,
                                     study_node_where(study_map_value(r, map, uses[i].key)).line);
    }
    return true;
}

/* The model that is meant by a mapping of its name, if `model` does not say. */
static bool find_model(const study_reader *r, const yaml_node_t *map, sky_draft *d)
{
    for (int i = 0; i < MODELS && !d->model; i++)
        if (study_map_value(r, map, models[i].word.name))
            d->model = &models[i];
    return d->model || study_node_failed(r, map, ERR_FORMAT, "a sky needs the key `model`");
}

static bool keys_fit(const study_reader *r, const yaml_node_t *map, const sky_model *model)
{
    char out[80];
    for (int i = 0; i < USES; i++) {
        const yaml_node_t *stray = find(r, map, &uses[i]);
        if (stray && !(uses[i].with & model->bit))
            return study_node_failed(r, stray, ERR_FORMAT,
                                     "`%s` means nothing to the sky model `%s`%s", uses[i].key,
                                     model->word.name, way_out(r, uses[i].key, out));
    }
    return true;
}

static bool has(const study_reader *r, const yaml_node_t *map, const char *key)
{
    for (int i = 0; i < USES; i++)
        if (!strcmp(uses[i].key, key))
            return find(r, map, &uses[i]) ||
                   study_node_failed(r, map, ERR_FORMAT, "this sky needs the key `%s`", key);
    return false;
}

static bool has_sun(const sky_draft *d)
{
    if (d->sky.sun != STUDY_SUN_MODEL)
        return d->sky.sun != STUDY_SUN_OFF;
    return d->sky.model != STUDY_SKY_CIE || (d->sky.type >= 7 && d->sky.type <= 15);
}

/* Nothing asks how clear the air is where there is no sun and the sky's light goes by the sun's
 * elevation alone, nor how bright a sun is that is off. */
static bool sun_fits(const study_reader *r, const yaml_node_t *map, const sky_draft *d)
{
    char out[80];
    const yaml_node_t *haze = study_map_value(r, map, "turbidity");
    const yaml_node_t *beam = study_map_value(r, map, "sun_illuminance");
    bool clear              = d->sky.type >= 11 && d->sky.type <= 15; /* sky_diffuse_lx() */
    if (haze && !clear && !has_sun(d))
        return study_node_failed(r, haze, ERR_FORMAT,
                                 "`turbidity` means nothing to the sky model `%s` without a sun%s",
                                 d->model->word.name, way_out(r, "turbidity", out));
    return !beam || has_sun(d) ||
           study_node_failed(r, beam, ERR_FORMAT,
                             "`sun_illuminance` means nothing where the sun is off%s",
                             way_out(r, "sun_illuminance", out));
}

static bool panorama_is_whole(const study_reader *r, const yaml_node_t *map, const sky_draft *d)
{
    const yaml_node_t *level = find(r, map, &(key_use){ "horizontal", "panorama", 0 });
    if (!has(r, map, "file"))
        return false;
    if (level && !isnan(d->sky.scale))
        return study_node_failed(r, level, ERR_FORMAT,
                                 "a panorama takes `scale` or `horizontal`, not both");
    return !level || d->sky.horizontal > 0.0 || study_unexpected(r, level, "lux, a number > 0");
}

static bool sky_is_whole(const study_reader *r, const yaml_node_t *map, sky_draft *d)
{
    if (!no_key_twice(r, map) || !find_model(r, map, d))
        return false;
    d->sky.model = d->model->model;
    d->sky.name  = d->model->word.name;
    if (d->model->bit == NONE) /* of a variant, whose study has a sky with all its keys */
        return true;
    if (!keys_fit(r, map, d->model))
        return false;
    if (d->model->bit == CIE && !has(r, map, "type"))
        return false;
    if (d->model->type >= 0)
        d->sky.type = d->model->type;
    if (d->sky.model == STUDY_SKY_PEREZ)
        return has(r, map, "direct_normal") && has(r, map, "diffuse_horizontal") &&
               sun_fits(r, map, d);
    return d->sky.model == STUDY_SKY_PANORAMA ? panorama_is_whole(r, map, d) : sun_fits(r, map, d);
}

bool study_read_sky(const study_reader *r, const yaml_node_t *value, void *field)
{
    const double none = (double)NAN;
    sky_draft d       = { .sky = { .where              = study_node_where(value),
                                   .given              = true,
                                   .turbidity          = 3.0,
                                   .horizontal         = none,
                                   .sun_illuminance    = none,
                                   .ground             = { 0.2f, 0.2f, 0.2f },
                                   .direct_normal      = none,
                                   .diffuse_horizontal = none,
                                   .dew_point_c        = none,
                                   .scale              = none } };
    if (!study_read_map(r, value, &sky_keys, &d) || !sky_is_whole(r, value, &d))
        return false;
    *(study_sky *)field = d.sky;
    return true;
}
