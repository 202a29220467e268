/* core/trace_packet.c -- see trace.h: a packet of rays goes down the trees together.
 *
 * Lanes go together as long as they see the children of every node in the same order: a packet
 * is walked once for each set of direction signs that it holds, in the upper tree and again in
 * each mesh (where the instance may have turned the rays). A lane is in a node as long as its
 * near distance is not beyond its far one; what a lane does never depends on the others.
 */
#include "core/triangle_test.h"

#include <float.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

/* ---- down a tree ---------------------------------------------------------------------------- */

/* Rays as a tree sees them: a plane at x is crossed between x * inverse - later and
 * x * inverse - sooner, its width included. */
typedef struct vslab {
    vfloat inverse, later, sooner;
} vslab;

typedef struct vslabs {
    vslab axis[3];
    vfloat near, far; /* where in the box */
    uint32_t back[3]; /* how far, in bytes, the first child is behind the lower: 0, or a node */
} vslabs;

INLINE vslab slab_make(vfloat o, vfloat d, vfloat least, vfloat width)
{
    vfloat inverse = 1.0f / vcopysign(vmax(vabs(d), least), d);
    vfloat w       = width * vabs(inverse);
    vfloat middle  = o * inverse;
    return (vslab){ inverse, middle + w, middle - w };
}

INLINE void slab_cut(vslabs *s, int axis, float low, float high)
{
    const vslab *a = &s->axis[axis];
    float first = s->back[axis] ? high : low, last = s->back[axis] ? low : high;
    s->near = vmax(first * a->inverse - a->later, s->near);
    s->far  = vmin(last * a->inverse - a->sooner, s->far);
}

INLINE vfloat largest(vvec3 a) { return vmax(vabs(a.x), vmax(vabs(a.y), vabs(a.z))); }

/* The lanes of active, which agree in their signs, in the tree's box. */
INLINE vslabs slabs_make(const bsp *b, vvec3 o, vvec3 d, unsigned signs, vmask active, vfloat far)
{
    vfloat width = TRACE_WIDTH * vmax(largest(o), vsplat(b->largest));
    vfloat least = 0x1p-64f * largest(d); /* so that no inverse is infinite */
    vslabs s     = { .axis = { slab_make(o.x, d.x, least, width), slab_make(o.y, d.y, least, width),
                               slab_make(o.z, d.z, least, width) } };
    for (int k = 0; k < 3; k++)
        s.back[k] = signs >> k & 1 ? sizeof(bsp_node) : 0;

    s.near = vselect(active, vsplat(0.0f), vsplat(INFINITY));
    s.far  = vselect(active, far, vsplat(-INFINITY));
    slab_cut(&s, 0, b->low.x, b->high.x);
    slab_cut(&s, 1, b->low.y, b->high.y);
    slab_cut(&s, 2, b->low.z, b->high.z);
    return s;
}

typedef struct later {
    vfloat near, far;
    const bsp_node *node;
} later;

/* Calls leaf(context, items, count, lanes) for the leaves that rays pass, each ray's from near
 * to far, until its far is beyond *limit, which leaf may lower. */
typedef void leaf_fn(void *context, const uint32_t *items, uint32_t count, vmask inside);

INLINE void walk(const bsp *b, const vslabs *s, const vfloat *limit, leaf_fn *leaf, void *context)
{
    later stack[BSP_STACK], *top = stack;
    const char *nodes    = (const char *)b->nodes;
    const bsp_node *node = b->nodes;
    vfloat near = s->near, far = s->far;
    if (!vany(near <= far))
        return;
    for (;;) {
        uint32_t axis;
        while ((axis = node->link & 3) != BSP_LEAF) {
            const vslab *a = &s->axis[axis];
            vfloat at      = node->split * a->inverse;
            vfloat enter   = vmax(at - a->later, near); /* the second child */
            vfloat leave   = vmin(at - a->sooner, far); /* the first child */
            vmask first    = near <= leave;
            vmask second   = enter <= far;

            uint32_t child        = (node->link ^ axis) + s->back[axis];
            const bsp_node *other = (const bsp_node *)(nodes + (child ^ sizeof(bsp_node)));
            node                  = (const bsp_node *)(nodes + child);
            if (!vany(second)) {
                far = leave;
            } else if (!vany(first)) {
                node = other;
                near = enter;
            } else {
                *top++ = (later){ enter, far, other };
                far    = leave;
            }
        }
        if (node->link >> 2)
            leaf(context, b->items + node->first, node->link >> 2, near <= far);
        do {
            if (top == stack)
                return;
            top--;
            near = top->near;
            far  = vmin(*limit, top->far);
        } while (!vany(near <= far));
        node = top->node;
    }
}

