/* data/model/deflate.c -- see picture.h: one block of fixed codes (RFC 1951, 3.2.6).
 *
 * Repetitions are sought among the last places where the same three bytes stood.
 */
#include "data/model/picture.h"

#include <stdlib.h>

enum { HASH_SIZE = 1 << 15, WINDOW = 32768, LONGEST = 258, SHORTEST = 3, TRIES = 48 };

typedef struct bits {
    FILE *to;
    uint32_t held;
    int count;
} bits;

static void put_bits(bits *b, uint32_t v, int n) /* lowest first */
{
    b->held |= v << b->count;
    for (b->count += n; b->count >= 8; b->count -= 8, b->held >>= 8)
        fputc((int)(b->held & 255), b->to);
}

static void put_code(bits *b, uint32_t v, int n) /* highest first */
{
    while (n-- > 0)
        put_bits(b, v >> n & 1, 1);
}

/* A byte, 256 for the end, or from 257 on a class of lengths. */
static void put_symbol(bits *b, uint32_t s)
{
    if (s < 144)
        put_code(b, 0x30 + s, 8);
    else if (s < 256)
        put_code(b, 0x190 + s - 144, 9);
    else if (s < 280)
        put_code(b, s - 256, 7);
    else
        put_code(b, 0xc0 + s - 280, 8);
}

/* Both are coded as a class and, in classes that double in width, the place within it: `per` is 2
 * to the power of how many classes there are of each width. */
static int class_of(uint32_t v, int per, uint32_t *extra, int *extra_bits)
{
    *extra_bits = 0;
    while (v >> *extra_bits >= 2u << per)
        ++*extra_bits;
    *extra = v & ((1u << *extra_bits) - 1);
    return (*extra_bits << per) + (int)(v >> *extra_bits);
}

static void put_copy(bits *b, uint32_t length, uint32_t distance)
{
    uint32_t extra = 0;
    int n          = 0;
    if (length == LONGEST)
        put_symbol(b, 285);
    else
        put_symbol(b, 257 + (uint32_t)class_of(length - SHORTEST, 2, &extra, &n));
    put_bits(b, extra, n);
    put_code(b, (uint32_t)class_of(distance - 1, 1, &extra, &n), 5);
    put_bits(b, extra, n);
}

static uint32_t hash_of(const unsigned char *p)
{
    return ((uint32_t)p[0] << 10 ^ (uint32_t)p[1] << 5 ^ p[2]) & (HASH_SIZE - 1);
}

static uint32_t equal_bytes(const unsigned char *a, const unsigned char *b, size_t most)
{
    uint32_t n = 0;
    while (n < most && n < LONGEST && a[n] == b[n])
        n++;
    return n;
}

/* The longest repetition, of those tried, for what stands at i; before[] chains the places that
 * have the same hash, from head[] on, plus one. */
static uint32_t longest(const unsigned char *p, size_t i, size_t size, const uint32_t *head,
                        const uint32_t *before, uint32_t *distance)
{
    uint32_t best = 0, at = head[hash_of(p + i)];
    for (int k = 0; k < TRIES && at && i - (at - 1) <= WINDOW; k++, at = before[at - 1]) {
        const uint32_t n = equal_bytes(p + at - 1, p + i, size - i);
        if (n > best) {
            best      = n;
            *distance = (uint32_t)(i - (at - 1));
        }
    }
    return best;
}

static void put_all(bits *b, const unsigned char *p, size_t size, uint32_t *head, uint32_t *before)
{
    for (size_t i = 0; i < size;) {
        uint32_t distance = 0, n = 0;
        if (i + SHORTEST <= size)
            n = longest(p, i, size, head, before, &distance);
        if (n < SHORTEST)
            n = 1, put_symbol(b, p[i]);
        else
            put_copy(b, n, distance);
        for (const size_t end = i + n; i < end; i++)
            if (i + SHORTEST <= size) {
                before[i]            = head[hash_of(p + i)];
                head[hash_of(p + i)] = (uint32_t)i + 1;
            }
    }
    put_symbol(b, 256);
}

static uint32_t adler(const unsigned char *p, size_t size)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + p[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

bool deflate_write(const unsigned char *bytes, size_t size, FILE *to)
{
    uint32_t *head = calloc(HASH_SIZE, sizeof *head), *before = calloc(size + 1, sizeof *before);
    const bool room = head && before;
    if (room) {
        bits b             = { .to = to };
        const uint32_t sum = adler(bytes, size);
        fwrite("\x78\x01", 1, 2, to);
        put_bits(&b, 3, 3); /* the last block, of fixed codes */
        put_all(&b, bytes, size, head, before);
        put_bits(&b, 0, 7);
        for (int i = 24; i >= 0; i -= 8)
            fputc((int)(sum >> i & 255), to);
    }
    free(head);
    free(before);
    return room && !ferror(to);
}
