/* sim/study_node.h -- the nodes of a study's YAML read by type: each value checked as it is read.
 *
 * A mapping is described by a table of its keys: which function reads the value into which field
 * of the record, whether it must be there, whether this version simulates it at all. A new key
 * is a new line of such a table, a new word (of a light's type, say) one of a table of words.
 *
 * All functions that read return false, with *r->err naming file, line and column, what was
 * found and what was expected. Numbers are finite, at most 1e12 in size, and, where they must be
 * > 0, at least 1e-9: so they and their squares are good floats, too. Texts are kept in r->a.
 */
#ifndef SIM_STUDY_NODE_H
#define SIM_STUDY_NODE_H

#include "sim/study.h"

#include <stddef.h>
#include <yaml.h>

enum {
    STUDY_MOST_ITEMS = 100000,
    STUDY_MOST_KEYS  = 32,
    STUDY_MOST_NAMES = 64,      /* in a mapping by names that the user chose: groups, variants */
    STUDY_MOST_READ  = 2000000, /* items of lists, with every variant read for itself */
};

typedef struct study_reader {
    arena *a; /* of the study */
    yaml_document_t *tree;
    const char *path, *folder; /* as in study */
    const char *variant;       /* that is merged over the study, for messages; NULL */
    int *items_left;           /* of STUDY_MOST_READ */
    notices *notices;          /* may be NULL */
    lux_error *err;            /* may be NULL */
} study_reader;

/* Reads value into the field (or, where it concerns several fields, the record) at `field`. */
typedef bool study_read_fn(const study_reader *r, const yaml_node_t *value, void *field);

/* ---- mappings ------------------------------------------------------------------------------- */

typedef enum study_state { STUDY_OPTIONAL, STUDY_REQUIRED, STUDY_NOT_YET } study_state;

typedef struct study_key {
    const char *name;
    study_state state;
    study_read_fn *read; /* not if STUDY_NOT_YET */
    size_t offset;       /* of the field in the record; 0 for the record */
} study_key;

typedef struct study_keys {
    const char *what; /* "a luminaire", for messages */
    const study_key *key;
    int count; /* <= STUDY_MOST_KEYS */
} study_keys;

#define STUDY_KEYS(what, table)                                                                    \
    {                                                                                              \
        what, table, (int)(sizeof(table) / sizeof *(table))                                        \
    }

/* Reads a mapping into a record that holds its defaults. Unknown keys, keys that stand twice, that
 * are missing or that are not simulated yet are errors. */
bool study_read_map(const study_reader *r, const yaml_node_t *map, const study_keys *keys,
                    void *record);

/* The same for a mapping whose keys are names: at most STUDY_MOST_NAMES, none twice. `read` is
 * given `record` with the key and the value of each. */
typedef bool study_read_pair_fn(const study_reader *r, const yaml_node_t *key,
                                const yaml_node_t *value, void *record);
bool study_read_names(const study_reader *r, const yaml_node_t *map, study_read_pair_fn *read,
                      void *record);

/* The value of a key, or NULL if map is no mapping or has no such key. */
const yaml_node_t *study_map_value(const study_reader *r, const yaml_node_t *map, const char *key);

/* Which of many names a wrong one was meant to be: begins as { .wrong = ... }, is shown each; then
 * nearest is the one, or NULL if half of it or more would be wrong. */
typedef struct study_guess {
    const char *wrong, *nearest;
    int distance;
} study_guess;
void study_guess_show(study_guess *g, const char *candidate);

/* ---- lists ---------------------------------------------------------------------------------- */

int study_items(const yaml_node_t *list); /* 0 if it is no list */
const yaml_node_t *study_item(const study_reader *r, const yaml_node_t *list, int i);

/* A list of records of `size` bytes (aligned as a double is), each read by `read`. NULL if one
 * fails; a pointer to nothing if the list is empty. */
void *study_read_list(const study_reader *r, const yaml_node_t *list, size_t size,
                      study_read_fn *read, int *count);

/* ---- words ---------------------------------------------------------------------------------- */

typedef struct study_word {
    const char *name;
    study_state state;
} study_word;

/* Which of `count` words, `stride` bytes apart, a scalar is. -1, with the error, if it is none of
 * them or one that is not simulated yet. */
int study_read_word(const study_reader *r, const yaml_node_t *value, const study_word *words,
                    int count, size_t stride);

/* ---- values, each into a field of the type named -------------------------------------------- */

study_read_fn study_read_number;      /* double */
study_read_fn study_read_nonnegative; /* double, >= 0 */
study_read_fn study_read_positive;    /* double, > 0 */
study_read_fn study_read_share;       /* double, > 0 and <= 1 */
study_read_fn study_read_percent;     /* double; "2%" is 0.02; > 0 and <= 1 */
study_read_fn study_read_opening;     /* double, degrees, > 0 and < 180 */
study_read_fn study_read_switch;      /* bool; on, off, true, false */
study_read_fn study_read_text;        /* const char *; not empty, no control characters */
study_read_fn study_read_name;        /* const char *; good as a file's name */
study_read_fn study_read_path;        /* const char *; the study's folder before a relative one */
study_read_fn study_read_place;       /* dvec3 */
study_read_fn study_read_direction;   /* dvec3, not zero; as long as it was given */
study_read_fn study_read_size;        /* dvec3, each > 0 */
study_read_fn study_read_reflectance; /* vec3, each in [0, 1]; one number for all three or RGB */
study_read_fn study_read_color;       /* vec3, luminance 1; "4000K" or RGB */

/* One triple, or a list of triples, at least one. NULL if it fails. */
dvec3 *study_read_places(const study_reader *r, const yaml_node_t *value, int *count);

study_read_fn study_read_group; /* const char *; a name that stands for no other light */

/* Whether it is `~`, `null` or nothing at all. */
bool study_is_null(const yaml_node_t *n);

/* A list of two whole numbers in [1, most]. */
bool study_read_pair(const study_reader *r, const yaml_node_t *value, int most, int pair[2]);

/* The same for `count` > 0 numbers; `wanted` is for the message. */
bool study_read_wholes(const study_reader *r, const yaml_node_t *value, int most,
                       const char *wanted, int count, int *out);

/* ---- messages ------------------------------------------------------------------------------- */

study_where study_node_where(const yaml_node_t *n);

/* What a node is, short and printable: "`abc`", "a list of 3", "a mapping", "nothing". */
typedef struct study_found {
    char text[80];
} study_found;
study_found study_node_found(const yaml_node_t *n);
study_found study_text_found(const char *text); /* without quotes or `` */

/* The text of a scalar, "" for other nodes. */
const char *study_node_text(const yaml_node_t *n);

/* Fills *r->err with "PATH:LINE:COLUMN: " and the message. NULL. */
void *study_node_failed(const study_reader *r, const yaml_node_t *n, error_code code,
                        const char *format, ...) __attribute__((format(printf, 4, 5), cold));

/* ERR_FORMAT: "expected WANTED, found ...". */
void *study_unexpected(const study_reader *r, const yaml_node_t *n, const char *wanted)
    __attribute__((cold));

#endif
