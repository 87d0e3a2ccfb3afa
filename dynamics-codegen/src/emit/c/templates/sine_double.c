typedef union {
    double real;
    uint64_t bits;
} PREFIX_bits;

/* Sine and cosine of x, in rad, at most 1.7e-16 off for |x| <= 2^30, without a branch that depends on more than the
 * range. Up to 2^49 the error is at most the spacing of double at x; NaN from there on, and for infinity and NaN.
 * W. J. Cody and W. Waite's reduction in parts; the polynomials of fdlibm (Sun Microsystems 1993).
 */
static void PREFIX_sin_cos(double x, double *sine, double *cosine)
{
    PREFIX_bits turns;
    PREFIX_bits s;
    PREFIX_bits c;

    turns.real = (x * 0.6366197723675814) + 6755399441055744.0; /* 1.5 * 2^52: the integer is in the low bits */
    const double k = turns.real - 6755399441055744.0;
    double r = ((x - (k * 1.570796251296997)) - (k * 7.549789415861596e-8)) - (k * 5.390302858158119e-15);
    if (!((x < 562949953421312.0) && (x > -562949953421312.0))) {
        s.bits = UINT64_C(0x7ff8000000000000);
        r = s.real;
    }

    const double z = r * r;
    const double z2 = z * z;
    const double s12 = (z * 8.33333333332249e-3) + -1.6666666666666632e-1;
    const double s34 = (z * 2.7557313707070068e-6) + -1.984126982985795e-4;
    const double s56 = (z * 1.58969099521155e-10) + -2.5050760253406863e-8;
    const double c12 = (z * -1.388888888887411e-3) + 4.166666666666666e-2;
    const double c34 = (z * -2.7557314351390663e-7) + 2.480158728947673e-5;
    const double c56 = (z * -1.1359647557788195e-11) + 2.087572321298175e-9;
    const double odd = (z2 * ((z2 * s56) + s34)) + s12;
    const double even = (z2 * ((z2 * c56) + c34)) + c12;
    const double sin_r = ((r * z) * odd) + r;
    const double cos_r = (z2 * even) + ((z * -0.5) + 1.0);

    s.real = ((turns.bits & 1u) != 0u) ? cos_r : sin_r;
    c.real = ((turns.bits & 1u) != 0u) ? sin_r : cos_r;
    s.bits ^= (turns.bits & 2u) << 62;
    c.bits ^= ((turns.bits + 1u) & 2u) << 62;
    *sine = s.real;
    *cosine = c.real;
}
