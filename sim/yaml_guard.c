/* sim/yaml_guard.c -- see yaml_guard.h.
 *
 * libyaml's parser of events is walked first: it looks no more than 1024 characters ahead, so
 * that a hostile text is stopped before it costs anything. Its loader then sees sane texts.
 */
#include "sim/yaml_guard.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DEPTH = 64, MOST_ANCHORS = 1000, MOST_DIRECTIVES = 16, MOST_NODES = 1000000 };

static void *refused(const char *path, yaml_mark_t at, lux_error *err, const char *why, int most)
{
    return failed(err, ERR_FORMAT, "%s:%zu:%zu: %s %d", path, at.line + 1, at.column + 1, why,
                  most);
}

/* Where a byte stands; libyaml's reader gives but its offset. */
static yaml_mark_t mark_of_byte(const char *text, size_t offset)
{
    yaml_mark_t m = { .index = offset };
    for (size_t i = 0; i < offset; i++) {
        if (text[i] == '\n')
            m.line++, m.column = 0;
        else
            m.column += ((unsigned char)text[i] & 0xc0) != 0x80; /* characters, not bytes */
    }
    return m;
}

/* libyaml's own complaint, in one line. */
static void *syntax_failed(const yaml_parser_t *p, const char *path, const char *text, size_t size,
                           lux_error *err)
{
    if (p->error == YAML_MEMORY_ERROR)
        return failed(err, ERR_MEMORY, "out of memory: reading %s", path);
    yaml_mark_t m = p->problem_mark;
    if (p->error == YAML_READER_ERROR)
        m = mark_of_byte(text, p->problem_offset < size ? p->problem_offset : size);
    return failed(err, ERR_FORMAT, "%s:%zu:%zu: not valid YAML: %s%s%s", path, m.line + 1,
                  m.column + 1, p->context ? p->context : "", p->context ? ": " : "",
                  p->problem ? p->problem : "unknown error");
}

/* ---- before the tree ------------------------------------------------------------------------ */

/* libyaml compares each directive with all others. */
static bool few_directives(const char *path, const char *text, size_t size, lux_error *err)
{
    int lines = 0;
    for (size_t i = 0; i < size; i++) {
        bool begins = i == 0 || text[i - 1] == '\n' || text[i - 1] == '\r';
        if (begins && text[i] == '%' && ++lines > MOST_DIRECTIVES)
            return refused(path, mark_of_byte(text, i), err, "directives (%): more than",
                           MOST_DIRECTIVES);
    }
    return true;
}

typedef struct event_counts {
    int depth, anchors, documents;
} event_counts;

static const yaml_char_t *event_anchor(const yaml_event_t *e)
{
    switch (e->type) {
    case YAML_SCALAR_EVENT:
        return e->data.scalar.anchor;
    case YAML_SEQUENCE_START_EVENT:
        return e->data.sequence_start.anchor;
    case YAML_MAPPING_START_EVENT:
        return e->data.mapping_start.anchor;
    default:
        return NULL;
    }
}

static bool event_allowed(event_counts *c, const yaml_event_t *e, const char *path, lux_error *err)
{
    bool opens  = e->type == YAML_SEQUENCE_START_EVENT || e->type == YAML_MAPPING_START_EVENT;
    bool closes = e->type == YAML_SEQUENCE_END_EVENT || e->type == YAML_MAPPING_END_EVENT;
    c->depth += opens - closes;
    c->anchors += event_anchor(e) != NULL;
    c->documents += e->type == YAML_DOCUMENT_START_EVENT;

    if (c->depth > MOST_DEPTH)
        return refused(path, e->start_mark, err, "nested deeper than", MOST_DEPTH);
    if (c->anchors > MOST_ANCHORS) /* libyaml compares each with all others */
        return refused(path, e->start_mark, err, "anchors (&): more than", MOST_ANCHORS);
    if (c->documents > 1)
        return failed(err, ERR_FORMAT, "%s:%zu:%zu: a second document begins here, expected one",
                      path, e->start_mark.line + 1, e->start_mark.column + 1);
    return true;
}

