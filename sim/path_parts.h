/* sim/path_parts.h -- what the files of path.h share: path_tracer.c chooses the kernel, and of each
 * (path_kernel.h) path.c moves the paths, path_light.c adds up the light of lamps and glowing
 * surfaces that they find, path_sky.c that of skies, path_sun.c that of suns, path_patch.c that of
 * the patches that those light through portals, path_mirror.c what comes by way of plane mirrors,
 * path_map.c what illumination maps know.
 */
#ifndef SIM_PATH_PARTS_H
#define SIM_PATH_PARTS_H

#include "core/without.h"
#include "sim/direct.h"
#include "sim/lamp_boxes.h"
#include "sim/path.h"
#include "sim/path_kernel.h"
#include "sim/shadow.h"

enum { PACKETS = PATHS / LANES };

/* What a living path carries; vectors are three fields. Those that a scene does not need come last
 * and are left out. */
enum {
    WORTH        = 0,            /* by channel, 1 at the beginning; of one channel the last */
    PLACE        = WORTH + 3,    /* m: where its ray begins */
    WAY          = PLACE + 3,    /* unit: the ray's direction */
    PLAIN_FIELDS = WAY + 3,      /* the next where rays find light: */
    LEFT         = PLAIN_FIELDS, /* m: where the path was last, straight passages apart */
    SIDE         = LEFT + 3,     /* the normal there */
    PDF = SIDE + 3, /* 1/sr, with which it left in its direction: what it then finds that glows
                       has been asked for too. INFINITY: it has not; ALREADY: by that alone */
    LAMP_PDF,       /* the same, of lamps */
    BASE,           /* m: where it last went off in a direction drawn from many; the next where
                       there are mirror images */
    BASE_SIDE = BASE + 3,      /* the normal there */
    BASE_PDF  = BASE_SIDE + 3, /* 1/sr, of that direction */
    FARTHER,            /* m: where it was before that; the next two where suns light patches */
    ONTO = FARTHER + 3, /* 1/m^2: with which it came from there to where it was last; 0: it came
                           along a single direction, or began there */
    WIDTH,              /* m, of the beam; the next where there are textures */
    SPREAD,             /* rad, of the beam */
    FIELDS
};
#define ALREADY (-1.0f)

/* Those of this kernel. */
enum { CHANNELS = COLOR ? 3 : 1, FIRST_FIELD = WORTH + 3 - CHANNELS };

/* Of a living path, bits. */
enum {
    SCATTERED = 1,   /* it has left its beginning other than straight on */
    AROUND    = 2,   /* where it was last, light from below the horizon counts */
    PASSED    = 4,   /* it has gone straight on through something since */
    WIDE      = 8,   /* some direction of it was drawn from many */
    OUTDOORS  = 16,  /* the first surface that it met is outside */
    NOWHERE   = 32,  /* its base is its beginning */
    ALL_ROUND = 64,  /* at its base light from below the horizon counted */
    BENT      = 128, /* it has entered a plate of glass, which shadow rays have passed straight */
    FOCUSED   = 256, /* it has met what focuses: lamps that it meets are for maps */
    GLOSSY    = 512, /* a direction of it was last drawn from many where no map is asked */
};

/* Alike in all kernels. */
struct path_tracer {
    const scene *s;
    int kernel; /* by which paths are followed: bits of what that leaves out */
    const path_options *o;
    direct_scratch *direct;
    seen_lamps shown;                           /* lamps that rays may find */
    const lamp_boxes *boxes;                    /* of those */
    const sun_patches *patches;                 /* NULL: no sun comes in by a portal */
    const illumination_map *indirect, *focused; /* NULL */
    bool leaves_focused;                        /* to others, as if `focused` were there */
    int32_t *list;                              /* room for as many */
    int64_t ray_count;
    path_bundle *b;
    int alive, fields;  /* of those below that are carried */
    uint32_t depth;     /* of where they stand: vertices behind them */
    float first[PATHS]; /* sr: response / pdf of each path's first direction; from the eye 1 */

    /* Of each living path: whose it is, bits, what it carries */
    int32_t id[PATHS], state[PATHS];
    int32_t image[PATHS]; /* of scene.mirror_images: the mirrors between its base and here; -1: it
                             has come otherwise */
    float carried[FIELDS][PATHS];