/* ---- what is asked -------------------------------------------------------------------------- */

typedef struct query {
    const world *w;
    const vray *ray;
    vfloat limit; /* farther is of no use; -INFINITY: nothing is */
    vint spare;   /* instances of this owner are not there; 0: all are */
    vint instance, triangle;
    vfloat u, v;
    hit_list *list;
    uint32_t wary;   /* some rays do not see instances of these traits */
    uint32_t hollow; /* ALL_HITS: instances of these traits are gone through */
} query;

/* One mesh, one set of signs. */
typedef struct pass {
    query *q;
    const solid *mesh;
    vshear shear;
    size_t axis[3];    /* of the shear's x, y, z */
    vfloat o[5], d[5]; /* x y z x y, for the projection test */
    int32_t instance;
    uint32_t traits; /* of the instance */
} pass;

INLINE void accept(query_kind kind, pass *p, uint32_t triangle, vmask in, const vmeet *m)
{
    query *q = p->q;
    if (kind == ANY_HIT) {
        q->limit = vselect(in & (m->t < q->limit), vsplat(-INFINITY), q->limit);
    } else if (kind == FIRST_HIT) {
        vint instance = vsplat_int(p->instance), number = vsplat_int((int32_t)triangle);
        vmask lower =
            (instance < q->instance) | ((instance == q->instance) & (number < q->triangle));
        in &= (m->t < q->limit) | lower;
        q->limit    = vselect(in, m->t, q->limit);
        q->instance = vselect_int(in, instance, q->instance);
        q->triangle = vselect_int(in, number, q->triangle);
        q->u        = vselect(in, m->u, q->u);
        q->v        = vselect(in, m->v, q->v);
    } else {
        float limit[LANES];
        vstore(limit, q->limit);
        in &= m->t < q->ray->reach;
        for (int i = 0; i < LANES; i++) {
            if (!(vbits(in) >> i & 1))
                continue;
            one_hit h = { lane(m->t, i), lane(m->u, i),     lane(m->v, i),
                          p->instance,   (int32_t)triangle, p->traits & q->hollow };
            hit_list_add(q->list, i, &h);
            if (!h.hollow && h.t < limit[i])
                limit[i] = h.t;
        }
        q->limit = vload(limit);
    }
}

INLINE vcorners corners_of(const pass *p, uint32_t triangle)
{
    const float *c = p->mesh->corners + (size_t)9 * triangle;
    const float *x = c + p->axis[0];
    const float *y = c + p->axis[1];
    const float *z = c + p->axis[2];
    return (vcorners){ { vsplat(x[0]), vsplat(y[0]), vsplat(z[0]) },
                       { vsplat(x[3]), vsplat(y[3]), vsplat(z[3]) },
                       { vsplat(x[6]), vsplat(y[6]), vsplat(z[6]) } };
}

static __attribute__((noinline)) vmask test_rare(const pass *p, uint32_t triangle, vmask inside,
                                                 vmeet *m)
{
    vcorners c = corners_of(p, triangle);
    return watertight_rare(&p->shear, &c, inside, m);
}

INLINE vmask test_watertight(const pass *p, uint32_t triangle, vmask inside, vmeet *m)
{
    vmask rare;
    vcorners c = corners_of(p, triangle);
    vmask in   = watertight_line(&p->shear, &c, inside, m, &rare);
    if (__builtin_expect(vany(rare), 0)) {
        vmeet anew; /* *m stays in registers */
        in = test_rare(p, triangle, inside, &anew);
        *m = anew;
    }
    return in;
}

INLINE vmask test_projection(const pass *p, uint32_t triangle, vmask inside, vmeet *m)
{
    const projection *t = &p->mesh->projections[triangle];
    vprojection s       = { vsplat(t->n_u), vsplat(t->n_v), vsplat(t->n_d),
                            vsplat(t->b_u), vsplat(t->b_v), vsplat(t->b_d),
                            vsplat(t->c_u), vsplat(t->c_v), vsplat(t->c_d) };
    vaxes r             = { { p->o[t->k], p->o[t->k + 1], p->o[t->k + 2] },
                            { p->d[t->k], p->d[t->k + 1], p->d[t->k + 2] } };
    return projection_line(&r, &s, inside, m);
}