static void parser_open(yaml_parser_t *p, const char *text, size_t size)
{
    yaml_parser_set_encoding(p, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(p, (const unsigned char *)text, size);
}

static bool events_allowed(const char *path, const char *text, size_t size, lux_error *err)
{
    yaml_parser_t p;
    if (!yaml_parser_initialize(&p))
        return failed(err, ERR_MEMORY, "out of memory: reading %s", path);
    parser_open(&p, text, size);

    event_counts counts = { 0 };
    bool good = true, ended = false;
    while (good && !ended) {
        yaml_event_t e;
        good = yaml_parser_parse(&p, &e) || syntax_failed(&p, path, text, size, err);
        if (!good)
            break;
        good  = event_allowed(&counts, &e, path, err);
        ended = e.type == YAML_STREAM_END_EVENT;
        yaml_event_delete(&e);
    }
    yaml_parser_delete(&p);
    if (good && counts.documents == 0)
        return failed(err, ERR_FORMAT, "%s: nothing in it, expected a study (lux4: 1 ...)", path);
    return good;
}

/* ---- the tree ------------------------------------------------------------------------------- */

typedef struct node_size {
    int32_t nodes; /* with all below it, aliases as often as they stand; 0: not known yet */
    int8_t height; /* 1 for a scalar */
    bool open;     /* we are within it */
} node_size;

typedef struct tree_walk {
    yaml_document_t *tree;
    node_size *sizes; /* by index, from 1 */
    const char *path;
    lux_error *err;
} tree_walk;

static bool node_allowed(const tree_walk *w, int index, int depth);

/* One child of `above`, whose size grows by the child's. */
static bool child_allowed(const tree_walk *w, int index, int depth, node_size *above)
{
    if (!node_allowed(w, index, depth + 1))
        return false;
    const node_size *s = &w->sizes[index];
    above->nodes += s->nodes; /* at most twice the limit */
    above->height = s->height >= above->height ? (int8_t)(s->height + 1) : above->height;
    if (above->nodes > MOST_NODES)
        return refused(w->path, yaml_document_get_node(w->tree, index)->start_mark, w->err,
                       "nodes, with what aliases (*) repeat: more than", MOST_NODES);
    return true;
}

static bool children_allowed(const tree_walk *w, const yaml_node_t *n, int depth, node_size *size)
{
    if (n->type == YAML_SEQUENCE_NODE) {
        const yaml_node_item_t *i = n->data.sequence.items.start;
        for (; i < n->data.sequence.items.top; i++)
            if (!child_allowed(w, *i, depth, size))
                return false;
    } else if (n->type == YAML_MAPPING_NODE) {
        const yaml_node_pair_t *p = n->data.mapping.pairs.start;
        for (; p < n->data.mapping.pairs.top; p++)
            if (!child_allowed(w, p->key, depth, size) || !child_allowed(w, p->value, depth, size))
                return false;
    }
    return true;
}

static bool tag_allowed(const tree_walk *w, const yaml_node_t *n)
{
    const char *plain = n->type == YAML_SEQUENCE_NODE  ? YAML_SEQ_TAG
                        : n->type == YAML_MAPPING_NODE ? YAML_MAP_TAG
                                                       : YAML_STR_TAG;
    if (!n->tag || !strcmp((const char *)n->tag, plain))
        return true;
    return failed(w->err, ERR_FORMAT, "%s:%zu:%zu: tags (!) have no meaning in a study", w->path,
                  n->start_mark.line + 1, n->start_mark.column + 1);
}

/* Recursion ends at MOST_DEPTH, and each node is entered once. */
static bool node_allowed(const tree_walk *w, int index, int depth)
{
    const yaml_node_t *n = yaml_document_get_node(w->tree, index);
    node_size *size      = &w->sizes[index];
    if (size->open)
        return failed(w->err, ERR_FORMAT, "%s:%zu:%zu: contains itself through an alias (*)",
                      w->path, n->start_mark.line + 1, n->start_mark.column + 1);
    if (depth + size->height > MOST_DEPTH + 1) /* scalars are no level of their own */
        return refused(w->path, n->start_mark, w->err, "nested through aliases (*) deeper than",
                       MOST_DEPTH);
    if (size->nodes)
        return true;
    if (!tag_allowed(w, n))
        return false;

    *size      = (node_size){ .nodes = 1, .height = 1, .open = true };
    bool good  = children_allowed(w, n, depth, size);
    size->open = false;
    return good;
}

static bool tree_allowed(yaml_document_t *tree, const char *path, lux_error *err)
{
    size_t nodes = (size_t)(tree->nodes.top - tree->nodes.start);
    tree_walk w  = { tree, calloc(nodes + 1, sizeof(node_size)), path, err };
    if (!w.sizes)
        return failed(err, ERR_MEMORY, "out of memory: reading %s", path);
    bool good = node_allowed(&w, 1, 0);
    free(w.sizes);
    return good;
}

bool yaml_guard_load(yaml_document_t *tree, const char *path, const char *text, size_t size,
                     lux_error *err)
{
    if (size > YAML_GUARD_BYTES)
        return failed(err, ERR_FORMAT, "%s: %zu bytes, a study has at most %zu", path, size,
                      YAML_GUARD_BYTES);
    size_t bom = size >= 3 && !memcmp(text, "\xef\xbb\xbf", 3) ? 3 : 0;
    text += bom, size -= bom;
    if (!few_directives(path, text, size, err) || !events_allowed(path, text, size, err))
        return false;

    yaml_parser_t p;
    if (!yaml_parser_initialize(&p))
        return failed(err, ERR_MEMORY, "out of memory: reading %s", path);
    parser_open(&p, text, size);
    bool good = yaml_parser_load(&p, tree) || syntax_failed(&p, path, text, size, err);
    yaml_parser_delete(&p);
    if (!good)
        return false;
    if (tree_allowed(tree, path, err))
        return true;
    yaml_document_delete(tree);
    return false;
}