    /* And what it has met */
    int32_t instance[PATHS], triangle[PATHS];
    float distance[PATHS], u[PATHS], v[PATHS];

    /* Of one step, by packet: where the paths stand */
    vsurface at[PACKETS];
    vshading shading[PACKETS];
    vmask active[PACKETS], asks[PACKETS], around[PACKETS];
    vmask ends[PACKETS]; /* here by a map: what is asked for has no other way of being found */
    vint does[PACKETS];
    vsample4 sample[PACKETS], light_sample[PACKETS];
    direct_pick lights[PACKETS];
    vray rays[PACKETS];
    vhit hits[PACKETS];

    /* And shadow rays that are not asked by way of `direct` */
    vmask asked[PACKETS], blocked[PACKETS];
    vpassed passed[PACKETS];
    vint nobody[PACKETS]; /* 0: of world_any_hit's `spare` */
    vint spare[PACKETS];
};

/* What the scene has of what this kernel knows. */
static inline bool has_narrow(const scene *s) { return SURFACES && HAS_MIRRORS && s->narrow; }
static inline bool has_hollow(const scene *s) { return SURFACES && HAS_MIRRORS && s->hollow; }
static inline bool has_smooth(const scene *s) { return SURFACES && s->smooth; }
static inline bool has_textures(const scene *s) { return SURFACES && HAS_TEXTURES && s->textured; }
static inline bool has_exteriors(const scene *s) { return SURFACES && s->exteriors; }
static inline bool has_mirror_images(const scene *s)
{
    return SURFACES && HAS_MIRRORS && s->mirror_images;
}
static inline bool has_skies(const scene *s) { return HAS_DAYLIGHT && s->sky_count > 0; }
static inline bool has_suns(const scene *s) { return HAS_DAYLIGHT && s->sun_count > 0; }
static inline bool has_patches(const path_tracer *t) { return HAS_DAYLIGHT && t->patches; }

static inline int packets_of(const path_tracer *t) { return (t->alive + LANES - 1) / LANES; }

static inline vmask living(const path_tracer *t, int k)
{
    return (vlane_index() + k * LANES) < t->alive;
}

static inline vfloat load(const path_tracer *t, int field, int k)
{
    return vload(t->carried[field] + k * LANES);
}

static inline void store(path_tracer *t, int field, int k, vfloat v)
{
    vstore(t->carried[field] + k * LANES, v);
}

static inline vvec3 load3(const path_tracer *t, int field, int k)
{
    return (vvec3){ load(t, field, k), load(t, field + 1, k), load(t, field + 2, k) };
}

static inline void store3(path_tracer *t, int field, int k, vvec3 v)
{
    store(t, field, k, v.x);
    store(t, field + 1, k, v.y);
    store(t, field + 2, k, v.z);
}

/* The channels of this kernel: of a grey scene the first stands for all. */
static inline vrgb as_known(vrgb all) { return COLOR ? all : (vrgb){ all.x, all.x, all.x }; }

static inline vrgb worth_of(const path_tracer *t, int k)
{
    vfloat last = load(t, WORTH + 2, k);
    return COLOR ? load3(t, WORTH, k) : (vrgb){ last, last, last };
}

static inline void store_worth(path_tracer *t, int k, vrgb worth)
{
    if (COLOR)
        store3(t, WORTH, k, worth);
    else
        store(t, WORTH + 2, k, worth.x);
}

static inline vmask state_has(const path_tracer *t, int k, int bit)
{
    return (vload_int(t->state + k * LANES) & bit) != 0;
}

/* Where surfaces have normals other than their own: not what would pass through an opaque one. */
static inline vmask on_one_side(const vshading *s, const vvec3 *wi)
{
    return (vdot(*wi, s->n) > 0.0f) == (vdot(*wi, s->flat) > 0.0f);
}

/* p_a^2 / (p_a^2 + p_b^2), and 1 where there is no other way, b = 0, even to a direction that is as
 * good as never drawn (Veach and Guibas, SIGGRAPH 1995). */
