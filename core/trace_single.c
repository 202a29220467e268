/* core/trace_single.c -- see trace.h: each ray goes down the trees alone, and is tested against
 * LANES triangles at once. For rays that go apart, which as packets would visit whatever any of
 * them does.
 *
 * Arithmetic on planes is that of trace_packet.c with one lane.
 */
#include "core/triangle_test.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

/* ---- down a tree ---------------------------------------------------------------------------- */

typedef struct slabs {
    float inverse[3], later[3], sooner[3];
    float near, far;
    unsigned back[3];
} slabs;

/* As vmin and vmax: b where either is NaN */
INLINE float least_of(float a, float b) { return a < b ? a : b; }
INLINE float most_of(float a, float b) { return a > b ? a : b; }
INLINE float largest(const float a[3])
{
    return most_of(fabsf(a[0]), most_of(fabsf(a[1]), fabsf(a[2])));
}

INLINE slabs slabs_make(const bsp *b, const float o[3], const float d[3], float far)
{
    const float low[3]  = { b->low.x, b->low.y, b->low.z };
    const float high[3] = { b->high.x, b->high.y, b->high.z };
    float width         = TRACE_WIDTH * most_of(largest(o), most_of(largest(low), largest(high)));
    float least         = 0x1p-64f * largest(d);
    slabs s             = { .near = 0.0f, .far = far };
    for (int k = 0; k < 3; k++) {
        s.inverse[k] = 1.0f / copysignf(most_of(fabsf(d[k]), least), d[k]);
        float w      = width * fabsf(s.inverse[k]);
        float middle = o[k] * s.inverse[k];
        s.later[k]   = middle + w;
        s.sooner[k]  = middle - w;
        s.back[k]    = signbit(d[k]) ? 1 : 0;
    }
    for (int k = 0; k < 3; k++) {
        float first = s.back[k] ? high[k] : low[k], last = s.back[k] ? low[k] : high[k];
        s.near = most_of(first * s.inverse[k] - s.later[k], s.near);
        s.far  = least_of(last * s.inverse[k] - s.sooner[k], s.far);
    }
    return s;
}

typedef struct later {
    float near, far;
    const bsp_node *node;
} later;

typedef void leaf_fn(void *context, const uint32_t *items, uint32_t count);

INLINE void walk(const bsp *b, const slabs *s, const float *limit, leaf_fn *leaf, void *context)
{
    later stack[BSP_STACK];
    later *top           = stack;
    const bsp_node *node = b->nodes;
    float near = s->near, far = s->far;
    if (!(near <= far))
        return;
    for (;;) {
        uint32_t axis;
        while ((axis = node->link & 3) != BSP_LEAF) {
            float at    = node->split * s->inverse[axis];
            float enter = most_of(at - s->later[axis], near);
            float leave = least_of(at - s->sooner[axis], far);

            const bsp_node *child = b->nodes + (node->link >> 2);
            const bsp_node *other = child + (s->back[axis] ^ 1);
            child += s->back[axis];
            if (!(enter <= far)) {
                node = child;
                far  = leave;
            } else if (!(near <= leave)) {
                node = other;
                near = enter;
            } else {
                *top++ = (later){ enter, far, other };
                node   = child;
                far    = leave;
            }
        }
        if (node->link >> 2)
            leaf(context, b->items + node->first, node->link >> 2);
        do {
            if (top == stack)
                return;
            top--;
            near = top->near;
            far  = least_of(*limit, top->far);
        } while (!(near <= far));
        node = top->node;
    }
}

/* ---- what is asked -------------------------------------------------------------------------- */

typedef struct query {
    const world *w;
    float origin[3], direction[3];
    float limit; /* farther is of no use; -INFINITY: nothing is */
    int32_t instance, triangle;
    float u, v;
} query;

typedef struct pass {
    query *q;
    const solid *mesh;
    vshear shear;
    int axis[3];
    float o[5], d[5]; /* x y z x y, for the projection test */
    int32_t instance;
} pass;

