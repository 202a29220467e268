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
 *   by P^m, m = 16/s or so:                    [   quotient   ][   remainder   ]
 *   both by P^(m/2):                           [ q ][ r ]       [ q ][ r ]     ...
 *
 * and each quotient stays in place. Five steps replace a loop over 32 direction numbers.
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

/* P = t^2 + t + 1, first direction numbers 1, 3: P^m = t^2m + t^m + 1. The first line of each
 * step makes the quotient, the second the remainder. */
static vuint sobol_dimension_3(vuint n)
{
    n ^= (n >> 8) & 0x00ff0000;
    n ^= (n >> 16) ^ ((n >> 8) & 0x0000ff00);
    n ^= (n >> 4) & 0x0f000f00;
    n ^= ((n >> 8) & 0x00ff00ff) ^ ((n >> 4) & 0x00f000f0);
    n ^= (n >> 2) & 0x30303030;
    n ^= ((n >> 4) & 0x0f0f0f0f) ^ ((n >> 2) & 0x0c0c0c0c);
    n ^= (n >> 1) & 0x44444444;
    n ^= ((n >> 2) & 0x33333333) ^ ((n >> 1) & 0x22222222);
    return n ^ ((n >> 1) & 0x55555555); /* its matrix: first digit += second */
}

/* P = t^3 + t + 1, first direction numbers 1, 3, 1: P^m = t^3m + t^m + 1. */
static vuint sobol_dimension_4(vuint n)
{
    n ^= (n >> 24) ^ ((n >> 16) & 0x0000ff00);
    n ^= (n >> 8) & 0x0000f000;
    n ^= ((n >> 12) & 0x00000fff) ^ ((n >> 8) & 0x00000ff0);
    n ^= (n >> 4) & 0x000c00c0;
    n ^= ((n >> 6) & 0x3f03f03f) ^ ((n >> 4) & 0x3c03c03c);
    n ^= (n >> 2) & 0x08208208;
    n ^= ((n >> 3) & 0x071c71c7) ^ ((n >> 2) & 0x06186186);
    return n ^ ((n >> 1) & 0x49249249); /* its matrix: first digit += second */
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

vsample4 vsobol4(vuint index, vuint seed)
{
    vuint h = vhash(seed);
    vuint n = vreverse_bits(scramble(vreverse_bits(index), vhash(h)));
    return (vsample4){
        number(scramble(n, vhash(h + 1))),
        number(scramble(sobol_dimension_2(n), vhash(h + 2))),
        number(scramble(sobol_dimension_3(n), vhash(h + 3))),
        number(scramble(sobol_dimension_4(n), vhash(h + 4))),
    };
}
