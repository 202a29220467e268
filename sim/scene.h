/* sim/scene.h -- what is simulated: the study and all it names, read, checked and ready to trace.
 *
 * Places are re-centred: a float place q of the scene lies at q + centre in the user's frame, so
 * that a model in a country's grid is as exact as one at the origin.
 */
#ifndef SIM_SCENE_H
#define SIM_SCENE_H

#include "core/world.h"
#include "lights/light.h"
#include "lights/light_tree.h"
#include "lights/photometry.h"
#include "materials/material.h"
#include "sim/gltf.h"
#include "sim/mirrors.h"
#include "sim/moments.h"
#include "sim/study.h"
#include "sky/dome.h"
#include "sky/portal.h"

/* Colours are means over textures, and of what is there where there are holes: of all light that
 * meets it a surface reflects reflectance * there. */
typedef struct scene_material {
    const char *name;     /* "room: walls" for those of the room */
    const char *kind;     /* material_type.name */
    const char *file;     /* of a measured table; NULL */
    double reciprocity;   /* of a table: mean of |f(a, b) - f(b, a)| by f; else 0 */
    double scaled_by;     /* of a table: (0, 1], so that it gives back no more than it gets */
    vec3 reflectance;     /* of diffuse light, on the front side */
    vec3 transmittance;   /* of diffuse light, straight and scattered */
    vec3 emission;        /* cd/m^2 */
    double there;         /* [0, 1]: the share of it that is no hole */
    bool textured, bumpy; /* it has textures; a normal map */
    bool holes, box;      /* it has holes; of closed boxes of glass, each taken as one pane */
    bool smoothed;        /* a solid of rough glass, whose border is taken as smooth */
    bool overridden;      /* by the study's materials */
    bool exterior;        /* of what the study says is outside */
    bool used;            /* some surface is made of it */
    double area;          /* m^2, of those, one side */
} scene_material;

/* What paths need to know of a material without asking it. */
typedef enum material_deed {
    DOES_ASK      = 1,  /* it has a part with a density: lights are asked where it is met */
    DOES_NARROW   = 2,  /* it is not matt */
    DOES_AROUND   = 4,  /* light from the other side counts */
    DOES_SOLID    = 8,  /* it is the face of a solid that refracts */
    DOES_EXTERIOR = 16, /* it is outside: light that it gives on comes from there */
    DOES_HOLLOW   = 32, /* it lets light straight through */
    DOES_LENS     = 64, /* it is a solid that is no plate: no shadow ray passes it */
} material_deed;

typedef struct scene_light {
    const char *name;      /* for reports: "downlight (4.ies)" */
    dvec3 at;              /* m, in the user's frame; of a far one: where it shines to */
    double lumens;         /* initial, dimming included; INFINITY: far away */
    double full;           /* lm, not dimmed */
    double watts;          /* W, of the luminaire, not dimmed; NAN: not known */
    const photometry *web; /* NULL */
    vec3 color;            /* luminance 1 */
    int group;             /* in scene.groups */
    float dimming; /* by which its light is still to be multiplied: 1 unless the scene is layered */
    double dimmed_to;                 /* of its full light, group included */
    study_where where;                /* its entry of the study; line 0: of a glTF file */
    const study_luminaire *luminaire; /* that entry, if it is one of `luminaires`; NULL */
    int owner;  /* of the instances that do not shade it (world_instance.owner); 0: all do */
    bool clear; /* nothing stands between it and any place in the room */
    bool sun;
} scene_light;

/* Light from infinitely far, besides suns: of a moment's sky; of the ground below, as its sky
 * lights it and as its sun does. */
typedef struct scene_sky {
    const sky *sky;
    int group;   /* in scene.groups */
    bool ground; /* it has been reflected: light that comes straight from it is not direct */
} scene_sky;

/* Up to so many lamps are all looked at to choose one; more are chosen from by a tree. */
enum { FEW_LAMPS = 12 };