INLINE void accept(query_kind kind, pass *p, vint triangle, vmask in, const vmeet *m)
{
    query *q = p->q;
    for (unsigned left = (unsigned)vbits(in); left; left &= left - 1) {
        int i          = __builtin_ctz(left);
        float t        = lane(m->t, i);
        int32_t number = lane(triangle, i);
        bool lower =
            p->instance < q->instance || (p->instance == q->instance && number < q->triangle);
        if (!(t < q->limit || (kind == FIRST_HIT && t == q->limit && lower)))
            continue;
        q->instance = p->instance;
        q->triangle = number;
        q->limit    = kind == ANY_HIT ? -INFINITY : t;
        q->u        = lane(m->u, i);
        q->v        = lane(m->v, i);
    }
}

INLINE vmask test_triangles(const pass *p, bool watertight, vint triangle, vmask active, vmeet *m)
{
    vfloat limit = vsplat(p->q->limit);
    if (watertight) {
        const float *c  = p->mesh->corners;
        const float *x  = c + p->axis[0];
        const float *y  = c + p->axis[1];
        const float *z  = c + p->axis[2];
        vint at         = triangle * 9;
        vcorners corner = { { vgather(x, at), vgather(y, at), vgather(z, at) },
                            { vgather(x + 3, at), vgather(y + 3, at), vgather(z + 3, at) },
                            { vgather(x + 6, at), vgather(y + 6, at), vgather(z + 6, at) } };
        return watertight_test(&p->shear, &corner, active, limit, m);
    }
    float numbers[9][LANES], o[3][LANES], d[3][LANES];
    for (int i = 0; i < LANES; i++) {
        const projection *t  = &p->mesh->projections[lane(triangle, i)];
        const float these[9] = { t->n_u, t->n_v, t->n_d, t->b_u, t->b_v,
                                 t->b_d, t->c_u, t->c_v, t->c_d };
        for (int k = 0; k < 9; k++)
            numbers[k][i] = these[k];
        for (int k = 0; k < 3; k++) {
            o[k][i] = p->o[t->k + k];
            d[k][i] = p->d[t->k + k];
        }
    }
    vprojection s = { vload(numbers[0]), vload(numbers[1]), vload(numbers[2]),
                      vload(numbers[3]), vload(numbers[4]), vload(numbers[5]),
                      vload(numbers[6]), vload(numbers[7]), vload(numbers[8]) };
    vaxes r       = { { vload(o[0]), vload(o[1]), vload(o[2]) },
                      { vload(d[0]), vload(d[1]), vload(d[2]) } };
    return projection_test(&r, &s, active, limit, m);
}

INLINE void triangle_leaf(query_kind kind, bool watertight, pass *p, const uint32_t *items,
                          uint32_t count)
{
    for (uint32_t i = 0; i < count; i += LANES) {
        int32_t numbers[LANES];
        for (uint32_t k = 0; k < LANES; k++)
            numbers[k] = (int32_t)items[i + k < count ? i + k : count - 1];
        vint triangle = vload_int(numbers);
        vmask there   = vlane_index() < vsplat_int((int32_t)(count - i));
        vmeet m;
        vmask in = test_triangles(p, watertight, triangle, there, &m);
        if (vany(in))
            accept(kind, p, triangle, in, &m);
    }
}

#define TRIANGLE_LEAF(name, kind, watertight)                                                      \
    static inline void name(void *p, const uint32_t *items, uint32_t count)                        \
    {                                                                                              \
        triangle_leaf(kind, watertight, p, items, count);                                          \
    }                                                                                              \
    static void name##_walk(pass *p, const slabs *s)                                               \
    {                                                                                              \
        walk(&p->mesh->tree, s, &p->q->limit, name, p);                                            \
    }
TRIANGLE_LEAF(first_watertight, FIRST_HIT, true)
TRIANGLE_LEAF(any_watertight, ANY_HIT, true)
TRIANGLE_LEAF(first_projection, FIRST_HIT, false)
TRIANGLE_LEAF(any_projection, ANY_HIT, false)

typedef void walk_fn(pass *p, const slabs *s);
static walk_fn *const walks[2][2] = {
    { first_watertight_walk, any_watertight_walk },
    { first_projection_walk, any_projection_walk },
};

/* ---- instances ------------------------------------------------------------------------------ */

