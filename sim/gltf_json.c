/* sim/gltf_json.c -- see gltf_json.h. A descent of bounded depth through the text. */
#include "sim/gltf_json.h"

#include "core/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { RULES_MOST = 32 };

typedef struct walker {
    const json_check *check;
    char *at, *end;
    lux_error *err;
    size_t pointer_length;
    char pointer[240]; /* JSON pointer of the value at hand; cut off if it is longer */
} walker;

static bool walk(walker *w, const json_rule *rule);

/* ---- what is wrong, and where ---- */

static bool syntax_error(walker *w, const char *wanted)
{
    int line               = 1;
    const char *line_start = w->check->text;
    for (const char *p = w->check->text; p < w->at; p++)
        if (*p == '\n')
            line++, line_start = p + 1;
    return failed(w->err, ERR_FORMAT, "%s:%d:%d: %s, wanted %s", w->check->path, line,
                  (int)(w->at - line_start) + 1,
                  w->at == w->end ? "the JSON ends here" : "this is no JSON", wanted);
}

static bool wrong(walker *w, const char *found, const char *wanted)
{
    return failed(w->err, ERR_FORMAT, "%s: %s: %s, wanted %s", w->check->path,
                  w->pointer_length ? w->pointer : "/", found, wanted);
}

/* Puts /step behind the pointer, and gives the length to go back to. */
static size_t enter(walker *w, const char *step, size_t length)
{
    size_t before = w->pointer_length;
    if (before + 1 + length < sizeof w->pointer) {
        w->pointer[before] = '/';
        memcpy(w->pointer + before + 1, step, length);
        w->pointer_length             = before + 1 + length;
        w->pointer[w->pointer_length] = 0;
    }
    return before;
}

static size_t enter_element(walker *w, uint32_t element)
{
    char number[16];
    return enter(w, number, (size_t)snprintf(number, sizeof number, "%u", element));
}

static void leave(walker *w, size_t before)
{
    w->pointer_length  = before;
    w->pointer[before] = 0;
}

/* ---- tokens ---- */

static void skip_space(walker *w)
{
    while (w->at < w->end && (*w->at == ' ' || *w->at == '\t' || *w->at == '\n' || *w->at == '\r'))
        w->at++;
}

/* Whether c is next; it is passed then, with the space around it. */
static bool took(walker *w, char c)
{
    skip_space(w);
    if (w->at == w->end || *w->at != c)
        return false;
    w->at++;
    skip_space(w);
    return true;
}

/* A string, w->at on its first quote; *text and *length are what stands between the quotes. */
static bool take_string(walker *w, char **text, size_t *length)
{
    char *first = w->at + 1;
    for (w->at = first; w->at < w->end && *w->at != '"'; w->at++) {
        if ((unsigned char)*w->at < 0x20)
            return syntax_error(w, "no control character within a string");
        if (*w->at == '\\' && w->at + 1 < w->end)
            w->at++;
    }
    if (w->at >= w->end) {
        w->at = w->end;
        return syntax_error(w, "the end of a string");
    }
    *text   = first;
    *length = (size_t)(w->at++ - first);
    return true;
}

static int take_digits(walker *w)
{
    char *first = w->at;
    while (w->at < w->end && *w->at >= '0' && *w->at <= '9')
        w->at++;
    return w->at > first;
}

/* A number by JSON's grammar; *whole if it has neither sign, fraction nor exponent. */
static bool take_number(walker *w, double *value, bool *whole)
{
    char *first = w->at;
    *whole      = *w->at != '-';
    w->at += !*whole;
    bool zero = w->at < w->end && *w->at == '0';
    if (!take_digits(w) || (zero && w->at - first - !*whole > 1))
        return syntax_error(w, "a number");
    if (w->at < w->end && *w->at == '.') {
        w->at++, *whole = false;
        if (!take_digits(w))
            return syntax_error(w, "digits");
    }
    if (w->at < w->end && (*w->at == 'e' || *w->at == 'E')) {
        w->at++, *whole = false;
        if (w->at < w->end && (*w->at == '+' || *w->at == '-'))
            w->at++;
        if (!take_digits(w))
            return syntax_error(w, "an exponent");
    }
    if (!text_number(first, NULL, value)) /* which stops there, too: the text ends with a NUL */
        *value = HUGE_VAL;
    return true;
}

/* ---- values ---- */

static const char *kind_wanted(json_kind kind)
{
    static const char *const names[] = {
        [JSON_ANY]     = "any value",
        [JSON_INDEX]   = "an index (an integer >= 0)",
        [JSON_SIZE]    = "an integer >= 0",
        [JSON_NUMBER]  = "a finite number",
        [JSON_NUMBERS] = "an array of numbers",
        [JSON_FLAG]    = "true or false",
        [JSON_TEXT]    = "a string",
        [JSON_TEXTS]   = "an array of strings",
        [JSON_INDICES] = "an array of indices",
        [JSON_OBJECT]  = "an object",
        [JSON_OBJECTS] = "an array of objects",
        [JSON_MAP]     = "an object of indices",
    };
    return names[kind];
}