/* So many samples a sensor takes at first where light comes by way of narrow lobes: lights
 * in them are met rarely.
 */
enum { MIRROR_SAMPLES = 4096 };

/* Lights among which one is chosen. */
typedef struct light_set {
    const light_tree *tree; /* over `lights`; NULL where lamps are few, and no surface glows */
    const int32_t *lights;  /* as scene.lights counts: lamps, then emitters */
    int lamps, emitters;
} light_set;

/* The first group of a series, of all that is no daylight. */
#define SCENE_LAMPS "lamps"

/* The shares of light that come to surfaces, from where they go on, otherwise than straight or by
 * mirror images: measured with some thousand particles. */
typedef struct scene_ways {
    double focused; /* by round mirrors, and by solids that refract */
    double narrow;  /* by way of narrow lobes */
} scene_ways;

/* Less than that share does not matter: a tenth of the accuracy that is promised if none is asked
 * for. */
#define SHARE_THAT_MATTERS 0.002

typedef struct scene_camera {
    const char *name;
    transform place; /* to the user's frame; looks along -z, +y up */
    bool perspective;
    double yfov, aspect, ymag, xmag;
} scene_camera;

typedef struct scene {
    const study *study;
    dvec3 centre; /* m */
    world *world;
    dvec3 low, high; /* m, box around all surfaces in the user's frame; empty: low > high */

    int material_count; /* as vsurface.material counts them */
    const material *const *materials;
    const scene_material *material_info;

    int light_count;            /* lamps; the last sun_count of them are suns */
    int sun_count;              /* asked besides the sets */
    int emitter_count;          /* triangles of glowing surfaces */
    const light *const *lights; /* lamps, then emitters */
    const scene_light *light_info;
    const light_set *sets; /* of each group that has lamps if the scene is layered, else one of all;
                              suns are in none */
    int set_count;
    const int32_t *set_of_group;  /* -1: the group has none */
    light_set glow_set;           /* glowing surfaces alone */
    const int64_t *first_emitter; /* of an instance: where its triangles begin in emitter_of; -1 */
    const int32_t *emitter_of;    /* the emitter that a triangle is, or -1 */
    bool lights_differ;           /* in colour: then luminance does not tell all of a mixture */
    bool extended;                /* some lamp that is no sun is more than a point */

    /* Daylight. Of several moments each has a group of its own, and "lamps" holds all else; else
     * there are groups `sun` and `sky`. */
    const moment *moments;
    int moment_count; /* 0: neither sky nor sun, else >= 1 */
    bool by_moment;   /* groups are of moments */
    const scene_sky *skies;
    int sky_count;
    const dome *dome;       /* over all skies; NULL: none gives light */
    const portals *portals; /* what they come in by; NULL: none known */
    int portal_count;
    const portal *portal_list;
    const char *portals_from; /* "2 room windows"; NULL: there are none */
    bool exteriors;           /* some surface is outside */

    int group_count; /* of lamps; "other" holds those that are in none */
    const char *const *groups;
    int glow_group;     /* of glowing surfaces */
    float glow_dimming; /* what they are to be multiplied by */
    bool owners;        /* some lamp has a body that does not shade it */
    bool layered;       /* lights hold their full light, and light_info what it is dimmed to */

    int camera_count;
    const scene_camera *cameras;

    const int32_t *material_does; /* of each material: bits of material_deed */
    bool textured;                /* what follows is of materials in use: some have textures, */
    bool smooth;                  /* some mesh has normals of its own, */
    bool hollow;                  /* some let light straight through, */
    bool solids;                  /* some of those are solids that refract, */
    bool smoothed;                /* of these some are rough, and taken as smooth, */
    bool narrow;                  /* some are not matt: rays find lamps by way of them */

    bool grey; /* paths find the same in all three channels, and one is computed: all that is met,
                  and all light, is grey to the bit */

    const mirrors *mirror_images; /* NULL: no plane mirror or pane that lamps or suns light */
    bool unshadowed, untinted;    /* as asked for: no shadow ray is traced; what lets light straight
                                     through lets all of it pass */
    bool asks_all;                /* so, too: sensors ask all lamps, however many */
    bool pixel_centres;           /* so, too: views look through the middles of pixels */

    bool reflects;          /* light goes on from some surface, to either side */
    bool glows;             /* some surface emits light */
    double glow_watts;      /* W, not dimmed, of glowing surfaces that are no emitters: they have
                               textures of emission or alpha, and only rays find them */
    uint64_t texture_bytes; /* of all textures, kept */
    uint64_t picture_bytes; /* of the largest picture decoded, while its texture is made */
    bool lenses;            /* some solids are no plates */
    scene_ways by_lamps, by_suns;
    bool lamps_hide;   /* some lamps are too small to be met by rays, by way of narrow lobes */
    int small_patches; /* lamps that light a patch too small for samples to find reliably */
} scene;

