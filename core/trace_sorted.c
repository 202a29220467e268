/* core/trace_sorted.c -- see trace.h: rays that go anywhere, put into packets by direction.
 *
 * The four rays of a packet of bounces fall into 2.7 sets of signs on average, and so would walk
 * the trees 2.7 times. Those of a batch that share signs and largest component are packed
 * together instead: about twice as fast from 64 rays on, a little faster yet from 256.
 */
#include "core/trace.h"

enum { CHUNK = 256 / LANES, RAYS = CHUNK * LANES }; /* sorted at a time, on the stack */

/* Rays of a chunk, and how they are put in order. */
typedef struct chunk {
    float o[3][RAYS], d[3][RAYS], reach[RAYS];
    int32_t code[RAYS], order[RAYS + LANES]; /* a last packet may be read beyond the end */
    int live;                                /* of the order; behind them, the inactive ones */
} chunk;

static void chunk_fill(chunk *c, const vray *rays, const vmask *active, int packets)
{
    for (int i = 0; i < packets; i++) {
        const vray *r = &rays[i];
        int at        = i * LANES;
        vstore(c->o[0] + at, r->origin.x);
        vstore(c->o[1] + at, r->origin.y);
        vstore(c->o[2] + at, r->origin.z);
        vstore(c->d[0] + at, r->direction.x);
        vstore(c->d[1] + at, r->direction.y);
        vstore(c->d[2] + at, r->direction.z);
        vstore(c->reach + at, r->reach);
        vstore_int(c->code + at, vselect_int(active[i], direction_code(r->direction),
                                             vsplat_int(DIRECTION_CODES)));
    }
}

/* A counting sort: it leaves rays of one code as they were, neighbours near each other. */
static void chunk_sort(chunk *c, int packets)
{
    int first[DIRECTION_CODES + 2] = { 0 };
    for (int i = 0; i < packets * LANES; i++)
        first[c->code[i] + 1]++;
    for (int k = 0; k <= DIRECTION_CODES; k++)
        first[k + 1] += first[k];
    c->live = first[DIRECTION_CODES];
    for (int i = 0; i < packets * LANES; i++)
        c->order[first[c->code[i]]++] = i;
    for (int k = 0; k < LANES; k++)
        c->order[packets * LANES + k] = 0;
}

/* The packet that begins at `at` in the order; how many rays it has. */
static int chunk_packet(const chunk *c, int at, vray *ray, vmask *active)
{
    int32_t code = c->code[c->order[at]];
    int count    = 1;
    while (count < LANES && at + count < c->live && c->code[c->order[at + count]] == code)
        count++;
    vint from = vload_int(c->order + at);
    *ray      = (vray){ { vgather(c->o[0], from), vgather(c->o[1], from), vgather(c->o[2], from) },
                        { vgather(c->d[0], from), vgather(c->d[1], from), vgather(c->d[2], from) },
                        vgather(c->reach, from) };
    *active   = vlane_index() < vsplat_int(count);
    return count;
}

/* Hits, where their rays were. */
typedef struct found {
    float t[RAYS], u[RAYS], v[RAYS];
    int32_t instance[RAYS], triangle[RAYS];
} found;

static void chunk_first(const world *w, chunk *c, found *f)
{
    int count;
    for (int at = 0; at < c->live; at += count) {
        vray ray;
        vmask active;
        vhit h;
        count = chunk_packet(c, at, &ray, &active);
        trace_packet_first(w, &ray, active, &h);
        for (int i = 0; i < count; i++) {
            int32_t to      = c->order[at + i];
            f->t[to]        = lane(h.distance, i);
            f->u[to]        = lane(h.u, i);
            f->v[to]        = lane(h.v, i);
            f->instance[to] = lane(h.instance, i);
            f->triangle[to] = lane(h.triangle, i);
        }
    }
}

void trace_sorted_first(const world *w, const vray *rays, const vmask *active, int packets,
                        vhit *hits)
{
    chunk c;
    found f;
    for (int i = 0; i < packets; i += CHUNK) {
        int some = packets - i < CHUNK ? packets - i : CHUNK;
        chunk_fill(&c, rays + i, active + i, some);
        chunk_sort(&c, some);
        for (int k = c.live; k < some * LANES; k++) { /* misses */
            int32_t to = c.order[k];
            f.t[to]    = INFINITY;
            f.u[to] = f.v[to] = 0.0f;
            f.instance[to] = f.triangle[to] = -1;
        }
        chunk_first(w, &c, &f);
        for (int k = 0; k < some; k++) {
            int at      = k * LANES;
            hits[i + k] = (vhit){ vload(f.t + at), vload_int(f.instance + at),
                                  vload_int(f.triangle + at), vload(f.u + at), vload(f.v + at) };
        }
    }
}

void trace_sorted_any(const world *w, const vray *rays, const vmask *active, const vint *spare,
                      int packets, vmask *blocked)
{
    chunk c;
    for (int i = 0; i < packets; i += CHUNK) {
        int some = packets - i < CHUNK ? packets - i : CHUNK;
        chunk_fill(&c, rays + i, active + i, some);
        chunk_sort(&c, some);

        int32_t met[RAYS] = { 0 }, spared[RAYS];
        int count;
        for (int k = 0; spare && k < some; k++)
            vstore_int(spared + k * LANES, spare[i + k]);
        for (int at = 0; at < c.live; at += count) {
            vray ray;
            vmask there;
            count    = chunk_packet(&c, at, &ray, &there);
            vint own = spare ? vgather_int(spared, vload_int(c.order + at)) : vsplat_int(0);
            int bits = vbits(trace_packet_any(w, &ray, there, own));
            for (int k = 0; k < count; k++)
                met[c.order[at + k]] = bits >> k & 1;
        }
        for (int k = 0; k < some; k++)
            blocked[i + k] = vload_int(met + k * LANES) != vsplat_int(0);
    }
}
