/* sim/study_material.c -- `materials` of a study: what surfaces do, in place of what a scene says.
 */
#include "materials/material.h"
#include "sim/study_read.h"

#include <string.h>
#include <strings.h>

static const double most_exponent = 1e6, most_ior = 4.0; /* materials/material.h */

/* ---- keys ----------------------------------------------------------------------------------- */

static bool read_between(const study_reader *r, const yaml_node_t *value, double low, double high,
                         const char *wanted, double *out)
{
    double x;
    if (!study_read_number(r, value, &x))
        return false;
    if (!(x >= low && x <= high))
        return study_unexpected(r, value, wanted);
    *out = x;
    return true;
}

static bool read_exponent(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_between(r, value, 1.0, most_exponent, "a number from 1 to 1e6", field);
}

static bool read_ior(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const char wanted[] = "a refractive index > 1 and at most 4";
    double n                   = 0.0;
    if (!read_between(r, value, 1.0, most_ior, wanted, &n))
        return false;
    if (!(n > 1.0 && (float)n > 1.0f))
        return study_unexpected(r, value, wanted);
    *(double *)field = n;
    return true;
}

static bool read_front(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word sides[] = { { "inside" }, { "outside" } };
    int side                        = study_read_word(r, value, sides, 2, sizeof *sides);
    *(bool *)field                  = side == 1;
    return side >= 0;
}

static bool read_pane(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word kinds[] = { { "single" }, { "box" } };
    int kind                        = study_read_word(r, value, kinds, 2, sizeof *kinds);
    *(bool *)field                  = kind == 1;
    return kind >= 0;
}

#define IN_MATERIAL(field) offsetof(study_material, field)

static const study_key material_table[] = {
    { "match", STUDY_REQUIRED, study_read_text, IN_MATERIAL(match) },
    { "reflectance", STUDY_OPTIONAL, study_read_reflectance, IN_MATERIAL(reflectance) },
    { "specular", STUDY_OPTIONAL, study_read_reflectance, IN_MATERIAL(specular) },
    { "exponent", STUDY_OPTIONAL, read_exponent, IN_MATERIAL(exponent) },
    { "mirror", STUDY_OPTIONAL, study_read_reflectance, IN_MATERIAL(mirror) },
    { "brdf", STUDY_OPTIONAL, study_read_path, IN_MATERIAL(brdf) },
    { "up", STUDY_OPTIONAL, study_read_direction, IN_MATERIAL(up) },
    { "front", STUDY_OPTIONAL, read_front, IN_MATERIAL(front_outside) },
    { "transmittance", STUDY_OPTIONAL, study_read_reflectance, IN_MATERIAL(transmittance) },
    { "ior", STUDY_OPTIONAL, read_ior, IN_MATERIAL(ior) },
    { "pane", STUDY_OPTIONAL, read_pane, IN_MATERIAL(box) },
};
static const study_keys material_keys = STUDY_KEYS("a material", material_table);

/* ---- which keys go together ----------------------------------------------------------------- */

/* Exactly one key says what the surface is. */
static bool one_surface(const study_reader *r, const yaml_node_t *map, study_material *m)
{
    static const struct {
        const char *key;
        study_surface surface;
    } kinds[]         = { { "reflectance", SURFACE_MATT },
                          { "mirror", SURFACE_MIRROR },
                          { "brdf", SURFACE_TABLE },
                          { "transmittance", SURFACE_PANE } };
    const char *found = NULL;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const yaml_node_t *value = study_map_value(r, map, kinds[i].key);
        if (value && found)
            return study_node_failed(r, value, ERR_FORMAT, "`%s` does not go with `%s`",
                                     kinds[i].key, found);
        if (value) {
            found      = kinds[i].key;
            m->surface = kinds[i].surface;
        }
    }
    return found || study_node_failed(r, map, ERR_FORMAT,
                                      "a material needs one of the keys `reflectance`, `mirror`, "
                                      "`brdf` and `transmittance`");
}

static bool companions_are_there(const study_reader *r, const yaml_node_t *map)
{
    static const struct {
        const char *key, *needs;
    } pairs[] = { { "specular", "reflectance" }, { "specular", "exponent" },
                  { "exponent", "specular" },    { "up", "brdf" },
                  { "front", "brdf" },           { "ior", "transmittance" },
                  { "pane", "transmittance" } };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const yaml_node_t *value = study_map_value(r, map, pairs[i].key);
        if (value && !study_map_value(r, map, pairs[i].needs))
            return study_node_failed(r, value, ERR_FORMAT, "`%s` needs the key `%s`", pairs[i].key,
                                     pairs[i].needs);
    }
    return true;
}

/* ---- values that go together ---------------------------------------------------------------- */

static double largest(vec3 c) { return (double)fmaxf(c.x, fmaxf(c.y, c.z)); }

/* Relative: as close to their limit as decimals come in floats, and their sums */
static const double rounding = 1e-6;

static bool lobe_is_possible(const study_reader *r, const yaml_node_t *map, const study_material *m)
{
    vec3 d = m->reflectance, s = m->specular;
    double sum = largest((vec3){ d.x + s.x, d.y + s.y, d.z + s.z });
    return sum <= 1.0 + rounding ||
           study_node_failed(r, study_map_value(r, map, "specular"), ERR_FORMAT,
                             "`reflectance` and `specular` add up to %.4g: expected at most 1",
                             sum);
}

static bool pane_is_possible(const study_reader *r, const yaml_node_t *map, const study_material *m)
{
    double found = largest(m->transmittance), most = pane_most(m->ior);
    return found <= most * (1.0 + rounding) ||
           study_node_failed(r, study_map_value(r, map, "transmittance"), ERR_FORMAT,
                             "expected a `transmittance` of at most %.4g, found %.4g (a pane of "
                             "`ior: %g` reflects the rest)",
                             floor(most * 1e4 + rounding) * 1e-4, found, m->ior);
}

/* A file *.xml is a BSDF: of another kind there is no front. */
static bool file_fits(const study_reader *r, const yaml_node_t *map, study_material *m)
{
    const char *end          = strrchr(m->brdf, '.');
    const yaml_node_t *front = study_map_value(r, map, "front");
    if (end && !strcasecmp(end, ".xml"))
        m->surface = SURFACE_BSDF;
    return !front || m->surface == SURFACE_BSDF ||
           study_node_failed(r, front, ERR_FORMAT,
                             "`front` does not go with this `brdf`: only a file *.xml has a front");
}

static bool read_material(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_material *m = record;
    *m                = (study_material){
                       .where = study_node_where(value), .exponent = (double)NAN, .up = { 0, 0, 1 }, .ior = 1.52
    };
    return study_read_map(r, value, &material_keys, m) && one_surface(r, value, m) &&
           companions_are_there(r, value) && lobe_is_possible(r, value, m) &&
           (m->surface != SURFACE_PANE || pane_is_possible(r, value, m)) &&
           (m->surface != SURFACE_TABLE || file_fits(r, value, m));
}

bool study_read_materials(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s = record;
    s->materials =
        study_read_list(r, value, sizeof(study_material), read_material, &s->material_count);
    return s->materials != NULL;
}
