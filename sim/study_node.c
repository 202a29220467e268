/* sim/study_node.c -- mappings, lists and words of a study; see study_node.h. */
#include "sim/study_node.h"

#include "core/text.h"

#include <assert.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* ---- messages ------------------------------------------------------------------------------- */

study_where study_node_where(const yaml_node_t *n)
{
    return (study_where){ (int)n->start_mark.line + 1, (int)n->start_mark.column + 1 };
}

const char *study_node_text(const yaml_node_t *n)
{
    return n->type == YAML_SCALAR_NODE ? (const char *)n->data.scalar.value : "";
}

/* At most 48 bytes of text, whole characters, nothing that would move the cursor. */
static void show_text(char *to, const char *text, size_t length)
{
    enum { MOST = 48 };
    size_t shown = length;
    if (length > MOST)
        for (shown = MOST; shown > 0 && ((unsigned char)text[shown] & 0xc0) == 0x80;)
            shown--;
    for (size_t i = 0; i < shown; i++) {
        unsigned char c = (unsigned char)text[i];
        *to++           = c < 0x20 || c == 0x7f ? '?' : text[i];
    }
    strcpy(to, shown < length ? "..." : "");
}

study_found study_node_found(const yaml_node_t *n)
{
    study_found f;
    char text[64];
    if (n->type == YAML_MAPPING_NODE) {
        strcpy(f.text, "a mapping");
    } else if (n->type == YAML_SEQUENCE_NODE) {
        snprintf(f.text, sizeof f.text, "a list of %d", study_items(n));
    } else if (n->data.scalar.length == 0) {
        bool plain = n->data.scalar.style == YAML_PLAIN_SCALAR_STYLE;
        strcpy(f.text, plain ? "nothing" : "an empty text");
    } else {
        show_text(text, study_node_text(n), n->data.scalar.length);
        bool quoted = n->data.scalar.style != YAML_PLAIN_SCALAR_STYLE;
        snprintf(f.text, sizeof f.text, "%s`%s`", quoted ? "the text " : "", text);
    }
    return f;
}

study_found study_text_found(const char *text)
{
    study_found f;
    show_text(f.text, text, strlen(text));
    return f;
}

void *study_node_failed(const study_reader *r, const yaml_node_t *n, error_code code,
                        const char *format, ...)
{
    char text[sizeof r->err->text];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    study_where at = study_node_where(n);
    if (r->variant)
        return failed(r->err, code, "%s:%d:%d: with the variant `%s`: %s", r->path, at.line,
                      at.column, r->variant, text);
    return failed(r->err, code, "%s:%d:%d: %s", r->path, at.line, at.column, text);
}

void *study_unexpected(const study_reader *r, const yaml_node_t *n, const char *wanted)
{
    return study_node_failed(r, n, ERR_FORMAT, "expected %s, found %s", wanted,
                             study_node_found(n).text);
}

/* ---- mappings ------------------------------------------------------------------------------- */

void study_guess_show(study_guess *g, const char *candidate)
{
    int distance = text_distance(g->wrong, candidate);
    int most     = g->nearest ? g->distance - 1 : (int)(strnlen(g->wrong, 31) + 1) / 2;
    if (distance <= most)
        g->distance = distance, g->nearest = candidate;
}

static void *key_unknown(const study_reader *r, const yaml_node_t *key, const study_keys *keys)
{
    study_guess guess = { .wrong = study_node_text(key) };
    for (int k = 0; k < keys->count; k++)
        study_guess_show(&guess, keys->key[k].name);
    if (guess.nearest)
        return study_node_failed(r, key, ERR_FORMAT, "unknown key %s: did you mean `%s`?",
                                 study_node_found(key).text, guess.nearest);

    char all[300] = "";
    for (int k = 0; k < keys->count; k++) {
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", k ? ", " : "", keys->key[k].name);
    }
    return study_node_failed(r, key, ERR_FORMAT, "unknown key %s: %s has %s",
                             study_node_found(key).text, keys->what, all);
}

static const study_key *key_find(const study_keys *keys, const yaml_node_t *name)
{
    for (int k = 0; k < keys->count; k++)
        if (!strcmp(study_node_text(name), keys->key[k].name))
            return &keys->key[k];
    return NULL;
}

static bool keys_complete(const study_reader *r, const yaml_node_t *map, const study_keys *keys,
                          const int *line_of_key)
{
    for (int k = 0; k < keys->count; k++)
        if (keys->key[k].state == STUDY_REQUIRED && !line_of_key[k])
            return study_node_failed(r, map, ERR_FORMAT, "%s needs the key `%s`", keys->what,
                                     keys->key[k].name);
    return true;
}

static void *key_stands_twice(const study_reader *r, const yaml_node_t *name, int line)
{
    return study_node_failed(r, name, ERR_FORMAT, "the key `%s` stands in line %d already",
                             study_text_found(study_node_text(name)).text, line);
}

