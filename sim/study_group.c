/* sim/study_group.c -- lamps that are dimmed together: `group` of lamps, `dimming` of a study. */
#include "sim/study_read.h"

#include <string.h>

/* Other light has these names where each group has its own column or layer. */
static const char *const taken[] = {
    "sun", "sky", "illuminance", "direct", "indirect", "half_width"
};

/* "desk.direct" would be read as the direct light of `desk` among the channels of an EXR. */
static bool ends_in_layer_word(const char *name)
{
    static const char *const words[] = { ".direct", ".illuminance", ".halfWidth" };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        size_t length = strlen(name), own = strlen(words[i]);
        if (length > own && !strcmp(name + length - own, words[i]))
            return true;
    }
    return false;
}

bool study_read_group(const study_reader *r, const yaml_node_t *value, void *field)
{
    if (ends_in_layer_word(study_node_text(value)))
        return study_node_failed(r, value, ERR_FORMAT,
                                 "`%s` cannot be a group of lamps: channels of results end so",
                                 study_node_text(value));
    for (size_t i = 0; i < sizeof taken / sizeof *taken; i++)
        if (!strcmp(study_node_text(value), taken[i]))
            return study_node_failed(r, value, ERR_FORMAT,
                                     "`%s` cannot be a group of lamps: results call other light so",
                                     taken[i]);
    return study_read_name(r, value, field);
}

static bool read_dimming(const study_reader *r, const yaml_node_t *key, const yaml_node_t *value,
                         void *record)
{
    study *s         = record;
    study_dimming *d = &s->dimmings[s->dimming_count++];
    d->where         = study_node_where(key);
    return study_read_group(r, key, &d->group) && study_read_nonnegative(r, value, &d->factor);
}

bool study_read_dimmings(const study_reader *r, const yaml_node_t *value, void *record)
{
    study *s    = record;
    s->dimmings = arena_array(r->a, study_dimming, STUDY_MOST_NAMES, r->err);
    return s->dimmings && study_read_names(r, value, read_dimming, s);
}

static const char *group_of(const study_emission *e)
{
    return e->group ? e->group : STUDY_GROUP_OTHER;
}

static bool is_dimmed_group(const study *s, const study_dimming *d, study_guess *guess)
{
    bool found = false;
    for (int pass = 0; pass < 2; pass++) { /* of luminaires, of lights */
        int count = pass ? s->light_count : s->luminaire_count;
        for (int i = 0; i < count && !found; i++) {
            const char *group =
                group_of(pass ? &s->lights[i].emission : &s->luminaires[i].emission);
            found = !strcmp(group, d->group);
            if (guess)
                study_guess_show(guess, group);
        }
    }
    /* Files may hold lights, which have no group */
    return found || (s->scene_count > 0 && !strcmp(d->group, STUDY_GROUP_OTHER));
}

bool study_finish_dimmings(const study *s, lux_error *err)
{
    for (int i = 0; i < s->dimming_count; i++) {
        const study_dimming *d = &s->dimmings[i];
        if (is_dimmed_group(s, d, NULL))
            continue;
        study_guess guess = { .wrong = d->group };
        is_dimmed_group(s, d, &guess);
        return study_failed(s, d->where, err, ERR_FORMAT, "no light is of the group `%s`%s%s%s",
                            d->group, guess.nearest ? ": did you mean `" : "",
                            guess.nearest ? guess.nearest : "", guess.nearest ? "`?" : "");
    }
    return true;
}

double study_group_factor(const study *s, const char *group)
{
    for (int i = 0; i < s->dimming_count; i++)
        if (!strcmp(s->dimmings[i].group, group ? group : STUDY_GROUP_OTHER))
            return s->dimmings[i].factor;
    return 1.0;
}
