/* sim/study_variant.c -- named changes of a study: `variants`, merged over it by key.
 *
 *     study     {sky: {model: clear, turbidity: 3}, maintenance: 0.8}
 *     variant   {sky: {turbidity: 5}, maintenance: ~}
 *     both      {sky: {model: clear, turbidity: 5}}
 *
 * Mappings are merged key by key; all else is replaced, lists as a whole; null takes a key out.
 * The merged study is made of nodes of the one tree, so that messages keep their lines.
 */
#include "sim/study_read.h"

#include <string.h>

/* ---- the key -------------------------------------------------------------------------------- */

static bool read_variant(const study_reader *r, const yaml_node_t *key, const yaml_node_t *value,
                         void *record)
{
    static const char *const fixed[] = { "lux4", "variants" };
    (void)record; /* what it says is read once it is merged */
    const char *name;
    if (!study_read_name(r, key, &name))
        return false;
    if (value->type != YAML_MAPPING_NODE)
        return study_unexpected(r, value, "a mapping (key: value)");
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++) {
        const yaml_node_t *stray = study_map_value(r, value, fixed[i]);
        if (stray)
            return study_node_failed(r, stray, ERR_FORMAT, "a variant cannot change `%s`",
                                     fixed[i]);
    }
    return true;
}

bool study_read_variants(const study_reader *r, const yaml_node_t *value, void *record)
{
    return study_read_names(r, value, read_variant, record);
}

/* ---- which there are ------------------------------------------------------------------------ */

static const yaml_node_t *node(const study_reader *r, int index)
{
    return yaml_document_get_node(r->tree, index);
}

static const yaml_node_t *variants_of(const study_reader *r)
{
    return study_map_value(r, yaml_document_get_root_node(r->tree), "variants");
}

int study_variant_count(const study_reader *r)
{
    const yaml_node_t *all = variants_of(r);
    return all ? (int)(all->data.mapping.pairs.top - all->data.mapping.pairs.start) : 0;
}

const char *study_variant_name(const study_reader *r, int i)
{
    return study_node_text(node(r, variants_of(r)->data.mapping.pairs.start[i].key));
}

int study_variant_find(const study_reader *r, const char *name)
{
    study_found shown = study_text_found(name); /* it may be from the command line */
    study_guess guess = { .wrong = name };
    int count         = study_variant_count(r);
    char all[300]     = "";
    for (int i = 0; i < count; i++) {
        const char *known = study_variant_name(r, i);
        if (!strcmp(known, name))
            return i;
        study_guess_show(&guess, known);
        size_t used = strlen(all);
        snprintf(all + used, sizeof all - used, "%s%s", i ? ", " : "", known);
    }
    if (count == 0)
        failed(r->err, ERR_ARGUMENT, "%s: no variant `%s`: the study has no `variants`", r->path,
               shown.text);
    else if (guess.nearest)
        study_node_failed(r, variants_of(r), ERR_ARGUMENT, "no variant `%s`: did you mean `%s`?",
                          shown.text, guess.nearest);
    else
        study_node_failed(r, variants_of(r), ERR_ARGUMENT, "no variant `%s`: there is %s",
                          shown.text, all);
    return -1;
}

/* ---- merging -------------------------------------------------------------------------------- */

static int no_memory(const study_reader *r)
{
    failed(r->err, ERR_MEMORY, "%s: out of memory", r->path);
    return -1;
}

/* Where in the mapping the key is, or -1. */
static int pair_of(const study_reader *r, int map, const char *key)
{
    const yaml_node_t *m = node(r, map);
    for (int i = 0; m->data.mapping.pairs.start + i < m->data.mapping.pairs.top; i++)
        if (!strcmp(study_node_text(node(r, m->data.mapping.pairs.start[i].key)), key))
            return i;
    return -1;
}

/* A mapping that has no keys yet, and stands where `like` does. */
static int new_mapping(const study_reader *r, int like)
{
    int made = yaml_document_add_mapping(r->tree, NULL, YAML_ANY_MAPPING_STYLE);
    if (!made)
        return no_memory(r);
    yaml_document_get_node(r->tree, made)->start_mark = node(r, like)->start_mark;
    return made;
}

static int merge(const study_reader *r, int base, int over);

/* One key of the study, with what the variant makes of it. */
static bool merge_kept(const study_reader *r, yaml_node_pair_t kept, int over, int merged)
{
    int at = pair_of(r, over, study_node_text(node(r, kept.key)));
    if (at >= 0) {
        yaml_node_pair_t change = node(r, over)->data.mapping.pairs.start[at];
        if (study_is_null(node(r, change.value)))
            return true; /* taken out */
        kept.key   = change.key;
        kept.value = merge(r, kept.value, change.value);
    }
    if (kept.value < 0)
        return false;
    return yaml_document_append_mapping_pair(r->tree, merged, kept.key, kept.value) ||
           no_memory(r) > 0;
}

/* One key of the variant that the study does not have. */
static bool merge_new(const study_reader *r, yaml_node_pair_t pair, int base, int merged)
{
    const yaml_node_t *key = node(r, pair.key);
    if (key->type == YAML_SCALAR_NODE && pair_of(r, base, study_node_text(key)) >= 0)
        return true;
    if (study_is_null(node(r, pair.value)))
        return study_node_failed(r, key, ERR_FORMAT, "there is no key %s to be taken out",
                                 study_node_found(key).text);
    return yaml_document_append_mapping_pair(r->tree, merged, pair.key, pair.value) ||
           no_memory(r) > 0;
}

static bool no_key_twice(const study_reader *r, const yaml_node_t *key, const yaml_node_t *value,
                         void *record)
{
    (void)r, (void)key, (void)value, (void)record;
    return true;
}

/* Of two mappings all keys of both; else `over`. The depth is that of the study, which was read. */
static int merge(const study_reader *r, int base, int over)
{
    if (node(r, base)->type != YAML_MAPPING_NODE || node(r, over)->type != YAML_MAPPING_NODE)
        return over;
    if (!study_read_names(r, node(r, over), no_key_twice, NULL))
        return -1;
    int merged = new_mapping(r, over);
    for (int i = 0; merged >= 0; i++) {
        const yaml_node_t *b = node(r, base);
        if (b->data.mapping.pairs.start + i == b->data.mapping.pairs.top)
            break;
        if (!merge_kept(r, b->data.mapping.pairs.start[i], over, merged))
            merged = -1;
    }
    for (int i = 0; merged >= 0; i++) {
        const yaml_node_t *o = node(r, over);
        if (o->data.mapping.pairs.start + i == o->data.mapping.pairs.top)
            break;
        if (!merge_new(r, o->data.mapping.pairs.start[i], base, merged))
            merged = -1;
    }
    return merged;
}

/* The study without its variants, under the variant. */
int study_variant_merge(const study_reader *r, int i)
{
    enum { ROOT = 1 };
    int over = variants_of(r)->data.mapping.pairs.start[i].value;
    int bare = new_mapping(r, over);
    for (int k = 0; bare >= 0; k++) {
        const yaml_node_t *root = node(r, ROOT);
        if (root->data.mapping.pairs.start + k == root->data.mapping.pairs.top)
            break;
        yaml_node_pair_t pair = root->data.mapping.pairs.start[k];
        if (!strcmp(study_node_text(node(r, pair.key)), "variants"))
            continue;
        if (!yaml_document_append_mapping_pair(r->tree, bare, pair.key, pair.value))
            bare = no_memory(r);
    }
    return bare < 0 ? -1 : merge(r, bare, over);
}
