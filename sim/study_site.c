/* sim/study_site.c -- where on Earth the scene stands: `site` of a study. */
#include "sim/study_read.h"

typedef struct range {
    double low, high;
    const char *wanted;
} range;

static bool read_in(const study_reader *r, const yaml_node_t *value, range in, void *field)
{
    double x;
    if (!study_read_number(r, value, &x))
        return false;
    *(double *)field = x;
    return (x >= in.low && x <= in.high) || study_unexpected(r, value, in.wanted);
}

/* Makers that know no file say what was found and what is expected. */
static bool pass_on(const study_reader *r, const yaml_node_t *value, const lux_error *why)
{
    return study_node_failed(r, value, why->code, "%s", why->text);
}

static bool read_place(const study_reader *r, const yaml_node_t *value, void *field)
{
    const char *text;
    lux_error why = { 0 };
    if (!study_read_text(r, value, &text))
        return false;
    return site_read(field, text, &why) || pass_on(r, value, &why);
}

/* Apart from the place, which is read at altitude 0, whichever of the two stands first. */
typedef struct site_draft {
    study_site site;
    double altitude_m;
} site_draft;

static bool read_altitude(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_in(r, value, (range){ -500.0, 9000.0, "an altitude from -500 to 9000 m" }, field);
}

static bool read_zone(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_site *to = &((site_draft *)record)->site;
    lux_error why  = { 0 };
    if (!study_read_text(r, value, &to->zone_name))
        return false;
    to->zone = clock_zone_new(r->a, to->zone_name, &why);
    return to->zone || pass_on(r, value, &why);
}

static bool read_north(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_in(r, value, (range){ -360.0, 360.0, "an angle from -360 to 360 degrees" }, field);
}

static const study_key site_table[] = {
    { "place", STUDY_REQUIRED, read_place, offsetof(site_draft, site.at) },
    { "altitude", STUDY_OPTIONAL, read_altitude, offsetof(site_draft, altitude_m) },
    { "zone", STUDY_OPTIONAL, read_zone, 0 },
    { "north", STUDY_OPTIONAL, read_north, offsetof(site_draft, site.north_deg) },
};
static const study_keys site_keys = STUDY_KEYS("a site", site_table);

bool study_read_site(const study_reader *r, const yaml_node_t *value, void *field)
{
    site_draft d = { .site = { .where = study_node_where(value), .given = true } };
    if (!study_read_map(r, value, &site_keys, &d))
        return false;
    d.site.at.altitude_m = d.altitude_m;
    *(study_site *)field = d.site;
    return true;
}
