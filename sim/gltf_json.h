/* sim/gltf_json.h -- JSON text held against rules, before a library makes a tree of it.
 *
 * A library that reads glTF passes over what has the wrong type as if it were not there, and
 * walks into deep nesting until the stack ends. So the text is gone through first: its depth is
 * measured, its syntax is checked, and every value that a rule names has the type, range and
 * length that the rule wants, is there if it must be, and is there once.
 */
#ifndef SIM_GLTF_JSON_H
#define SIM_GLTF_JSON_H

#include "core/arena.h"
#include "core/error.h"

#include <stdint.h>

enum { JSON_DEPTH_MOST = 256 };

typedef enum json_kind {
    JSON_ANY,
    JSON_INDEX,   /* an integer in [0, 2^31) */
    JSON_SIZE,    /* an integer in [0, 2^53) */
    JSON_NUMBER,  /* finite */
    JSON_NUMBERS, /* an array of those */
    JSON_FLAG,    /* true or false */
    JSON_TEXT,
    JSON_TEXTS,   /* an array of those */
    JSON_INDICES, /* an array of JSON_INDEX */
    JSON_OBJECT,
    JSON_OBJECTS, /* an array of those */
    JSON_MAP,     /* an object of JSON_INDEX */
} json_kind;

typedef struct json_rule {
    const char *key;
    json_kind kind;
    const struct json_rule *inside; /* of objects: rules up to one without key; others pass */
    int length;                     /* of JSON_NUMBERS: exactly so many; 0: any */
    const char *among;              /* of JSON_TEXT: one of these, "a|b|c"; NULL: any */
    int multiple_of;                /* of JSON_SIZE; 0: any */
    double low, high;               /* of numbers, both included; low = high = 0: any */
    bool narrow;                    /* of numbers: without fraction and exponent at most 2^31 - 1 */
    bool required;
    bool either; /* of the two that have this, one must be there at least */
    bool hide;   /* the key, its value checked, is overwritten: nobody else finds it */
    int note;    /* not 0: each such value (each element of JSON_OBJECTS) is told to `seen` */
} json_rule;

typedef struct json_check {
    const char *path; /* of the file, for messages */
    char *text;       /* ends with a NUL at text[size] */
    size_t size;
    const json_rule *rules; /* of the outermost object; at most 32 an object */

    /* May be NULL. Called in the order of the text, for an object before its members; value is
     * the text as it stands there, strings without their quotes. False, with *err, to stop. */
    bool (*seen)(void *context, int note, const char *value, size_t length, lux_error *err);
    void *context;
} json_check;

/* False, with *err naming file and JSON pointer (or line and column), if the text is no JSON,
 * nests deeper than JSON_DEPTH_MOST, or breaks a rule. */
bool json_obeys(const json_check *c, lux_error *err);

#endif