/* Whether results want a map of focused light: some may be of suns, or of lamps too small to be met
 * by rays. However little it is of all, it may be much where it comes together. */
bool scene_focuses(const scene *s);

/* Whether light of lamps comes by ways that rays find rarely: then many samples come first. */
bool scene_is_rarely_met(const scene *s);

/* The light that samples may miss without an interval telling, in words; NULL if there is none. */
const char *scene_left_to_chance(const scene *s, bool direct_only);

/* Ways of reckoning that are worse or slower, for lux4 cost to show what the usual ones are worth.
 */
typedef struct scene_measures {
    bool projection_test; /* world.h: TRIANGLE_PROJECTION */
    bool nearest_tables;  /* goniodiagrams and measured BRDFs: the nearest value */
    bool libm_tables;     /* their angles by the C library, one lane after the other */
    bool point_sun;       /* the sun without its disk */
} scene_measures;

typedef struct scene_options {
    int threads;               /* to build on, >= 1 */
    bool layered;              /* lights as if not dimmed: for a layer of each group */
    const gltf *const *models; /* of study->scenes, in place of their files; NULL */
    const moment *moments;     /* a series, layered by moment, lamps as dimmed; NULL: the study's
                                  own one */
    int moment_count;
    bool lamps_off; /* lamps and glowing surfaces are left out */
    uint32_t off;   /* bits 1 << effect (effects.h): effects that are left out */
    uint32_t on;    /* the same: that are looked for though nothing calls for them: results are the
                       same, and take longer */
    scene_measures measures;
} scene_options;

/* Builds the scene of a study into a. NULL, with *err naming file and place. What is left out or
 * looks like a mistake (a luminaire outside the room) is noticed. */
const scene *scene_new(arena *a, const study *s, const scene_options *o, notices *n,
                       lux_error *err);

/* Whether anything gives light at all. */
bool scene_is_lit(const scene *s);

/* In words, why the scene is to be computed in colour; NULL: all surfaces and all light are grey,
 * to the bit. What pictures and measured tables hold is taken for coloured. */
const char *scene_colored_by(const scene *s);

/* Lamps that are no suns. */
static inline int scene_lamp_count(const scene *s) { return s->light_count - s->sun_count; }

/* What is left of the light of lamp l, or (l >= light_count) of glowing surfaces, when cleaning is
 * due; all of daylight. */
static inline double scene_maintenance(const scene *s, int l)
{
    return l < s->light_count && s->light_info[l].sun ? 1.0 : s->study->maintenance;
}

/* By which a layered scene's light of that group is multiplied in the sum of all. */
float scene_dimming_of_group(const scene *s, int group);

/* What glowing surfaces send out from both sides, dimmed, lm. */
double scene_glow_lumens(const scene *s);

/* Whether lamps that are `clear` are seen from a place of the user's frame, whatever they are. */
bool scene_is_in_room(const scene *s, dvec3 p);

/* A place of the user's frame in the scene's. */
static inline vec3 scene_place(const scene *s, dvec3 p)
{
    return d3_to_float(d3_sub(p, s->centre));
}

#endif