static void walk_mesh(pass *p, query_kind kind, const float o[3], const float d[3])
{
    float x = fabsf(d[0]), y = fabsf(d[1]), z = fabsf(d[2]);
    int longest = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    for (int k = 0; k < 5; k++) {
        p->o[k] = o[k % 3];
        p->d[k] = d[k % 3];
    }
    p->axis[2] = longest, p->axis[0] = (longest + 1) % 3, p->axis[1] = (longest + 2) % 3;
    for (int k = 0; k < 3; k++)
        p->shear.o[k] = vsplat(o[p->axis[k]]);
    p->shear.s[0] = vsplat(p->d[longest + 1] / d[longest]);
    p->shear.s[1] = vsplat(p->d[longest + 2] / d[longest]);
    p->shear.s[2] = vsplat(1.0f / d[longest]);
    slabs s       = slabs_make(&p->mesh->tree, o, d, p->q->limit);
    walks[p->q->w->test == TRIANGLE_PROJECTION][kind](p, &s);
}

static void walk_instance(query *q, query_kind kind, uint32_t number)
{
    const placed *at = &q->w->instances[number];
    pass p           = { .q = q, .mesh = &q->w->meshes[at->mesh], .instance = (int32_t)number };
    if (at->identity) {
        walk_mesh(&p, kind, q->origin, q->direction);
        return;
    }
    float o[3], d[3];
    for (int i = 0; i < 3; i++) {
        const float *m = at->to_mesh[i];
        o[i]           = m[0] * q->origin[0] + m[1] * q->origin[1] + m[2] * q->origin[2] + m[3];
        d[i]           = m[0] * q->direction[0] + m[1] * q->direction[1] + m[2] * q->direction[2];
    }
    walk_mesh(&p, kind, o, d);
}

typedef struct upper {
    query *q;
    query_kind kind;
    uint32_t done[MAILBOXES]; /* number of the instance, + 1 */
} upper;

static void instance_leaf(void *context, const uint32_t *items, uint32_t count)
{
    upper *u = context;
    for (uint32_t i = 0; i < count; i++) {
        if (u->done[items[i] % MAILBOXES] == items[i] + 1)
            continue;
        u->done[items[i] % MAILBOXES] = items[i] + 1;
        walk_instance(u->q, u->kind, items[i]);
    }
}

static void walk_world(query *q, query_kind kind)
{
    const bsp *top = &q->w->tree;
    if ((top->nodes->link & 3) == BSP_LEAF) {
        for (uint32_t i = 0; i < top->nodes->link >> 2; i++)
            walk_instance(q, kind, top->items[i]);
        return;
    }
    upper u = { .q = q, .kind = kind };
    slabs s = slabs_make(top, q->origin, q->direction, q->limit);
    walk(top, &s, &q->limit, instance_leaf, &u);
}

/* ---- queries -------------------------------------------------------------------------------- */

static query query_make(const world *w, const vray *ray, int i)
{
    return (query){ .w         = w,
                    .origin    = { lane(ray->origin.x, i), lane(ray->origin.y, i),
                                   lane(ray->origin.z, i) },
                    .direction = { lane(ray->direction.x, i), lane(ray->direction.y, i),
                                   lane(ray->direction.z, i) },
                    .limit     = least_of(lane(ray->reach, i), FLT_MAX),
                    .instance  = -1,
                    .triangle  = -1 };
}

void trace_single_first(const world *w, const vray *ray, vmask active, vhit *hit)
{
    float t[LANES], u[LANES] = { 0 }, v[LANES] = { 0 };
    int32_t instance[LANES], triangle[LANES];
    for (int i = 0; i < LANES; i++) {
        instance[i] = triangle[i] = -1;
        t[i]                      = INFINITY;
        if (!(vbits(active) >> i & 1))
            continue;
        query q = query_make(w, ray, i);
        walk_world(&q, FIRST_HIT);
        if (q.instance < 0)
            continue;
        t[i] = q.limit, u[i] = q.u, v[i] = q.v;
        instance[i] = q.instance, triangle[i] = q.triangle;
    }
    *hit = (vhit){ vload(t), vload_int(instance), vload_int(triangle), vload(u), vload(v) };
}

void trace_single_any(const world *w, const vray *ray, vmask active, vmask *blocked)
{
    *blocked = ~ALL_LANES;
    for (int i = 0; i < LANES; i++) {
        if (!(vbits(active) >> i & 1))
            continue;
        query q = query_make(w, ray, i);
        walk_world(&q, ANY_HIT);
        if (q.instance >= 0)
            *blocked |= vlane_index() == vsplat_int(i);
    }
}
