/* sim/study_value.c -- numbers, texts, places and colours of a study; see study_node.h. */
#include "core/text.h"
#include "sim/planck.h"
#include "sim/study_node.h"

#include <stdio.h>
#include <string.h>

static const double largest = 1e12, smallest = 1e-9;

/* ---- numbers -------------------------------------------------------------------------------- */

typedef struct range {
    double low, high;
    bool above;         /* low itself is no part of it */
    const char *wanted; /* for messages */
} range;

static const range any         = { -(double)INFINITY, (double)INFINITY, false, "a number" };
static const range nonnegative = { 0.0, (double)INFINITY, false, "a number >= 0" };
static const range positive    = { 0.0, (double)INFINITY, true, "a number > 0" };
static const range fraction    = { 0.0, 1.0, false, "a number from 0 to 1" };
static const range share       = { 0.0, 1.0, true, "a number > 0 and at most 1" };
static const range opening     = { 0.0, 180.0, true, "an angle > 0 and < 180 degrees" };

static bool is_plain(const yaml_node_t *n)
{
    return n->type == YAML_SCALAR_NODE && n->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
}

/* All of text as a number of YAML 1.2's core schema: decimal, 0x... or 0o... . */
static bool yaml_number(const char *text, double *out)
{
    static const char digits[] = "0123456789abcdefABCDEF";
    int base                   = !strncmp(text, "0x", 2) ? 16 : !strncmp(text, "0o", 2) ? 8 : 10;
    const char *end;
    if (base == 10)
        return text_number(text, &end, out) && *end == '\0';

    text += 2;
    if (!*text || strspn(text, digits) < strlen(text))
        return false;
    for (*out = 0.0; *text; text++) {
        int digit = (int)(strchr(digits, *text) - digits);
        digit -= digit >= 16 ? 6 : 0;
        if (digit >= base)
            return false;
        *out = *out * base + digit;
    }
    return true;
}

static bool read_in(const study_reader *r, const yaml_node_t *n, const range *in, double *out)
{
    double x = 0.0;
    if (!is_plain(n) || !yaml_number(study_node_text(n), &x))
        return study_unexpected(r, n, in->wanted);
    if (!(x >= in->low && x <= in->high) || (in->above && !(x > in->low)))
        return study_unexpected(r, n, in->wanted);
    if (fabs(x) > largest)
        return study_unexpected(r, n, "a number of at most 1e12");
    if (in->above && x < smallest)
        return study_unexpected(r, n, "a number of at least 1e-9");
    *out = x;
    return true;
}

bool study_read_number(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_in(r, value, &any, field);
}

bool study_read_nonnegative(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_in(r, value, &nonnegative, field);
}

bool study_read_positive(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_in(r, value, &positive, field);
}

bool study_read_share(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_in(r, value, &share, field);
}

bool study_read_opening(const study_reader *r, const yaml_node_t *value, void *field)
{
    double degrees;
    if (!read_in(r, value, &opening, &degrees))
        return false;
    if (degrees >= opening.high)
        return study_unexpected(r, value, opening.wanted);
    *(double *)field = degrees;
    return true;
}

/* A number with a unit behind it, spaces between them allowed: "0.5 %". */
static bool scan_unit(const yaml_node_t *n, char unit, double *out)
{
    const char *s = study_node_text(n);
    if (!text_number(s, &s, out))
        return false;
    s += strspn(s, " ");
    return s[0] == unit && s[1] == '\0';
}

bool study_read_percent(const study_reader *r, const yaml_node_t *value, void *field)
{
    double percent = 0.0;
    if (!scan_unit(value, '%', &percent))
        return study_unexpected(r, value, "a percentage with its sign, as 2%");
    if (!(percent >= smallest && percent <= 100.0))
        return study_unexpected(r, value, "a percentage > 0 and at most 100%");
    *(double *)field = percent / 100.0;
    return true;
}

bool study_read_switch(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const char *const words[] = { "off",   "on",   "false", "true", "False", "True",
                                         "FALSE", "TRUE", "Off",   "On",   "OFF",   "ON" };
    for (size_t i = 0; is_plain(value) && i < sizeof words / sizeof *words; i++)
        if (!strcmp(study_node_text(value), words[i])) {
            *(bool *)field = i % 2;
            return true;
        }
    return study_unexpected(r, value, "on or off");
}

bool study_read_wholes(const study_reader *r, const yaml_node_t *value, int most,
                       const char *wanted, int count, int *out)
{
    if (study_items(value) != count)
        return study_unexpected(r, value, wanted);
    for (int i = 0; i < count; i++) {
        const yaml_node_t *item = study_item(r, value, i);
        double x;
        if (!read_in(r, item, &any, &x))
            return false;
        if (!(x >= 1.0 && x <= most && x == floor(x)))
            return study_unexpected(r, item, wanted);
        out[i] = (int)x;
    }
    return true;
}

bool study_read_pair(const study_reader *r, const yaml_node_t *value, int most, int pair[2])
{
    char wanted[64];
    snprintf(wanted, sizeof wanted, "two whole numbers from 1 to %d", most);
    return study_read_wholes(r, value, most, wanted, 2, pair);
}

/* ---- texts ---------------------------------------------------------------------------------- */

bool study_is_null(const yaml_node_t *n)
{
    const char *s = study_node_text(n);
    return is_plain(n) && (!*s || !strcmp(s, "~") || !strcmp(s, "null") || !strcmp(s, "Null") ||
                           !strcmp(s, "NULL"));
}