static bool tell(walker *w, const json_rule *rule, const char *text, size_t length)
{
    return !rule->note || !w->check->seen ||
           w->check->seen(w->check->context, rule->note, text, length, w->err);
}

static bool walk_number(walker *w, const json_rule *rule)
{
    char *first = w->at;
    double value;
    bool whole;
    if (!take_number(w, &value, &whole))
        return false;
    char found[48];
    snprintf(found, sizeof found, "%.*s", w->at - first < 40 ? (int)(w->at - first) : 40, first);
    json_kind kind = rule->kind;
    if (kind == JSON_ANY)
        return true;
    if (kind != JSON_INDEX && kind != JSON_SIZE && kind != JSON_NUMBER)
        return wrong(w, found, kind_wanted(kind));

    double most = kind == JSON_INDEX  ? 2147483647.0
                  : kind == JSON_SIZE ? 9007199254740991.0
                                      : 1e308;
    if ((kind != JSON_NUMBER && !whole) || !(value <= most && value >= -most))
        return wrong(w, found, kind_wanted(kind));
    if ((rule->low != 0 || rule->high != 0) && !(value >= rule->low && value <= rule->high)) {
        char range[64];
        if (rule->low > 0 && rule->low < 1e-300)
            snprintf(range, sizeof range, rule->high >= 1e300 ? "above 0" : "above 0, below %.8g",
                     rule->high);
        else if (rule->high >= 1e300)
            snprintf(range, sizeof range, "at least %g", rule->low);
        else
            snprintf(range, sizeof range, "%g to %g", rule->low, rule->high);
        return wrong(w, found, range);
    }
    if (rule->narrow && fabs(value) > 2147483647.0 && !strpbrk(found, ".eE"))
        return wrong(w, found, "a whole number below 2^31, or one with an exponent");
    if (rule->multiple_of && fmod(value, rule->multiple_of) != 0) {
        char wanted[32];
        snprintf(wanted, sizeof wanted, "a multiple of %d", rule->multiple_of);
        return wrong(w, found, wanted);
    }
    return tell(w, rule, first, (size_t)(w->at - first));
}

static bool walk_word(walker *w, const json_rule *rule)
{
    static const char *const words[] = { "true", "false", "null" };
    for (int i = 0; i < 3; i++) {
        size_t length = strlen(words[i]);
        if ((size_t)(w->end - w->at) < length || memcmp(w->at, words[i], length) != 0)
            continue;
        w->at += length;
        if (rule->kind == JSON_ANY || (rule->kind == JSON_FLAG && i < 2))
            return true;
        return wrong(w, words[i], kind_wanted(rule->kind));
    }
    return syntax_error(w, "a value");
}

/* The rule for the elements of an array under `rule`; NULL if that may be no array. */
static const json_rule *element_rule(const json_rule *rule, json_rule *made)
{
    *made = *rule;
    switch (rule->kind) {
    case JSON_ANY:
        break;
    case JSON_NUMBERS:
        made->kind = JSON_NUMBER;
        break;
    case JSON_TEXTS:
        made->kind = JSON_TEXT;
        break;
    case JSON_INDICES:
        made->kind = JSON_INDEX;
        break;
    case JSON_OBJECTS:
        made->kind = JSON_OBJECT;
        break;
    default:
        return NULL;
    }
    return made;
}

static bool walk_array(walker *w, const json_rule *rule)
{
    json_rule made;
    const json_rule *inner = element_rule(rule, &made);
    if (!inner)
        return wrong(w, "an array", kind_wanted(rule->kind));

    uint32_t count = 0;
    w->at++;
    if (!took(w, ']')) {
        do {
            size_t before = enter_element(w, count);
            if (!walk(w, inner))
                return false;
            leave(w, before);
            count++;
        } while (took(w, ','));
        if (!took(w, ']'))
            return syntax_error(w, "',' or ']'");
    }
    if (rule->kind == JSON_NUMBERS && rule->length && (uint32_t)rule->length != count) {
        char found[32], wanted[32];
        snprintf(found, sizeof found, "%u numbers", count);
        snprintf(wanted, sizeof wanted, "%d", rule->length);
        return wrong(w, found, wanted);
    }
    return true;
}

/* The number of the rule for this key, -1 if there is none. */
static int find_rule(const json_rule *rules, const char *key, size_t length)
{
    for (int i = 0; rules && rules[i].key; i++)
        if (!strncmp(rules[i].key, key, length) && !rules[i].key[length])
            return i;
    return -1;
}