INLINE void triangle_leaf(query_kind kind, bool watertight, pass *p, const uint32_t *items,
                          uint32_t count, vmask inside)
{
    for (uint32_t i = 0; i < count; i++) {
        vmeet m;
        vmask in = watertight ? test_watertight(p, items[i], inside, &m)
                              : test_projection(p, items[i], inside, &m);
        if (!vany(in))
            continue;
        in = meet_within(&m, in, p->q->limit);
        if (!vany(in))
            continue;
        accept(kind, p, items[i], in, &m);
        if (kind == ANY_HIT) { /* blocked is blocked, wherever */
            inside &= p->q->limit > -INFINITY;
            if (!vany(inside))
                return;
        }
    }
}

/* A leaf of triangles for each query and test: each is a walk of its own. */
#define TRIANGLE_LEAF(name, kind, watertight)                                                      \
    static inline void name(void *p, const uint32_t *items, uint32_t count, vmask inside)          \
    {                                                                                              \
        triangle_leaf(kind, watertight, p, items, count, inside);                                  \
    }                                                                                              \
    static void name##_walk(pass *p, const vslabs *s)                                              \
    {                                                                                              \
        walk(&p->mesh->tree, s, &p->q->limit, name, p);                                            \
    }
TRIANGLE_LEAF(first_watertight, FIRST_HIT, true)
TRIANGLE_LEAF(any_watertight, ANY_HIT, true)
TRIANGLE_LEAF(all_watertight, ALL_HITS, true)
TRIANGLE_LEAF(first_projection, FIRST_HIT, false)
TRIANGLE_LEAF(any_projection, ANY_HIT, false)
TRIANGLE_LEAF(all_projection, ALL_HITS, false)

typedef void walk_fn(pass *p, const vslabs *s);
static walk_fn *const walks[2][3] = {
    { first_watertight_walk, any_watertight_walk, all_watertight_walk },
    { first_projection_walk, any_projection_walk, all_projection_walk },
};

/* ---- groups --------------------------------------------------------------------------------- */

static void walk_mesh(pass *p, query_kind kind, vvec3 o, vvec3 d, vmask lanes)
{
    p->o[0] = p->o[3] = o.x, p->o[1] = p->o[4] = o.y, p->o[2] = o.z;
    p->d[0] = p->d[3] = d.x, p->d[1] = p->d[4] = d.y, p->d[2] = d.z;

    vint code = direction_code(d);
    int left  = vbits(lanes);
    while (left) {
        int32_t mine = lane(code, __builtin_ctz((unsigned)left));
        vmask group  = lanes & (code == vsplat_int(mine));
        left &= ~vbits(group);

        size_t z   = (size_t)mine >> 3;
        p->axis[2] = z, p->axis[0] = (z + 1) % 3, p->axis[1] = (z + 2) % 3;
        for (int k = 0; k < 3; k++)
            p->shear.o[k] = p->o[p->axis[k]];
        p->shear.s[0] = p->d[z + 1] / p->d[z];
        p->shear.s[1] = p->d[z + 2] / p->d[z];
        p->shear.s[2] = 1.0f / p->d[z];
        p->shear.near = shear_near(p->shear.s[2], p->mesh->tree.largest);
        vslabs s      = slabs_make(&p->mesh->tree, o, d, (unsigned)mine & 7, group, p->q->limit);
        walks[p->q->w->test == TRIANGLE_PROJECTION][kind](p, &s);
    }
}

/* ---- instances ------------------------------------------------------------------------------ */

INLINE vvec3 turned(const float m[3][4], vvec3 a)
{
    return (vvec3){ m[0][0] * a.x + m[0][1] * a.y + m[0][2] * a.z,
                    m[1][0] * a.x + m[1][1] * a.y + m[1][2] * a.z,
                    m[2][0] * a.x + m[2][1] * a.y + m[2][2] * a.z };
}

/* The lanes that see an instance of a trait that the query is wary of. */
static vmask seeing(const query *q, query_kind kind, const placed *at)
{
    if (at->traits & (kind == ALL_HITS ? TRAIT_SOLID : TRAIT_HOLLOW))
        return ~ALL_LANES;
    return ~(q->spare == vsplat_int(at->owner));
}