static char *keep(const study_reader *r, const char *front, const char *text)
{
    size_t lead = strlen(front), length = strlen(text);
    char *copy = arena_array(r->a, char, lead + length + 1, r->err);
    if (copy) {
        memcpy(copy, front, lead);
        memcpy(copy + lead, text, length + 1);
    }
    return copy;
}

/* A text that fits into one line of a message: `wanted` is what it should have been. */
static bool text_is_good(const study_reader *r, const yaml_node_t *value, const char *wanted)
{
    if (value->type != YAML_SCALAR_NODE || study_is_null(value) || !value->data.scalar.length)
        return study_unexpected(r, value, wanted);
    for (size_t i = 0; i < value->data.scalar.length; i++)
        if (value->data.scalar.value[i] < 0x20 || value->data.scalar.value[i] == 0x7f)
            return study_unexpected(r, value, "a text without control characters");
    return true;
}

bool study_read_text(const study_reader *r, const yaml_node_t *value, void *field)
{
    return text_is_good(r, value, "a text") &&
           (*(const char **)field = keep(r, "", study_node_text(value))) != NULL;
}

bool study_read_name(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "0123456789_-.";
    if (!text_is_good(r, value, "a name"))
        return false;
    const char *name = study_node_text(value);
    size_t length    = strlen(name);
    if (strspn(name, letters) < length || *name == '.' || *name == '-')
        return study_unexpected(r, value,
                                "a name of a-z, A-Z, 0-9, _, - and . that does not "
                                "begin with - or . (it names files)");
    if (length > 100)
        return study_unexpected(r, value, "a name of at most 100 characters (it names files)");
    return study_read_text(r, value, field);
}

bool study_read_path(const study_reader *r, const yaml_node_t *value, void *field)
{
    if (!text_is_good(r, value, "the name of a file"))
        return false;
    const char *path = study_node_text(value);
    if (strlen(path) > 4000)
        return study_unexpected(r, value, "the name of a file, of at most 4000 bytes");
    char *folder =
        keep(r, r->folder, *r->folder && r->folder[strlen(r->folder) - 1] == '/' ? "" : "/");
    return folder && (*(const char **)field = keep(r, *path == '/' ? "" : folder, path)) != NULL;
}

/* ---- places --------------------------------------------------------------------------------- */

static bool read_triple(const study_reader *r, const yaml_node_t *value, const range *in,
                        const char *wanted, double out[3])
{
    if (study_items(value) != 3)
        return study_unexpected(r, value, wanted);
    for (int i = 0; i < 3; i++)
        if (!read_in(r, study_item(r, value, i), in, &out[i]))
            return false;
    return true;
}

static bool read_vector(const study_reader *r, const yaml_node_t *value, const range *in,
                        dvec3 *out)
{
    double c[3];
    if (!read_triple(r, value, in, "[x, y, z]", c))
        return false;
    *out = (dvec3){ c[0], c[1], c[2] };
    return true;
}

bool study_read_place(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_vector(r, value, &any, field);
}

bool study_read_size(const study_reader *r, const yaml_node_t *value, void *field)
{
    return read_vector(r, value, &positive, field);
}

bool study_read_direction(const study_reader *r, const yaml_node_t *value, void *field)
{
    dvec3 d;
    if (!read_vector(r, value, &any, &d))
        return false;
    if (!(d3_length(d) >= smallest))
        return study_node_failed(r, value, ERR_FORMAT, "expected a direction, found no length");
    *(dvec3 *)field = d;
    return true;
}

dvec3 *study_read_places(const study_reader *r, const yaml_node_t *value, int *count)
{
    int items = study_items(value);
    if (items == 0)
        return study_unexpected(r, value, "[x, y, z] or a list of such");
    if (study_item(r, value, 0)->type == YAML_SEQUENCE_NODE)
        return study_read_list(r, value, sizeof(dvec3), study_read_place, count);

    dvec3 *one = arena_new(r->a, dvec3, r->err);
    *count     = 1;
    return one && study_read_place(r, value, one) ? one : NULL;
}

/* ---- colours -------------------------------------------------------------------------------- */

bool study_read_reflectance(const study_reader *r, const yaml_node_t *value, void *field)
{
    double c[3];
    if (value->type == YAML_SCALAR_NODE) {
        if (!read_in(r, value, &fraction, &c[0]))
            return false;
        c[1] = c[2] = c[0];
    } else if (!read_triple(r, value, &fraction, "a number from 0 to 1 or [r, g, b]", c)) {
        return false;
    }
    *(vec3 *)field = (vec3){ (float)c[0], (float)c[1], (float)c[2] };
    return true;
}

bool study_read_color(const study_reader *r, const yaml_node_t *value, void *field)
{
    double kelvin = 0.0, c[3];
    if (value->type == YAML_SCALAR_NODE) {
        if (!scan_unit(value, 'K', &kelvin) || !planck_color(kelvin, field))
            return study_unexpected(r, value,
                                    "a colour temperature from 1000K to 25000K or "
                                    "[r, g, b]");
        return true;
    }
    if (!read_triple(r, value, &nonnegative, "a colour temperature as 4000K or [r, g, b]", c))
        return false;
    if (!rgb_scale_to_luminance_1(c, field))
        return study_node_failed(r, value, ERR_FORMAT, "expected a colour, found black");
    return true;
}
