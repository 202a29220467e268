/* core/packet.h -- the arithmetic of packets: PACKET_WIDTH rays side by side, one per lane.
 *
 *   vfloat, vint  a number per lane; take the plain operators:  0.5f * a + b
 *   vuint         bits per lane: wraps around, shifts in zeros; for hashes and digits
 *   vmask         a truth value per lane, as comparisons give:  (d > 0.0f) & active
 *   vvec3         a 3-vector per lane, kept by component; takes the functions below
 *
 * One source serves every width, to the same bits. Four and eight lanes are vectors of the
 * compiler; one lane is a plain float, and so the scalar code that every speed-up is measured
 * against. Hence what holds at all widths is all that may be written elsewhere: masks join by
 * & | ~ alone (truth is bit 0 of one lane, all bits of one in a vector), a choice is a
 * vselect(), one lane is read by lane(), and casts go by name. Lanes never trap: a division
 * by zero in a lane that a mask will drop is harmless.
 */
#ifndef CORE_PACKET_H
#define CORE_PACKET_H

#include "core/vec3.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#ifndef PACKET_WIDTH
#define PACKET_WIDTH 4
#endif
enum { LANES = PACKET_WIDTH };

/* Types and casts. vas_ keeps the bits, vto_ the value: vto_int drops the fraction of an a
 * within 2^31 of 0. lane(a, i) is a value of any of these types, not a place to write to. */
#if PACKET_WIDTH == 1
typedef float vfloat;
typedef int32_t vint;
typedef uint32_t vuint;
typedef int32_t vmask;

#define lane(a, i) ((void)(i), +(a))

static inline vint vas_int(vfloat a)
{
    vint bits;
    memcpy(&bits, &a, sizeof bits);
    return bits;
}
static inline vfloat vas_float(vint bits)
{
    vfloat a;
    memcpy(&a, &bits, sizeof a);
    return a;
}
static inline vint vto_int(vfloat a) { return (vint)a; }
static inline vint vsigned(vuint a) { return (vint)a; }
static inline vuint vunsigned(vint a) { return (vuint)a; }
static inline vfloat vto_float(vint a) { return (vfloat)a; }
#else
typedef float vfloat __attribute__((vector_size(4 * PACKET_WIDTH)));
typedef int32_t vint __attribute__((vector_size(4 * PACKET_WIDTH)));
typedef uint32_t vuint __attribute__((vector_size(4 * PACKET_WIDTH)));
typedef int32_t vmask __attribute__((vector_size(4 * PACKET_WIDTH)));

#define lane(a, i) (+(a)[i])

static inline vint vas_int(vfloat a) { return (vint)a; }
static inline vfloat vas_float(vint bits) { return (vfloat)bits; }
static inline vint vto_int(vfloat a) { return __builtin_convertvector(a, vint); }
static inline vint vsigned(vuint a) { return (vint)a; }
static inline vuint vunsigned(vint a) { return (vuint)a; }
static inline vfloat vto_float(vint a) { return __builtin_convertvector(a, vfloat); }
#endif

typedef struct vvec3 {
    vfloat x, y, z;
} vvec3;

typedef vvec3 vrgb; /* x red, y green, z blue */

#define ALL_LANES (~(vmask){ 0 })

/* Numbers. vselect is a where m holds and b elsewhere; vkeep is a where m holds and +0
 * elsewhere, whatever a was (NaN included). vsplat keeps the sign of -0. */
#if PACKET_WIDTH == 1
static inline vfloat vsplat(float a) { return a; }
static inline vfloat vkeep(vmask m, vfloat a) { return (m & 1) ? a : 0.0f; }
static inline vfloat vselect(vmask m, vfloat a, vfloat b) { return (m & 1) ? a : b; }
#else
static inline vfloat vsplat(float a) { return a - (vfloat){ 0 }; }
static inline vfloat vkeep(vmask m, vfloat a) { return vas_float(m & vas_int(a)); }
static inline vfloat vselect(vmask m, vfloat a, vfloat b)
{
    return vas_float((m & vas_int(a)) | (~m & vas_int(b)));
}
#endif
static inline vint vselect_int(vmask m, vint a, vint b)
{
    return vas_int(vselect(m, vas_float(a), vas_float(b)));
}
static inline vint vkeep_int(vmask m, vint a) { return vas_int(vkeep(m, vas_float(a))); }
static inline vint vsplat_int(int32_t a) { return a + (vint){ 0 }; }
static inline vuint vsplat_uint(uint32_t a) { return a + (vuint){ 0 }; }
static inline vfloat vabs(vfloat a) { return vas_float(vas_int(a) & INT32_MAX); }
static inline vfloat vcopysign(vfloat size, vfloat sign)
{
    return vas_float((vas_int(size) & INT32_MAX) | (vas_int(sign) & INT32_MIN));
}
static inline vfloat vlerp(vfloat a, vfloat b, vfloat t) { return (1.0f - t) * a + t * b; }

