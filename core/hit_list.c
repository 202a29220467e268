/* core/hit_list.c -- the hits of a packet in order: distance, then instance, then triangle. */
#include "core/trace.h"

static void put(vfloat *a, int i, float value)
{
    *a = vselect(vlane_index() == vsplat_int(i), vsplat(value), *a);
}

static void put_int(vint *a, int i, int32_t value)
{
    *a = vselect_int(vlane_index() == vsplat_int(i), vsplat_int(value), *a);
}

static void put_hit(vhit *to, int i, const one_hit *h)
{
    put(&to->distance, i, h->t);
    put_int(&to->instance, i, h->instance);
    put_int(&to->triangle, i, h->triangle);
    put(&to->u, i, h->u);
    put(&to->v, i, h->v);
}

static void copy_hit(vhit *to, const vhit *from, int i)
{
    one_hit h = { .t        = lane(from->distance, i),
                  .u        = lane(from->u, i),
                  .v        = lane(from->v, i),
                  .instance = lane(from->instance, i),
                  .triangle = lane(from->triangle, i) };
    put_hit(to, i, &h);
}

void hit_list_clear(vhit *hit, int i)
{
    put_hit(hit, i, &(one_hit){ .t = INFINITY, .instance = -1, .triangle = -1 });
}

/* < 0 if h comes before lane i of *other, 0 if it is the same hit. */
static int compare(const one_hit *h, const vhit *other, int i)
{
    if (h->t != lane(other->distance, i))
        return h->t < lane(other->distance, i) ? -1 : 1;
    if (h->instance != lane(other->instance, i))
        return h->instance < lane(other->instance, i) ? -1 : 1;
    return (h->triangle > lane(other->triangle, i)) - (h->triangle < lane(other->triangle, i));
}

void hit_list_add(hit_list *l, int i, const one_hit *h)
{
    int at = l->count[i];
    while (at > 0) {
        int c = compare(h, &l->hits[at - 1], i);
        if (c == 0)
            return; /* met again in another cell */
        if (c > 0)
            break;
        at--;
    }
    if (at == l->count[i] && l->stopped[i])
        return;

    if (h->hollow) {
        if (l->count[i] == l->most) { /* the last one falls off */
            l->dropped[i] = true;
            if (at == l->most)
                return;
            l->stopped[i] = false;
            l->count[i]--;
        }
        for (int k = l->count[i]; k > at; k--)
            copy_hit(&l->hits[k], &l->hits[k - 1], i);
        l->count[i]++;
    } else {
        if (at == l->most) {
            l->dropped[i] = true;
            return;
        }
        l->count[i]   = at + 1;
        l->stopped[i] = true;
    }
    put_hit(&l->hits[at], i, h);
}