static bool walk_member(walker *w, const json_rule *owner, uint32_t *present)
{
    static const json_rule any = { .kind = JSON_ANY };
    char *key;
    size_t length;
    if (w->at == w->end || *w->at != '"')
        return syntax_error(w, "a key");
    if (!take_string(w, &key, &length))
        return false;
    if (!took(w, ':'))
        return syntax_error(w, "':'");

    json_rule index       = { .kind = JSON_INDEX };
    const json_rule *rule = owner->kind == JSON_MAP ? &index : &any;
    int number            = find_rule(owner->inside, key, length);
    size_t before         = enter(w, key, length);
    if (owner->inside && memchr(key, '\\', length)) /* no rule finds it, but a library would */
        return wrong(w, "a key with a backslash", "one without");
    if (number >= 0) {
        rule = &owner->inside[number];
        if (*present >> number & 1)
            return wrong(w, "it is there twice", "once");
        *present |= 1u << number;
    }
    if (!walk(w, rule))
        return false;
    leave(w, before);
    if (rule->hide)
        *key = '_';
    return true;
}

/* Whether the members that must be there are: bit i of `present` stands for rule i. */
static bool all_present(walker *w, const json_rule *rules, uint32_t present)
{
    const json_rule *either[2] = { NULL, NULL }; /* the first and the last of those */
    bool chosen                = false;
    char found[64];
    for (int i = 0; rules && rules[i].key && i < RULES_MOST; i++) {
        bool here = present >> i & 1;
        if (rules[i].required && !here) {
            snprintf(found, sizeof found, "no \"%s\"", rules[i].key);
            return wrong(w, found, kind_wanted(rules[i].kind));
        }
        if (rules[i].either) {
            either[either[0] != NULL] = &rules[i];
            chosen |= here;
        }
    }
    if (!either[0] || chosen)
        return true;
    snprintf(found, sizeof found, "neither \"%s\" nor \"%s\"", either[0]->key, either[1]->key);
    return wrong(w, found, "one of them");
}

static bool walk_object(walker *w, const json_rule *rule)
{
    if (rule->kind != JSON_ANY && rule->kind != JSON_OBJECT && rule->kind != JSON_MAP)
        return wrong(w, "an object", kind_wanted(rule->kind));
    if (!tell(w, rule, w->at, 1))
        return false;

    static const json_rule any = { .kind = JSON_ANY };
    const json_rule *owner     = rule->kind == JSON_ANY ? &any : rule;
    uint32_t present           = 0;
    w->at++;
    if (!took(w, '}')) {
        do {
            if (!walk_member(w, owner, &present))
                return false;
        } while (took(w, ','));
        if (!took(w, '}'))
            return syntax_error(w, "',' or '}'");
    }
    return all_present(w, owner->inside, present);
}

/* Whether "a|b|c" has the text among its words. */
static bool is_among(const char *words, const char *text, size_t length)
{
    for (const char *word = words; *word; word += *word == '|') {
        size_t here = strcspn(word, "|");
        if (here == length && !memcmp(word, text, length))
            return true;
        word += here;
    }
    return false;
}

static bool walk_text(walker *w, const json_rule *rule)
{
    char *text;
    size_t length;
    if (!take_string(w, &text, &length))
        return false;
    if (rule->kind != JSON_ANY && rule->kind != JSON_TEXT)
        return wrong(w, "a string", kind_wanted(rule->kind));
    if (rule->among && !is_among(rule->among, text, length)) {
        char found[64], wanted[96];
        snprintf(found, sizeof found, "\"%.*s\"", length < 40 ? (int)length : 40, text);
        snprintf(wanted, sizeof wanted, "one of %s", rule->among);
        return wrong(w, found, wanted);
    }
    return tell(w, rule, text, length);
}

static bool walk(walker *w, const json_rule *rule)
{
    skip_space(w);
    if (w->at == w->end)
        return syntax_error(w, "a value");
    switch (*w->at) {
    case '{':
        return walk_object(w, rule);
    case '[':
        return walk_array(w, rule);
    case '"':
        return walk_text(w, rule);
    case '-':
    case '0' ... '9':
        return walk_number(w, rule);
    default:
        return walk_word(w, rule);
    }
}

/* How deep brackets nest: strings are passed over, nothing else is understood. */
static int nesting_depth(const char *text, size_t size)
{
    int depth = 0, most = 0;
    bool quoted = false;
    for (size_t i = 0; i < size; i++) {
        char c = text[i];
        if (c == '"')
            quoted = !quoted;
        else if (quoted)
            i += c == '\\';
        else if (c == '{' || c == '[')
            most = ++depth > most ? depth : most;
        else if (c == '}' || c == ']')
            depth--;
        if (most > JSON_DEPTH_MOST)
            break;
    }
    return most;
}

bool json_obeys(const json_check *c, lux_error *err)
{
    if (nesting_depth(c->text, c->size) > JSON_DEPTH_MOST)
        return failed(err, ERR_FORMAT, "%s: JSON nested more than %d deep", c->path,
                      JSON_DEPTH_MOST);

    walker w       = { .check = c, .at = c->text, .end = c->text + c->size, .err = err };
    json_rule root = { .kind = JSON_OBJECT, .inside = c->rules };
    if (!walk(&w, &root))
        return false;
    skip_space(&w);
    if (w.at != w.end)
        return syntax_error(&w, "nothing behind the outermost object");
    return true;
}