/* Lanes. vlane_index is 0, 1, 2, ...; vgather is table[index] of each lane, dead ones too: so
 * that dead lanes read nothing outside of the table, give them an index that is in it, 0 by
 * vkeep_int(active, index). vload and vstore take LANES numbers one after the other, at any
 * alignment. */
#if PACKET_WIDTH == 1
static inline vint vlane_index(void) { return 0; }
static inline vfloat vgather(const float *table, vint index) { return table[index]; }
#elif PACKET_WIDTH == 4
static inline vint vlane_index(void) { return (vint){ 0, 1, 2, 3 }; }
static inline vfloat vgather(const float *table, vint index)
{
    return (vfloat){ table[index[0]], table[index[1]], table[index[2]], table[index[3]] };
}
#elif PACKET_WIDTH == 8
static inline vint vlane_index(void) { return (vint){ 0, 1, 2, 3, 4, 5, 6, 7 }; }
static inline vfloat vgather(const float *table, vint index)
{
    vfloat a = { 0 };
    for (int i = 0; i < LANES; i++)
        a[i] = table[index[i]];
    return a;
}
#else
#error "PACKET_WIDTH is 1, 4 or 8"
#endif

static inline vfloat vload(const float *from)
{
    vfloat a;
    memcpy(&a, from, sizeof a);
    return a;
}
static inline vint vload_int(const int32_t *from)
{
    vint a;
    memcpy(&a, from, sizeof a);
    return a;
}
static inline void vstore(float *to, vfloat a) { memcpy(to, &a, sizeof a); }
static inline void vstore_int(int32_t *to, vint a) { memcpy(to, &a, sizeof a); }
static inline vint vgather_int(const int32_t *table, vint index)
{
#if PACKET_WIDTH == 4 /* by way of memory it takes twice as long */
    return (vint){ table[index[0]], table[index[1]], table[index[2]], table[index[3]] };
#else
    int32_t at[LANES];
    for (int i = 0; i < LANES; i++)
        at[i] = table[lane(index, i)];
    return vload_int(at);
#endif
}

/* Four floats side by side, such as the red, green, blue and spare of a table's corner: one load,
 * and what one lane blends by itself. float4_lerp is p + t (q - p), to the bit p where both are the
 * same. vturn4 makes of a float4 a lane one packet of each of the four; vgather4 reads them, those
 * of each lane from table[4 index] on. */
#if PACKET_WIDTH == 1
typedef struct float4 {
    float a, b, c, d;
} float4;

static inline float4 float4_scale(float4 q, float s)
{
    return (float4){ q.a * s, q.b * s, q.c * s, q.d * s };
}
static inline float4 float4_add(float4 p, float4 q)
{
    return (float4){ p.a + q.a, p.b + q.b, p.c + q.c, p.d + q.d };
}
static inline float4 float4_lerp(float4 p, float4 q, float t)
{
    return (float4){ p.a + t * (q.a - p.a), p.b + t * (q.b - p.b), p.c + t * (q.c - p.c),
                     p.d + t * (q.d - p.d) };
}
static inline void vturn4(const float4 q[LANES], vfloat out[4]) { memcpy(out, q, sizeof *q); }
#else
typedef float float4 __attribute__((vector_size(16)));

static inline float4 float4_scale(float4 q, float s) { return q * s; }
static inline float4 float4_add(float4 p, float4 q) { return p + q; }
static inline float4 float4_lerp(float4 p, float4 q, float t) { return p + t * (q - p); }
#if PACKET_WIDTH == 4
static inline void vturn4(const float4 q[LANES], vfloat out[4])
{
    vfloat low01  = __builtin_shufflevector(q[0], q[1], 0, 4, 1, 5);
    vfloat low23  = __builtin_shufflevector(q[2], q[3], 0, 4, 1, 5);
    vfloat high01 = __builtin_shufflevector(q[0], q[1], 2, 6, 3, 7);
    vfloat high23 = __builtin_shufflevector(q[2], q[3], 2, 6, 3, 7);
    out[0]        = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    out[1]        = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    out[2]        = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    out[3]        = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}
#else
static inline void vturn4(const float4 q[LANES], vfloat out[4])
{
    for (int i = 0; i < LANES; i++)
        for (int c = 0; c < 4; c++)
            out[c][i] = q[i][c];
}
#endif
#endif