static inline vfloat power_heuristic(vfloat a, vfloat b)
{
    vfloat ratio = b / a;
    return vselect(b > 0.0f, 1.0f / (1.0f + ratio * ratio), vsplat(1.0f));
}

/* response / pdf of each path's first direction. */
static inline vfloat first_of(const path_tracer *t, int k)
{
    return vgather(t->first, vload_int(t->id + k * LANES));
}

/* Follows the paths of t->b from beginning to end. */
void path_follow(path_tracer *t);

/* Random numbers of packet k where it stands, besides those of others that `purpose` tells apart.
 */
vsample4 path_numbers(const path_tracer *t, int k, uint32_t purpose);
enum {
    OF_LIGHT     = ~0x0,
    OF_SKY       = 0x5c1e,
    OF_PATCH     = 0x9a7c,
    OF_SUN       = 0x50af,
    OF_IMAGE     = 0x316e,
    OF_SUN_IMAGE = 0x7d05,
};

/* The lanes of packet k in which it is the turn of number `which`: of any TURNS (a power of two)
 * that follow each other one has it, and each as often. Samples that follow each other mostly
 * agree. */
vmask path_in_turn(const path_tracer *t, int k, int which, uint32_t turns);

/* What asking for light that comes along wi is worth where packet k stands: by channel, response or
 * f cos, times what the path is worth. In *pdf the density with which the path's own ray would take
 * that direction, 1/sr. */
vrgb path_worth(const path_tracer *t, int k, const vvec3 *wi, bool beginning, vmask active,
                vfloat *pdf);

/* The normal by which light is chosen: none where light from all around counts. */
vvec3 path_horizon(const path_tracer *t, int k, bool beginning);

/* Where found light belongs. */
typedef struct path_layer {
    int group;
    float dimming; /* of its group, as the sums of all light have it */
    bool day;      /* it is daylight */
    bool ground;   /* it has been reflected outside */
    bool mirrored; /* it is of CLASS_MIRRORED */
} path_layer;

/* Adds what each path of packet k found, e; it came straight to those that `straight` says. */
void path_add(path_tracer *t, int k, vmask lanes, vmask straight, vrgb e, const path_layer *of);

/* Next-event estimation where the paths stand. */
void path_ask_lights(path_tracer *t, bool beginning);
void path_ask_sky(path_tracer *t, bool beginning);
void path_ask_suns(path_tracer *t, bool beginning);

/* The layer of light number l: a lamp, or (l >= light_count) a glowing surface. */
path_layer path_layer_of(const scene *s, int l);

/* Mirror images, where there are any (path_mirror.c): asked for where the paths stand; and what
 * light l (or that emitter, l < 0) that packet k meets by way of them counts. */
void path_ask_images(path_tracer *t, bool beginning);
vfloat path_image_share(const path_tracer *t, int k, int l, vint emitter, vmask seen);

/* The same light where it is met, and a path's base and mirrors as it goes on. */
void path_set_base(path_tracer *t, int k, vmask set, bool beginning, vvec3 place, vvec3 side,
                   vmask around, vfloat pdf);
static inline vint images_of(const path_tracer *t, int k)
{
    return vload_int(t->image + k * LANES);
}

/* Light that comes by way of sunlit patches, which paths find for themselves, too. */
void path_ask_patches(path_tracer *t, bool beginning);

/* How much the light of the sun of that number counts where packet k stands, if it has come by way
 * of what path_ask_patches() may have asked; wi: toward the sun. */
vfloat path_patch_share(const path_tracer *t, int k, int sun, const vvec3 *wi, vmask active);

/* Light that maps know where the paths stand; those that it is all for end there. */
void path_take_maps(path_tracer *t);

/* The density, 1/m^2, with which the paths' own rays have come to where packet k stands; 0 where
 * nothing else could have. */
vfloat path_onto(const path_tracer *t, int k, vmask active);

/* The sky, where the rays met nothing. */
void path_add_sky(path_tracer *t);

/* Lamps that the rays meet on their way. */
void path_add_lamps_met(path_tracer *t);

/* What shines by itself where the paths have come to. */
void path_add_glow(path_tracer *t);

/* Which paths see something that could give light back; once more at each step where there is glass
 * that they go through, or mirrors. */
void path_note_met(path_tracer *t);

#endif
