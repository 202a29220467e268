/* core/sampler.h -- low-discrepancy numbers for packets: Sobol points, scrambled by hashes.
 *
 * A seed names a set of points in [0,1)^4; its samples are numbered from 0, and 2^m of them
 * from a multiple of 2^m on are a net. Any seed is as good as any other, consecutive ones
 * too: the points of two seeds are independent, each is even in [0,1)^4 over the seeds, and so
 * the spread of several seeds' means tells the error of their mean. A path takes four numbers
 * at each of its vertices, with a seed of its own there: vhash_combine(seed, vertex); but the
 * first two share one.
 *
 * Pure functions: any thread may call them, and every width and machine gets the same bits.
 */
#ifndef CORE_SAMPLER_H
#define CORE_SAMPLER_H

#include "core/packet.h"

/* In [0, 1 - 2^-24], each a multiple of 2^-24. */
typedef struct vsample4 {
    vfloat x, y, z, w;
} vsample4;

/* Sample number `index` of the set `seed` names: the first four Sobol dimensions (Joe & Kuo's
 * direction numbers, new-joe-kuo-6, in natural order), order and digits scrambled as Owen's
 * nested uniform scrambling would (Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4)
 * 2020). Of any 2^m samples from a multiple of 2^m on, each of 2^m equal intervals of any one
 * coordinate holds one, and so does, in the plane of x and y, each of 2^m equal rectangles with
 * sides 2^-a and 2^-(m-a). */
vsample4 vsobol4(vuint index, vuint seed);

/* Numbers to go with x and y of the above: a point in six dimensions. They are Sobol dimensions 4,
 * 6, 3 and 5 (so not to go with z and w), for a path's second vertex: direction and place on a
 * light (x, y), which light (z), whether it ends (w). Of the orders tried this one had the least
 * noise over few and many samples, in an office and in a room with a window. */
vsample4 vsobol4_more(vuint index, vuint seed);

/* 32 bits, of which each depends on every bit of a; no two a give the same. The mixing is
 * Wellons' lowbias32 (nullprogram.com/blog/2018/07/31), begun off 0, which it would keep. */
static inline uint32_t hash_u32(uint32_t a)
{
    a += 0x9e3779b9;
    a = (a ^ (a >> 16)) * 0x7feb352d;
    a = (a ^ (a >> 15)) * 0x846ca68b;
    return a ^ (a >> 16);
}
static inline vuint vhash(vuint a)
{
    a += 0x9e3779b9;
    a = (a ^ (a >> 16)) * 0x7feb352d;
    a = (a ^ (a >> 15)) * 0x846ca68b;
    return a ^ (a >> 16);
}

/* Of two numbers, whose order counts; the combination of more is nested. */
static inline uint32_t hash_combine_u32(uint32_t a, uint32_t b)
{
    return hash_u32(hash_u32(a) + b);
}
static inline vuint vhash_combine(vuint a, vuint b) { return vhash(vhash(a) + b); }

/* Of a number and a text. */
static inline uint32_t hash_text_u32(uint32_t a, const char *text)
{
    for (; *text; text++)
        a = hash_combine_u32(a, (uint32_t)(unsigned char)*text);
    return a;
}

#endif