static inline float4 float4_load(const float *from)
{
    float4 q;
    memcpy(&q, from, sizeof q);
    return q;
}
static inline float4 float4_at(const float *table, int32_t index)
{
    return float4_load(table + 4 * (ptrdiff_t)index);
}
static inline void vgather4(const float *table, vint index, vfloat out[4])
{
    float4 rows[LANES];
    for (int i = 0; i < LANES; i++)
        rows[i] = float4_at(table, lane(index, i));
    vturn4(rows, out);
}

/* What the compiler has no operator for. vmin is a < b ? a : b, and so b where either is NaN;
 * vmax likewise. vfloor and vround (halves go to even) keep NaN, infinities and the sign of -0.
 * vbits puts lane i into bit i; vreverse_bits makes bit 0 of each lane its bit 31, and so on.
 * No other file names an intrinsic. */
#if PACKET_WIDTH == 4 && defined __SSE4_1__
#include <smmintrin.h> /* not immintrin.h: all of AVX-512 is half the time of most compilations */
static inline vfloat vsqrt(vfloat a) { return _mm_sqrt_ps(a); }
static inline vfloat vfloor(vfloat a) { return _mm_floor_ps(a); }
static inline vfloat vround(vfloat a)
{
    return _mm_round_ps(a, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}
static inline vfloat vmin(vfloat a, vfloat b) { return _mm_min_ps(a, b); }
static inline vfloat vmax(vfloat a, vfloat b) { return _mm_max_ps(a, b); }
static inline int vbits(vmask m) { return _mm_movemask_ps((__m128)m); }
static inline vuint vreverse_bits(vuint a)
{
    /* Bytes in reverse, then each half byte looked up: its bits in reverse, in the other half */
    const __m128i order = _mm_set_epi8(12, 13, 14, 15, 8, 9, 10, 11, 4, 5, 6, 7, 0, 1, 2, 3);
    const __m128i upper = _mm_set_epi64x((int64_t)0xf070b030d0509010, (int64_t)0xe060a020c0408000);
    const __m128i lower = _mm_set_epi64x(0x0f070b030d050901, 0x0e060a020c040800);
    const __m128i half  = _mm_set1_epi8(0x0f);
    __m128i bytes       = _mm_shuffle_epi8((__m128i)a, order);
    __m128i low         = _mm_and_si128(bytes, half);
    __m128i high        = _mm_and_si128(_mm_srli_epi16(bytes, 4), half);
    return (vuint)(_mm_shuffle_epi8(upper, low) | _mm_shuffle_epi8(lower, high));
}
#elif PACKET_WIDTH == 8 && defined __AVX2__
/* What immintrin.h calls, gcc and clang alike: no smaller header has AVX2's. */
static inline vfloat vsqrt(vfloat a) { return __builtin_ia32_sqrtps256(a); }
static inline vfloat vfloor(vfloat a) { return __builtin_ia32_roundps256(a, 9); } /* downward */
static inline vfloat vround(vfloat a) { return __builtin_ia32_roundps256(a, 8); } /* to nearest */
static inline vfloat vmin(vfloat a, vfloat b) { return __builtin_ia32_minps256(a, b); }
static inline vfloat vmax(vfloat a, vfloat b) { return __builtin_ia32_maxps256(a, b); }
static inline int vbits(vmask m) { return __builtin_ia32_movmskps256(vas_float(m)); }
static inline vuint vreverse_bits(vuint a)
{
    /* Bytes in reverse, then each half byte looked up: its bits in reverse, in the other half */
    typedef char bytes32 __attribute__((vector_size(32)));
    typedef int64_t int64x4 __attribute__((vector_size(32)));
    const int64x4 order = { 0x0405060700010203, 0x0c0d0e0f08090a0b, 0x0405060700010203,
                            0x0c0d0e0f08090a0b };
    const int64x4 lower = { 0x0e060a020c040800, 0x0f070b030d050901, 0x0e060a020c040800,
                            0x0f070b030d050901 };
    const vuint half    = vsplat_uint(0x0f0f0f0f);
    vuint bytes         = (vuint)__builtin_ia32_pshufb256((bytes32)a, (bytes32)order);
    bytes32 low = (bytes32)(bytes & half), high = (bytes32)((bytes >> 4) & half);
    return (vuint)__builtin_ia32_pshufb256((bytes32)(lower << 4), low) |
           (vuint)__builtin_ia32_pshufb256((bytes32)lower, high);
}
#else /* one lane, or another processor */
static inline vfloat vsqrt(vfloat a)
{
    float root[LANES];
    for (int i = 0; i < LANES; i++)
        root[i] = __builtin_sqrtf(lane(a, i));
    return vload(root);
}
static inline vfloat vfloor(vfloat a)
{
    float whole[LANES];
    for (int i = 0; i < LANES; i++)
        whole[i] = __builtin_floorf(lane(a, i));
    return vload(whole);
}
static inline vfloat vround(vfloat a)
{
    float whole[LANES];
    for (int i = 0; i < LANES; i++)
        whole[i] = __builtin_rintf(lane(a, i));
    return vload(whole);
}
static inline vfloat vmin(vfloat a, vfloat b) { return vselect(a < b, a, b); }
static inline vfloat vmax(vfloat a, vfloat b) { return vselect(a > b, a, b); }
static inline int vbits(vmask m)
{
    int bits = 0;
    for (int i = 0; i < LANES; i++)
        bits |= (lane(m, i) & 1) << i;
    return bits;
}
static inline vuint vreverse_bits(vuint a)
{
    a = (a >> 16) | (a << 16);
    a = ((a >> 8) & 0x00ff00ff) | ((a & 0x00ff00ff) << 8);
    a = ((a >> 4) & 0x0f0f0f0f) | ((a & 0x0f0f0f0f) << 4);
    a = ((a >> 2) & 0x33333333) | ((a & 0x33333333) << 2);
    return ((a >> 1) & 0x55555555) | ((a & 0x55555555) << 1);
}
#endif

/* Over all lanes; vsum adds from lane 0 upward. */
static inline bool vany(vmask m) { return vbits(m) != 0; }
static inline bool vall(vmask m) { return vbits(m) == (1 << LANES) - 1; }
/* The lanes of *left, some of which hold, whose index is that of its first one, *which: those are
 * taken out of *left. Lanes of different things are so served one thing after the other. */
static inline vmask vtake_same(vint index, vmask *left, int *which)
{
    *which     = lane(index, __builtin_ctz((unsigned)vbits(*left)));
    vmask same = *left & (index == *which);
    *left      = *left & ~same;
    return same;
}
static inline float vsum(vfloat a)
{
    float sum = lane(a, 0);
    for (int i = 1; i < LANES; i++)
        sum += lane(a, i);
    return sum;
}

/* Vectors. */
static inline vvec3 vspread(vec3 a) { return (vvec3){ vsplat(a.x), vsplat(a.y), vsplat(a.z) }; }
static inline vvec3 vadd(vvec3 a, vvec3 b) { return (vvec3){ a.x + b.x, a.y + b.y, a.z + b.z }; }
static inline vvec3 vsub(vvec3 a, vvec3 b) { return (vvec3){ a.x - b.x, a.y - b.y, a.z - b.z }; }
static inline vvec3 vneg(vvec3 a) { return (vvec3){ -a.x, -a.y, -a.z }; }
static inline vvec3 vscale(vvec3 a, vfloat s) { return (vvec3){ a.x * s, a.y * s, a.z * s }; }
static inline vfloat vdot(vvec3 a, vvec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline vvec3 valong(vvec3 o, vvec3 d, vfloat t) { return vadd(o, vscale(d, t)); }
static inline vvec3 vkeep3(vmask m, vvec3 a)
{
    return (vvec3){ vkeep(m, a.x), vkeep(m, a.y), vkeep(m, a.z) };
}
static inline vvec3 vselect3(vmask m, vvec3 a, vvec3 b)
{
    return (vvec3){ vselect(m, a.x, b.x), vselect(m, a.y, b.y), vselect(m, a.z, b.z) };
}
static inline vvec3 vcross(vvec3 a, vvec3 b)
{
    return (vvec3){ a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

/* For lengths from 1e-18 to 1e18: squares of others leave the range of a float, and (as 0 does)
 * vnormalize may give NaN or 0. */
static inline vfloat vlength(vvec3 a) { return vsqrt(vdot(a, a)); }
static inline vvec3 vnormalize(vvec3 a) { return vscale(a, 1.0f / vlength(a)); }

/* Two unit vectors that with the unit vector n make a right-handed frame (u, v, n), without a
 * branch and without a bad direction (Duff et al., "Building an Orthonormal Basis, Revisited",
 * JCGT 6(1) 2017). They turn all at once where n.z changes its sign. */
static inline void vframe(vvec3 n, vvec3 *u, vvec3 *v)
{
    vfloat sign = vcopysign(vsplat(1.0f), n.z);
    vfloat a    = -1.0f / (sign + n.z);
    vfloat b    = n.x * n.y * a;
    *u          = (vvec3){ 1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x };
    *v          = (vvec3){ b, sign + n.y * n.y * a, -n.y };
}

#endif
