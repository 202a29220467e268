/* core/sampler.c -- see sampler.h.
 *
 * Binary digits are kept with the most significant in bit 0, since a scramble lets each digit
 * depend on the more significant ones alone, and so do sums and products on lower bits.
 *
 * Dimension d of Sobol's sequence belongs to a primitive polynomial P over GF(2), of degree s.
 * From the recurrence of its direction numbers, with the index taken as a polynomial whose
 * coefficients are its bits, follows: the digits of the point, s at a time, are the remainders
 * when the index is divided by P over and over, each remainder mapped by one s x s matrix that
 * the first s direction numbers give. As (a + b)^2 = a^2 + b^2 over GF(2), the powers of
 * P with exponents 1, 2, 4, ... have no more terms than P. So the division goes by halves:
 *
 *   index                                      31 ............................ 0
 *   by P^m, s m < 32:                          [   quotient   ][   remainder   ]
 *   both by P^(m/2):                           [ q ][ r ]       [ q ][ r ]     ...
 *
 * and each quotient stays in place. Some five steps replace a loop over 32 direction numbers.
 */
#include "core/sampler.h"

/* P = t + 1: P^m = t^m + 1; its matrix is the identity. */
static vuint sobol_dimension_2(vuint n)
{
    n ^= n >> 16;
    n ^= (n >> 8) & 0x00ff00ff;
    n ^= (n >> 4) & 0x0f0f0f0f;
    n ^= (n >> 2) & 0x33333333;
    n ^= (n >> 1) & 0x55555555;
    return n;
}

/* Bits from <= i < to of each field of that width; none if from >= to. */
static inline uint32_t bits_of_fields(int width, int from, int to)
{
    int fields     = (31 + width) / width;
    uint64_t first = width < 32 ? ((1ull << fields * width) - 1) / ((1ull << width) - 1) : 1;
    return from < to ? (uint32_t)(((1ull << to) - (1ull << from)) * first) : 0;
}

/* Division by P^m = t^sm + t^rm + 1, where P = t^s + t^r + 1. What is above t^sm is the quotient q,
 * but for what q t^rm has there: q = a + q t^(rm - sm) = a (1 + t^-k) (1 + t^-2k) ... with
 * k = sm - rm, of which two factors do as long as s <= 4 (s - r). */
static inline vuint divide(vuint n, int s, int r, int m)
{
    int degree = s * m, width = 2 * degree, k = degree - r * m;
    n ^= (n >> k) & bits_of_fields(width, degree, width - k);
    if (2 * k < degree)
        n ^= (n >> 2 * k) & bits_of_fields(width, degree, width - 2 * k);
    return n ^ ((n >> degree) & bits_of_fields(width, 0, degree)) ^
           ((n >> k) & bits_of_fields(width, degree - k, degree));
}

/* The remainders, s bits each. */
static inline vuint sobol_remainders(vuint n, int s, int r)
{
    if (s < 4)
        n = divide(n, s, r, 8);
    n = divide(n, s, r, 4);
    n = divide(n, s, r, 2);
    return divide(n, s, r, 1);
}

/* The matrices: digits are bits of a remainder, the first in bit 0, plus others of higher bits.
 * P = t^2 + t + 1, first direction numbers 1, 3. */
static vuint sobol_dimension_3(vuint n)
{
    n = sobol_remainders(n, 2, 1);
    return n ^ ((n >> 1) & bits_of_fields(2, 0, 1));
}

/* P = t^3 + t + 1; 1, 3, 1. */
static vuint sobol_dimension_4(vuint n)
{
    n = sobol_remainders(n, 3, 1);
    return n ^ ((n >> 1) & bits_of_fields(3, 0, 1));
}

/* P = t^3 + t^2 + 1; 1, 1, 1. */
static vuint sobol_dimension_5(vuint n) { return sobol_remainders(n, 3, 2); }

/* P = t^4 + t + 1; 1, 1, 3, 3. */
static vuint sobol_dimension_6(vuint n)
{
    n = sobol_remainders(n, 4, 1);
    return n ^ ((n >> 1) & bits_of_fields(4, 1, 3));
}

/* Flips each digit or not, as a hash of the seed and the more significant digits says (after
 * Laine & Karras 2011; constants: psychopath.io/post/2021_01_30_building_a_better_lk_hash). */
static vuint scramble(vuint digits, vuint seed)
{
    digits ^= digits * 0x3d20adea;
    digits += seed;
    digits *= (seed >> 16) | 1;
    digits ^= digits * 0x05526c56;
    digits ^= digits * 0x53a22864;
    return digits;
}

/* The most significant 24 digits: as many as a float holds, lest it round up to 1. */
static vfloat number(vuint digits)
{
    return vto_float(vsigned(vreverse_bits(digits) >> 8)) * 0x1p-24f;
}

/* The index, as the order is scrambled; h: the hash of the seed. */
static vuint shuffle(vuint index, vuint h)
{
    return vreverse_bits(scramble(vreverse_bits(index), vhash(h)));
}

vsample4 vsobol4(vuint index, vuint seed)
{
    vuint h = vhash(seed);
    vuint n = shuffle(index, h);
    return (vsample4){
        number(scramble(n, vhash(h + 1))),
        number(scramble(sobol_dimension_2(n), vhash(h + 2))),
        number(scramble(sobol_dimension_3(n), vhash(h + 3))),
        number(scramble(sobol_dimension_4(n), vhash(h + 4))),
    };
}

vsample4 vsobol4_more(vuint index, vuint seed)
{
    vuint h = vhash(seed);
    vuint n = shuffle(index, h);
    return (vsample4){
        number(scramble(sobol_dimension_4(n), vhash(h + 4))),
        number(scramble(sobol_dimension_6(n), vhash(h + 6))),
        number(scramble(sobol_dimension_3(n), vhash(h + 3))),
        number(scramble(sobol_dimension_5(n), vhash(h + 5))),
    };
}
