typedef union {
    float real;
    uint32_t bits;
} PREFIX_bits;

/* Sine and cosine of x, in rad, at most 9.4e-8 off for |x| <= 1e4, without an operation in double and without a branch
 * that depends on more than the range. Up to 2^20 the error is at most the spacing of float at x; NaN from there on, and
 * for infinity and NaN. W. J. Cody and W. Waite's reduction in parts; minimax polynomials.
 */
static void PREFIX_sin_cos(float x, float *sine, float *cosine)
{
    PREFIX_bits turns;
    PREFIX_bits s;
    PREFIX_bits c;

    turns.real = (x * 0.63661975f) + 12582912.0f; /* 1.5 * 2^23: the integer is in the low bits */
    const float k = turns.real - 12582912.0f;
    float r = ((x - (k * 1.5703125f)) - (k * 0.0004837513f)) - (k * 7.54979e-8f);
    if (!((x < 1048576.0f) && (x > -1048576.0f))) {
        s.bits = 0x7fc00000u;
        r = s.real;
    }

    const float z = r * r;
    const float odd = (z * ((z * -0.00019495955f) + 0.008331982f)) + -0.16666651f;
    const float even = (z * ((z * 2.4430661e-5f) + -0.0013887301f)) + 0.041666646f;
    const float sin_r = ((r * z) * odd) + r;
    const float cos_r = ((z * z) * even) + ((z * -0.5f) + 1.0f);

    s.real = ((turns.bits & 1u) != 0u) ? cos_r : sin_r;
    c.real = ((turns.bits & 1u) != 0u) ? sin_r : cos_r;
    s.bits ^= (turns.bits & 2u) << 30;
    c.bits ^= ((turns.bits + 1u) & 2u) << 30;
    *sine = s.real;
    *cosine = c.real;
}