static void walk_instance(query *q, query_kind kind, uint32_t number, vmask lanes)
{
    const placed *at = &q->w->instances[number];
    if (at->traits & q->wary) {
        lanes &= seeing(q, kind, at);
        if (!vany(lanes))
            return;
    }
    pass p; /* not cleared, as an initialiser would: walk_mesh fills in the rest */
    p.q        = q;
    p.mesh     = &q->w->meshes[at->mesh];
    p.instance = (int32_t)number;
    p.traits   = at->traits;
    if (at->identity) {
        walk_mesh(&p, kind, q->ray->origin, q->ray->direction, lanes);
    } else {
        vvec3 o    = turned(at->to_mesh, q->ray->origin);
        vvec3 move = { vsplat(at->to_mesh[0][3]), vsplat(at->to_mesh[1][3]),
                       vsplat(at->to_mesh[2][3]) };
        walk_mesh(&p, kind, vadd(o, move), turned(at->to_mesh, q->ray->direction), lanes);
    }
}

typedef struct upper {
    query *q;
    query_kind kind;
    uint32_t instance[MAILBOXES]; /* number + 1 */
    vmask done[MAILBOXES];
} upper;

static void instance_leaf(void *context, const uint32_t *items, uint32_t count, vmask inside)
{
    upper *u = context;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t box = items[i] % MAILBOXES;
        vmask left   = inside;
        if (u->instance[box] == items[i] + 1) {
            left &= ~u->done[box];
            u->done[box] |= inside;
        } else {
            u->instance[box] = items[i] + 1;
            u->done[box]     = inside;
        }
        if (vany(left))
            walk_instance(u->q, u->kind, items[i], left);
    }
}

static void walk_world(query *q, query_kind kind, vmask active)
{
    const bsp *top = &q->w->tree;
    if ((top->nodes->link & 3) == BSP_LEAF) {
        for (uint32_t i = 0; i < top->nodes->link >> 2; i++)
            walk_instance(q, kind, top->items[i], active);
        return;
    }
    vint code = direction_code(q->ray->direction) & vsplat_int(7);
    int left  = vbits(active);
    while (left) {
        int32_t mine = lane(code, __builtin_ctz((unsigned)left));
        vmask group  = active & (code == vsplat_int(mine));
        left &= ~vbits(group);
        upper u = { .q = q, .kind = kind };
        vslabs s =
            slabs_make(top, q->ray->origin, q->ray->direction, (unsigned)mine, group, q->limit);
        walk(top, &s, &q->limit, instance_leaf, &u);
    }
}

/* ---- queries -------------------------------------------------------------------------------- */

static query query_make(const world *w, const vray *ray, vmask active)
{
    vfloat most = vmin(ray->reach, vsplat(FLT_MAX)); /* what is infinitely far is not there */
    return (query){ .w        = w,
                    .ray      = ray,
                    .limit    = vselect(active, most, vsplat(-INFINITY)),
                    .instance = vsplat_int(-1),
                    .triangle = vsplat_int(-1) };
}

void trace_packet_first(const world *w, const vray *ray, vmask active, vhit *hit)
{
    query q = query_make(w, ray, active);
    walk_world(&q, FIRST_HIT, active);
    vmask met     = q.instance >= vsplat_int(0);
    hit->distance = vselect(met, q.limit, vsplat(INFINITY));
    hit->instance = q.instance;
    hit->triangle = q.triangle;
    hit->u        = q.u;
    hit->v        = q.v;
}

vmask trace_packet_any(const world *w, const vray *ray, vmask active, vint spare)
{
    query q = query_make(w, ray, active);
    q.spare = spare;
    q.wary  = TRAIT_OWNED | TRAIT_HOLLOW;
    walk_world(&q, ANY_HIT, active);
    return active & (q.limit < 0.0f);
}

void trace_packet_all(const world *w, const vray *ray, vmask active, vint spare, hit_list *list)
{
    query q  = query_make(w, ray, active);
    q.list   = list;
    q.spare  = spare;
    q.wary   = list->kind == LIST_HOLLOW ? TRAIT_SOLID | TRAIT_OWNED : 0;
    q.hollow = list->kind == LIST_EVERY ? TRAIT_SOLID | TRAIT_HOLLOW : TRAIT_HOLLOW;
    walk_world(&q, ALL_HITS, active);
}