bool study_read_map(const study_reader *r, const yaml_node_t *map, const study_keys *keys,
                    void *record)
{
    assert(keys->count <= STUDY_MOST_KEYS);
    if (map->type != YAML_MAPPING_NODE)
        return study_unexpected(r, map, "a mapping (key: value)");

    int line_of_key[STUDY_MOST_KEYS] = { 0 };
    const yaml_node_pair_t *pair     = map->data.mapping.pairs.start;
    for (; pair < map->data.mapping.pairs.top; pair++) {
        const yaml_node_t *name = yaml_document_get_node(r->tree, pair->key);
        if (name->type != YAML_SCALAR_NODE)
            return study_unexpected(r, name, "the name of a key");
        const study_key *key = key_find(keys, name);
        if (!key)
            return key_unknown(r, name, keys);

        int *line = &line_of_key[key - keys->key];
        if (*line)
            return key_stands_twice(r, name, *line);
        *line = study_node_where(name).line;
        if (key->state == STUDY_NOT_YET)
            return study_node_failed(r, name, ERR_UNSUPPORTED, "`%s` is not supported yet",
                                     key->name);
        const yaml_node_t *value = yaml_document_get_node(r->tree, pair->value);
        if (!key->read(r, value, (char *)record + key->offset))
            return false;
    }
    return keys_complete(r, map, keys, line_of_key);
}

const yaml_node_t *study_map_value(const study_reader *r, const yaml_node_t *map, const char *key)
{
    if (map->type != YAML_MAPPING_NODE)
        return NULL;
    const yaml_node_pair_t *pair = map->data.mapping.pairs.start;
    for (; pair < map->data.mapping.pairs.top; pair++)
        if (!strcmp(study_node_text(yaml_document_get_node(r->tree, pair->key)), key))
            return yaml_document_get_node(r->tree, pair->value);
    return NULL;
}

/* The node at which the key of that text stands before `pair`, or NULL. */
static const yaml_node_t *key_before(const study_reader *r, const yaml_node_t *map,
                                     const yaml_node_pair_t *pair, const char *text)
{
    const yaml_node_pair_t *first = map->data.mapping.pairs.start;
    for (; first < pair; first++) {
        const yaml_node_t *key = yaml_document_get_node(r->tree, first->key);
        if (!strcmp(study_node_text(key), text))
            return key;
    }
    return NULL;
}

bool study_read_names(const study_reader *r, const yaml_node_t *map, study_read_pair_fn *read,
                      void *record)
{
    if (map->type != YAML_MAPPING_NODE)
        return study_unexpected(r, map, "a mapping (key: value)");
    ptrdiff_t count = map->data.mapping.pairs.top - map->data.mapping.pairs.start;
    if (count > STUDY_MOST_NAMES)
        return study_node_failed(r, map, ERR_FORMAT, "a mapping of %td keys, expected at most %d",
                                 count, STUDY_MOST_NAMES);

    const yaml_node_pair_t *pair = map->data.mapping.pairs.start;
    for (; pair < map->data.mapping.pairs.top; pair++) {
        const yaml_node_t *key = yaml_document_get_node(r->tree, pair->key);
        if (key->type != YAML_SCALAR_NODE)
            return study_unexpected(r, key, "the name of a key");
        const yaml_node_t *twin = key_before(r, map, pair, study_node_text(key));
        if (twin)
            return key_stands_twice(r, key, study_node_where(twin).line);
        if (!read(r, key, yaml_document_get_node(r->tree, pair->value), record))
            return false;
    }
    return true;
}

/* ---- lists ---------------------------------------------------------------------------------- */

int study_items(const yaml_node_t *list)
{
    if (list->type != YAML_SEQUENCE_NODE)
        return 0;
    return (int)(list->data.sequence.items.top - list->data.sequence.items.start);
}

const yaml_node_t *study_item(const study_reader *r, const yaml_node_t *list, int i)
{
    assert(i >= 0 && i < study_items(list));
    return yaml_document_get_node(r->tree, list->data.sequence.items.start[i]);
}

void *study_read_list(const study_reader *r, const yaml_node_t *list, size_t size,
                      study_read_fn *read, int *count)
{
    if (list->type != YAML_SEQUENCE_NODE)
        return study_unexpected(r, list, "a list");
    if (study_items(list) > STUDY_MOST_ITEMS)
        return study_node_failed(r, list, ERR_FORMAT, "a list of %d, expected at most %d",
                                 study_items(list), STUDY_MOST_ITEMS);

    *count = study_items(list);
    if (*count > *r->items_left)
        return study_node_failed(r, list, ERR_FORMAT,
                                 "more than %d items of lists in all variants together",
                                 STUDY_MOST_READ);
    *r->items_left -= *count;
    char *items = arena_alloc(r->a, (size_t)*count, size, alignof(double), r->err);
    for (int i = 0; items && i < *count; i++)
        if (!read(r, study_item(r, list, i), items + (size_t)i * size))
            return NULL;
    return items;
}

/* ---- words ---------------------------------------------------------------------------------- */

int study_read_word(const study_reader *r, const yaml_node_t *value, const study_word *words,
                    int count, size_t stride)
{
    char all[300] = "";
    for (int i = 0; i < count; i++) {
        const study_word *word = (const study_word *)((const char *)words + (size_t)i * stride);
        if (value->type == YAML_SCALAR_NODE && !strcmp(study_node_text(value), word->name)) {
            if (word->state != STUDY_NOT_YET)
                return i;
            study_node_failed(r, value, ERR_UNSUPPORTED, "`%s` is not supported yet", word->name);
            return -1;
        }
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", i ? " or " : "", word->name);
    }
    study_unexpected(r, value, all);
    return -1;
}
